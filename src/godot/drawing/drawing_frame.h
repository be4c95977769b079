// SPDX-License-Identifier: MIT
// State of the coming frame that all bodies need for drawing.
#pragma once

#include <godot_cpp/classes/node.hpp>
#include <godot_cpp/classes/viewport.hpp>
#include <godot_cpp/variant/transform2d.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace softbody {

/// A viewport with bodies in its scene, and its camera.
class BodyView {
public:
	explicit BodyView(godot::Viewport *viewport);

	/// Whether visibility of the last frame may not hold in this one: the camera has jumped, or the viewport is not
	/// drawn in every frame. Then every body must be updated.
	bool is_unsteady() const { return is_unsteady_; }
	/// Whether the viewport's camera hangs rigidly below this node, so that both move in ticks.
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

/// State of one frame, made new for each.
class DrawingFrame {
public:
	/// Distance beyond the view at which a body counts as visible [px]. Smaller: fast bodies show an old shape for one
	/// frame.
	static constexpr double MARGIN = 64;

	/// Called when a node in the scene of this viewport begins, or ends, to be drawn. All its nodes share a view.
	BodyView *add(godot::Viewport *viewport);
	void remove(BodyView *view);

	/// Reads the engine's state before a frame.
	void begin();
	/// Place of the frame between the last two physics ticks, in [0, 1].
	double fraction() const { return fraction_; }

private:
	std::vector<std::unique_ptr<BodyView>> views_;
	double fraction_ = 1;
};

/// The engine's present interpolation fraction, for drawing outside of a frame; in [0, 1].
double present_fraction();

} // namespace softbody
