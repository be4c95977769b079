// SPDX-License-Identifier: MIT
// The forces on a body's points.
#include "core/dynamics/forces.h"

#include "core/base/constants.h"
#include "core/dynamics/pressure.h"
#include "core/model/body_frame.h"

namespace softbody {

void add_spring_forces(const SoftBodyShape &shape, std::span<const Vec2> positions,
		std::span<const Vec2> velocities, std::span<Vec2> forces) {
	for (const Spring2D &spring : shape.springs()) {
		const Vec2 d = positions[spring.b] - positions[spring.a];
		const Real current = length(d);
		if (!(current > DEGENERATE_LENGTH * spring.rest_length)) {
			continue;
		}
		const Vec2 e = d * (1 / current);
		const Real rate = dot(velocities[spring.b] - velocities[spring.a], e);
		const Vec2 force = e * (spring.stiffness * (current - spring.rest_length) + spring.damping * rate);
		forces[spring.a] += force;
		forces[spring.b] -= force;
	}
}

void add_shape_forces(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities,
		std::span<Vec2> forces) {
	const SoftBodyShape &shape = body.shape();
	const Real per_mass = Real(shape.point_count()) / shape.total_mass();
	const Real stiffness = body.settings().shape_stiffness * per_mass;
	const Real damping = body.settings().shape_damping * per_mass;
	const BodyFrame frame = measure_frame(body, positions, velocities);
	const auto pull_on = [&](std::size_t i) {
		const Vec2 arm = positions[i] - frame.centre;
		const Vec2 strain = frame.rotation.apply(shape.rest_positions()[i]) - arm;
		const Vec2 drift = frame.velocity + perpendicular(arm) * frame.angular_velocity - velocities[i];
		return strain * stiffness + drift * damping;
	};
	// The mean pull is zero but for the rounding of the centre and of the rest positions. That rest turns with
	// the body and drives it like a motor (5 mm in 10 s at k = 1e4 in float), so it is taken away.
	Vec2 mean;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		mean += pull_on(i) * shape.masses()[i];
	}
	mean *= 1 / shape.total_mass();
	for (std::size_t i = 0; i < positions.size(); ++i) {
		forces[i] += (pull_on(i) - mean) * shape.masses()[i];
	}
}

void evaluate_forces(const SoftBodyData &body, Vec2 gravity, std::span<const Vec2> external,
		std::span<const Vec2> positions, std::span<const Vec2> velocities, std::span<Vec2> forces) {
	const SoftBodyShape &shape = body.shape();
	const Vec2 acceleration = gravity * body.settings().gravity_scale;
	for (std::size_t i = 0; i < forces.size(); ++i) {
		forces[i] = acceleration * shape.masses()[i] + external[i];
	}
	add_spring_forces(shape, positions, velocities, forces);
	if (body.settings().pressure_stiffness > 0) {
		add_pressure_forces(body, positions, forces);
	}
	if (body.settings().shape_stiffness > 0 || body.settings().shape_damping > 0) {
		add_shape_forces(body, positions, velocities, forces);
	}
}

} // namespace softbody
