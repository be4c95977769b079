// SPDX-License-Identifier: MIT
// The rigid motion hidden in a deformed body: its centre, orientation, velocity and spin.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

namespace softbody {

/// Best-fitting rigid motion of a body, weighted by mass.
struct BodyFrame {
	Vec2 centre; ///< centre of mass [length]
	Vec2 velocity; ///< of the centre of mass [length/s]
	Rotation rotation; ///< of the rest shape onto the points, least squares
	bool rotation_defined = true; ///< false when the points fit every rotation equally well
	Real angular_velocity = 0; ///< angular momentum over current inertia [rad/s]
};

/// Measures the frame of any state of a body's points: the rotation that minimises
/// sum m |x - c - R q|², which in 2D is atan2(sum m q×x, sum m q·x) (Müller et al. 2005, sec. 3.3).
/// Where that is undefined (a mirrored or collapsed body can fit every rotation alike), the body's
/// last defined rotation is returned. O(points).
BodyFrame measure_frame(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities);
BodyFrame measure_frame(const SoftBodyData &body);

} // namespace softbody
