// SPDX-License-Identifier: MIT
// Strong deformations of a body, seeded, to see whether it finds its shape again.
#pragma once

#include "core/dynamics/energy.h"
#include "core/model/body_frame.h"
#include "core/model/soft_body_data.h"
#include "support/compare.h"
#include "support/random.h"

#include <cmath>

namespace softbody::testing {

/// What was done to the body; `deform` takes them in turn.
enum class Deformation { FLATTENED,
	PUSHED_THROUGH,
	CRUMPLED,
	MIRRORED };
inline constexpr int DEFORMATION_COUNT = 4;

/// Replaces the positions and stops the points. Flattened: to a tenth of its height along a random
/// direction. Pushed through: one or two hull points beyond the center to the other side. Crumpled:
/// every point anywhere in the circle. Mirrored: reflected along a random direction, the state of
/// equal spring energy that springs alone never leave.
inline void deform(SoftBodyData &body, Deformation kind, Random &random) {
	const SoftBodyShape &shape = body.shape();
	const Vec2 center = measure_frame(body).center;
	const Rotation turn = Rotation::from_angle(random.real(0, 6.283));
	const std::size_t first = std::size_t(random.integer(0, int(shape.hull_count()) - 1));
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		Vec2 q = shape.rest_positions()[i];
		const Vec2 noise = random.vector(0.02 * shape.radius());
		switch (kind) {
			case Deformation::FLATTENED:
				q = turn.apply_inverse(q);
				q = turn.apply({ q.x, q.y / 10 });
				break;
			case Deformation::PUSHED_THROUGH:
				if (i == first || i == (first + 1) % shape.hull_count()) {
					q = q * Real(-1.2);
				}
				break;
			case Deformation::CRUMPLED:
				q = random.vector(0.7 * shape.radius());
				break;
			case Deformation::MIRRORED:
				q = turn.apply_inverse(q);
				q = turn.apply({ q.x, -q.y });
				break;
		}
		body.set_point(std::uint32_t(i), center + q + noise, {});
	}
}

/// Largest distance of a point from its place in the best-fitting copy of the rest shape [length]. A
/// mirrored body is far from every rotated copy, so it counts as deformed.
inline double deviation_from_rest(const SoftBodyData &body) {
	const BodyFrame frame = measure_frame(body);
	double largest = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const Vec2 goal = frame.center + frame.rotation.apply(body.shape().rest_positions()[i]);
		largest = std::fmax(largest, distance(goal, body.positions()[i]));
	}
	return largest;
}

inline double largest_speed(const SoftBodyData &body) {
	double largest = 0;
	for (const Vec2 v : body.velocities()) {
		largest = std::fmax(largest, double(length(v)));
	}
	return largest;
}

} // namespace softbody::testing
