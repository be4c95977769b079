// SPDX-License-Identifier: MIT
// Least-squares rigid motion of a deformed body.
#include "core/model/body_frame.h"

#include "core/base/constants.h"

#include <cmath>

namespace softbody {

BodyFrame measure_frame(const SoftBodyData &body, std::span<const Vec2> positions,
		std::span<const Vec2> velocities) {
	const SoftBodyShape &shape = body.shape();
	const std::span<const Real> masses = shape.masses();
	const std::span<const Vec2> rest = shape.rest_positions();
	const Vec2 base = positions[0]; // sums relative to a point of the body keep digits far from the origin
	Vec2 centre;
	Vec2 velocity;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		centre += (positions[i] - base) * masses[i];
		velocity += velocities[i] * masses[i];
	}
	BodyFrame frame;
	frame.centre = base + centre * (1 / shape.total_mass());
	frame.velocity = velocity * (1 / shape.total_mass());

	Real along = 0; // sum m q·r, proportional to the cosine
	Real across = 0; // sum m q×r, proportional to the sine
	Real spin = 0;
	Real inertia = 0;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		const Vec2 arm = positions[i] - frame.centre;
		along += masses[i] * dot(rest[i], arm);
		across += masses[i] * cross(rest[i], arm);
		spin += masses[i] * cross(arm, velocities[i] - frame.velocity);
		inertia += masses[i] * length_squared(arm);
	}
	const Real size = std::hypot(along, across);
	frame.rotation_defined = std::isfinite(size) && size > DEGENERATE_LENGTH * shape.rest_inertia();
	frame.rotation = frame.rotation_defined ? Rotation{ along / size, across / size } : body.rotation_memory();
	frame.angular_velocity = inertia > DEGENERATE_LENGTH * shape.rest_inertia() ? spin / inertia : Real(0);
	return frame;
}

BodyFrame measure_frame(const SoftBodyData &body) {
	return measure_frame(body, body.positions(), body.velocities());
}

} // namespace softbody
