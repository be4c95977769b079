// SPDX-License-Identifier: MIT
// Momentum of a body, for tests and charts.
#pragma once

#include "core/model/soft_body_data.h"

namespace softbody {

/// Sums over points, evaluated in double.
struct Momentum {
	double linear_x = 0; ///< [mass·length/s]
	double linear_y = 0;
	double angular = 0; ///< about `origin` [mass·length²/s]
};

inline Momentum measure_momentum(const SoftBodyData &body, Vec2 origin = {}) {
	Momentum momentum;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double mass = body.shape().masses()[i];
		const Vec2 v = body.velocities()[i];
		const Vec2 p = body.positions()[i];
		momentum.linear_x += mass * v.x;
		momentum.linear_y += mass * v.y;
		momentum.angular += mass * ((double(p.x) - origin.x) * v.y - (double(p.y) - origin.y) * v.x);
	}
	return momentum;
}

} // namespace softbody
