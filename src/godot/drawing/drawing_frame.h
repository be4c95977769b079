// SPDX-License-Identifier: MIT
// What all bodies need to know of the frame that is about to be drawn.
#pragma once

#include <godot_cpp/classes/node.hpp>
#include <godot_cpp/classes/viewport.hpp>
#include <godot_cpp/variant/transform2d.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace softbody {

/// A viewport with bodies in its scene, and how it looks at them.
class BodyView {
public:
	explicit BodyView(godot::Viewport *viewport);

	/// Whether what the rendering server saw last may not hold in this frame: the camera has jumped, or the viewport is
	/// not drawn in every frame. Then every body must be up to date.
	bool is_unsteady() const { return is_unsteady_; }
	/// Whether the viewport's camera hangs rigidly on this node, so that both move in ticks.
	bool is_carried_by(const godot::Node *node) const;

private:
	friend class DrawingFrame;
	void begin_frame();

	std::uint64_t viewport_ = 0; ///< instance id
	bool is_sub_viewport_ = false;
	int users_ = 0;
	bool is_unsteady_ = true;
	godot::Transform2D canvas_transform_;
	std::vector<const godot::Node *> carriers_; ///< ancestors of the camera; compared, never followed
};

/// Made new for every frame.
class DrawingFrame {
public:
	/// How far a body's surroundings count as seen, beyond the edges of the view [px]. Less, and a body that comes in fast
	/// would show for one frame the shape in which it went out.
	static constexpr double MARGIN = 64;

	/// A node in the scene of this viewport begins, or ends, to be drawn. A view is shared by all its nodes.
	BodyView *add(godot::Viewport *viewport);
	void remove(BodyView *view);

	/// Reads the engine's state before a frame.
	void begin();
	/// Where the frame is between the last two physics ticks, in [0, 1].
	double fraction() const { return fraction_; }

private:
	std::vector<std::unique_ptr<BodyView>> views_;
	double fraction_ = 1;
};

/// The engine's own, for whoever draws outside of a frame; in [0, 1].
double present_fraction();

} // namespace softbody
