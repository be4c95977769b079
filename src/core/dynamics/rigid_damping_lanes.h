// SPDX-License-Identifier: MIT
// Damping of the rigid part of bodies' motion, for any scalar type: included where it is instantiated.
#pragma once

#include "core/dynamics/rigid_damping.h"
#include "core/model/body_frame.h"

#include <cmath>

namespace softbody {

template <class T>
void damp_rigid_motion(const BodyLanes<T> &body, Real h) {
	const BodySettings &settings = body.model.settings;
	const auto frame = measure_frame<T>(body.model.shape, body.model.rotation_memory, body.positions, body.velocities);
	const Real lost = Real(-std::expm1(-double(settings.linear_damp) * double(h)));
	const Real lost_spin = Real(-std::expm1(-double(settings.angular_damp) * double(h)));
	const BasicVec2<T> brake = frame.velocity * T(-lost);
	const T turn_back = frame.angular_velocity * T(-lost_spin);
	for (std::size_t i = 0; i < body.velocities.size(); ++i) {
		if (body.inverse_masses[i] != 0) {
			body.velocities[i] += brake + perpendicular(body.positions[i] - frame.center) * turn_back;
		}
	}
}

} // namespace softbody
