// SPDX-License-Identifier: MIT
// Least-squares rigid motion of a deformed body.
#include "core/model/body_frame.h"

#include "core/model/body_frame_lanes.h"

namespace softbody {

template BodyFrame measure_frame<Real>(const SoftBodyShape &, const Rotation &, std::span<const Vec2>,
		std::span<const Vec2>);

BodyFrame measure_frame(const SoftBodyData &body, std::span<const Vec2> positions,
		std::span<const Vec2> velocities) {
	return measure_frame<Real>(body.shape(), body.rotation_memory(), positions, velocities);
}

BodyFrame measure_frame(const SoftBodyData &body) {
	return measure_frame(body, body.positions(), body.velocities());
}

Translation measure_translation(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities) {
	return measure_translation<Real>(body.shape(), positions, velocities);
}

Translation measure_translation(const SoftBodyData &body) {
	return measure_translation(body, body.positions(), body.velocities());
}

} // namespace softbody
