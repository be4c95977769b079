// SPDX-License-Identifier: MIT
// Damping of the motion of a body as a whole, for any scalar type.
#pragma once

#include "core/base/elementary.h"
#include "core/model/body_frame.h"
#include "core/model/body_lanes.h"

namespace softbody {

/// Damps velocity and spin of a body as a whole by `linear_damp` and `angular_damp` over `h` [s]: by exp(-damp h),
/// independent of the number of substeps. Motion relative to the rigid one and pinned points are unchanged. Several
/// bodies side by side get the bits of each alone. O(points).
template <class T>
void damp_rigid_motion(const BodyLanes<T> &body, Real h) {
	const BodySettings &settings = body.model.settings;
	const auto frame = measure_frame<T>(body.model.shape, body.model.rotation_memory, body.positions, body.velocities);
	const Real lost = Real(-exponential_minus_one(-double(settings.linear_damp) * double(h)));
	const Real lost_spin = Real(-exponential_minus_one(-double(settings.angular_damp) * double(h)));
	const BasicVec2<T> brake = frame.velocity * T(-lost);
	const T turn_back = frame.angular_velocity * T(-lost_spin);
	for (std::size_t i = 0; i < body.velocities.size(); ++i) {
		if (body.inverse_masses[i] != 0) {
			body.velocities[i] += brake + perpendicular(body.positions[i] - frame.center) * turn_back;
		}
	}
}

} // namespace softbody
