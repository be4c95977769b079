// SPDX-License-Identifier: MIT
// Where a body is between two physics ticks.
#pragma once

#include "core/base/vec2.h"

#include <godot_cpp/variant/transform2d.hpp>

#include <span>

namespace softbody {

/// A pose is a frame, the node's global transform, and points in that frame. Blending both apart lets a spinning body
/// turn instead of shrinking. The frames are kept here; the points are those that the core has from before its step and
/// from after it.
class BodyInterpolation {
public:
	/// The body has been stepped; `before` is where the node was until then.
	void begin(const godot::Transform2D &before);
	/// There is nothing to blend: the body is where it is, until it is stepped again.
	void end() { is_moving_ = false; }
	bool is_moving() const { return is_moving_; }

	/// The user has moved the node, and the core the points, of both ends. Where the engine blends the node's transform
	/// (`is_engines`), it goes on from where the node was; otherwise the body is drawn at the new place at once.
	void carry(const godot::Transform2D &from, const godot::Transform2D &to, bool is_engines);

	/// The frame at `fraction` in [0, 1] of the way to `now`.
	godot::Transform2D frame(const godot::Transform2D &now, double fraction) const;
	/// The points in that frame. `before` and `after` are global positions, `local` receives as many.
	void local_points(const godot::Transform2D &now, double fraction, std::span<const Vec2> before,
			std::span<const Vec2> after, std::span<Vec2> local) const;

private:
	bool is_moving_ = false;
	godot::Transform2D start_; ///< from where the frame is blended
	godot::Transform2D points_start_; ///< in which the points before the step are to be read
};

} // namespace softbody
