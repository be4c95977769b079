// SPDX-License-Identifier: MIT
// Places a body between two physics ticks.
#pragma once

#include "core/base/vec2.h"

#include <godot_cpp/variant/transform2d.hpp>

#include <span>

namespace softbody {

/// A pose is a frame, the node's global transform, and points in that frame. Blending both separately lets a spinning
/// body turn instead of shrinking. The frames are kept here; the core has the points from before and after its step.
class BodyInterpolation {
public:
	/// Called after a step of the body; `before` is the node's frame until then.
	void begin(const godot::Transform2D &before);
	/// Ends blending: the body is drawn at its place until the next step.
	void end() { is_moving_ = false; }
	bool is_moving() const { return is_moving_; }
	/// The node's frame at the start of the blending.
	const godot::Transform2D &start() const { return start_; }

	/// Called after the user has moved the node, and the core the points of both ends. Where the engine blends the
	/// node's transform (`is_engines`), blending goes on from the node's old frame; otherwise the body is drawn at the
	/// new place at once.
	void carry(const godot::Transform2D &from, const godot::Transform2D &to, bool is_engines);

	/// The frame at `fraction` in [0, 1] of the way to `now`.
	godot::Transform2D frame(const godot::Transform2D &now, double fraction) const;
	/// The points in that frame. `before` and `after` are global positions; `local` has equal size.
	void local_points(const godot::Transform2D &now, double fraction, std::span<const Vec2> before,
			std::span<const Vec2> after, std::span<Vec2> local) const;

private:
	bool is_moving_ = false;
	godot::Transform2D start_; ///< start of the blended frame
	godot::Transform2D points_start_; ///< frame of the points before the step
};

} // namespace softbody
