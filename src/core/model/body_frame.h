// SPDX-License-Identifier: MIT
// The rigid motion hidden in a deformed body: its center, orientation, velocity and spin.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

/// Best-fitting rigid motion of a body, weighted by mass; of several bodies side by side for T = `RealPack`.
template <class T>
struct BasicBodyFrame {
	BasicVec2<T> center; ///< center of mass [length]
	BasicVec2<T> velocity; ///< of the center of mass [length/s]
	BasicRotation<T> rotation; ///< of the rest shape onto the points, least squares
	MaskOf<T> rotation_defined; ///< false when the points fit every rotation equally well
	T inertia = T(0); ///< about the center, as the points lie [mass·length²]
	T angular_velocity = T(0); ///< angular momentum over `inertia` [rad/s]
};
using BodyFrame = BasicBodyFrame<Real>;

/// The part of a frame that takes no rotation: the center of mass and its velocity.
template <class T>
struct BasicTranslation {
	BasicVec2<T> center; ///< [length]
	BasicVec2<T> velocity; ///< [length/s]
};
using Translation = BasicTranslation<Real>;

/// Measures the translation of any state of a body's points, with the same bits as `measure_frame`. O(points), in less
/// than half of its time.
template <class T>
BasicTranslation<T> measure_translation(const SoftBodyShape &shape, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities);
Translation measure_translation(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities);
Translation measure_translation(const SoftBodyData &body);

/// Measures the frame of any state of a body's points. The rotation minimizes sum m |x - c - R q|², which in 2D is
/// atan2(sum m q×x, sum m q·x) (Müller et al. 2005, sec. 3.3). Where it is undefined (every rotation may fit a mirrored
/// or collapsed body equally well), the rotation is `memory`, the body's last defined one. O(points).
template <class T>
BasicBodyFrame<T> measure_frame(const SoftBodyShape &shape, const BasicRotation<T> &memory,
		std::span<const BasicVec2<T>> positions, std::span<const BasicVec2<T>> velocities);

BodyFrame measure_frame(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities);
BodyFrame measure_frame(const SoftBodyData &body);

} // namespace softbody
