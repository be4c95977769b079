// SPDX-License-Identifier: MIT
// The forces on a body's points, as a function of positions and velocities, for any scalar type.
#pragma once

#include "core/base/constants.h"
#include "core/dynamics/elastic_lanes.h"
#include "core/dynamics/pressure_lanes.h"
#include "core/dynamics/triangle_lanes.h"
#include "core/model/body_frame.h"
#include "core/model/body_lanes.h"

#include <span>

namespace softbody {

/// Adds the springs' forces: F = (k (|d| - l) + c (v2 - v1)·e) e on the first point, -F on the second (thesis eq. 3.12
/// and 3.16, the latter corrected to a vector). A spring shorter than DEGENERATE_LENGTH of its rest length has no
/// direction and adds nothing. The scales multiply stiffness and damping.
template <class T>
void add_spring_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces) {
	const T stiffness = body.coefficients.spring_stiffness_scale;
	const T damping = body.coefficients.spring_damping_scale;
	for (const Spring2D &spring : body.shape.springs()) {
		const BasicVec2<T> d = positions[spring.b] - positions[spring.a];
		const T current = length(d);
		const auto has_direction = current > T(DEGENERATE_LENGTH * spring.rest_length);
		const BasicVec2<T> e = d * (T(1) / current);
		const T rate = dot(velocities[spring.b] - velocities[spring.a], e);
		const T size = T(spring.stiffness) * stiffness * (current - T(spring.rest_length)) + T(spring.damping) * damping * rate;
		const BasicVec2<T> force = select(has_direction, e * size, BasicVec2<T>{});
		forces[spring.a] += force;
		forces[spring.b] -= force;
	}
}

/// Adds shape matching: m k_s / mean(m) (c + R q - x) on each point, and damping of the motion relative to the rigid
/// one (Müller et al. 2005, as a force; Müller et al. 2007, sec. 3.5). With weights proportional to mass the forces and
/// their torques about the center of mass sum to zero, and the highest frequency added is sqrt(k_s / mean(m)) whatever
/// the masses.
template <class T>
void add_shape_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces) {
	const SoftBodyShape &shape = body.shape;
	const T per_mass(Real(shape.point_count()) / shape.total_mass());
	const T stiffness = body.coefficients.shape_stiffness * per_mass;
	const T damping = body.coefficients.shape_damping * per_mass;
	const BasicBodyFrame<T> frame = measure_frame<T>(shape, body.rotation_memory, positions, velocities);
	const auto pull_on = [&](std::size_t i) {
		const BasicVec2<T> arm = positions[i] - frame.center;
		const BasicVec2<T> strain = frame.rotation.apply(in_all_lanes<T>(shape.rest_positions()[i])) - arm;
		const BasicVec2<T> drift = frame.velocity + perpendicular(arm) * frame.angular_velocity - velocities[i];
		return strain * stiffness + drift * damping;
	};
	// The mean pull is zero except for the rounding of the center and of the rest positions. That remainder turns with
	// the body and drives it like a motor, so it is subtracted.
	BasicVec2<T> mean;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		mean += pull_on(i) * shape.masses()[i];
	}
	mean *= 1 / shape.total_mass();
	for (std::size_t i = 0; i < positions.size(); ++i) {
		forces[i] += (pull_on(i) - mean) * shape.masses()[i];
	}
}

/// Adds up all forces at the given state (thesis eq. 3.7): gravity, springs with projected damping, pressure, shape
/// matching, elastic modes or triangles, and `external`. The area term is not a force (`hold_area`). `positions` and
/// `velocities` have one entry a point, `external` one a point or none; `forces` [mass·length/s²] is overwritten. Of
/// the body only the model is read. O(points + springs).
template <class T>
void evaluate_forces(const BodyModel<T> &body, Vec2 gravity, std::span<const BasicVec2<T>> external,
		std::span<const BasicVec2<T>> positions, std::span<const BasicVec2<T>> velocities,
		std::span<BasicVec2<T>> forces) {
	const SoftBodyShape &shape = body.shape;
	const BodySettings &settings = body.settings;
	const Vec2 acceleration = gravity * settings.gravity_scale;
	for (std::size_t i = 0; i < forces.size(); ++i) {
		forces[i] = in_all_lanes<T>(acceleration * shape.masses()[i]);
	}
	for (std::size_t i = 0; i < external.size(); ++i) {
		forces[i] += external[i];
	}
	if (settings.has_springs()) {
		add_spring_forces<T>(body, positions, velocities, forces);
	}
	if (settings.is_elastic() && shape.modes() != nullptr) {
		add_mode_forces<T>(body, positions, velocities, forces);
	}
	if (has_triangles(shape, settings)) {
		add_triangle_forces<T>(body, positions, velocities, forces);
	}
	if (settings.pressure_stiffness > 0) {
		add_pressure_forces<T>(shape, settings, positions, forces);
	}
	if (settings.matches_shape()) {
		add_shape_forces<T>(body, positions, velocities, forces);
	}
}

} // namespace softbody
