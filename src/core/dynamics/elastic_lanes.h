// SPDX-License-Identifier: MIT
// The forces of a body's elastic modes, for any scalar type: included where they are instantiated.
#pragma once

#include "core/model/body_frame.h"
#include "core/model/body_lanes.h"

#include <array>
#include <span>

namespace softbody {

/// Stiffness of deformation in no mode over that of the stiffest mode [1]. Omitted modes grow ever stiffer. Larger:
/// more substeps. Smaller: a single point is pressed in more easily than in the solid.
inline constexpr Real REST_STIFFNESS = 2;

/// Least share of the rest inertia in the turning of a body's frame [1]: a body turned inside out has no frame.
inline constexpr Real LEAST_REACH = Real(0.25);

/// Stiffness of each mode of a material, and of deformation in no mode [force/length].
template <class T>
struct ModeStiffness {
	std::array<T, MAX_ELASTIC_MODES> modes;
	T rest = T(0);
};

/// Precondition of the next two: `poisson_ratio` and `shear_modulus` are those of a valid body.
template <class T>
ModeStiffness<T> mode_stiffness(const ElasticModes &modes, Real poisson_ratio, T shear_modulus) {
	const std::array<Real, 3> weights = mode_weights(poisson_ratio);
	ModeStiffness<T> result;
	for (std::size_t j = 0; j < modes.count; ++j) {
		const std::array<Real, 3> &known = modes.stiffness[j];
		result.modes[j] = shear_modulus * T(weights[0] * known[0] + weights[1] * known[1] + weights[2] * known[2]);
		result.rest = greater(result.modes[j], result.rest);
	}
	result.rest *= T(REST_STIFFNESS);
	return result;
}

inline ModeStiffness<Real> mode_stiffness(const ElasticModes &modes, const BodySettings &settings) {
	return mode_stiffness<Real>(modes, settings.poisson_ratio, settings.shear_modulus);
}

/// Adds the forces of the elastic modes (modal analysis in the frame that turns with the body; Terzopoulos and Witkin
/// 1988, Pentland and Williams 1989). With y the displacement from the rest shape in that frame, less its dilation, s
/// the mass shares, φ the modes and z = sum s φ·y their amplitudes, the energy is (k_rest sum s |y|² + sum (k_j -
/// k_rest) z_j²) / 2. Damping counts β times the rate of y as displacement. Forces and their torques sum to zero, up to
/// rounding, unless the body is turned inside out. Precondition: the shape has modes. O(points · modes).
template <class T>
void add_mode_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces) {
	const SoftBodyShape &shape = body.shape;
	const ElasticModes &modes = *shape.modes();
	const ModeStiffness<T> stiffness = mode_stiffness<T>(modes, body.settings.poisson_ratio, body.coefficients.shear_modulus);
	const BasicBodyFrame<T> frame = measure_frame<T>(shape, body.rotation_memory, positions, velocities);
	const T damping = body.coefficients.elastic_damping_time;
	const Real per_mass = 1 / shape.total_mass();
	const auto displacement = [&](std::size_t i) {
		const BasicVec2<T> arm = positions[i] - frame.center;
		const BasicVec2<T> drift = velocities[i] - frame.velocity - perpendicular(arm) * frame.angular_velocity;
		return frame.rotation.apply_inverse(arm + drift * damping) - in_all_lanes<T>(shape.rest_positions()[i]);
	};
	std::array<T, MAX_ELASTIC_MODES> amplitudes;
	amplitudes.fill(T(0));
	T dilation = T(0);
	T along = T(0);
	for (std::size_t i = 0; i < positions.size(); ++i) {
		const BasicVec2<T> y = displacement(i);
		const std::span<const Vec2> mode = modes.shape_of_point(i);
		for (std::size_t j = 0; j < mode.size(); ++j) {
			amplitudes[j] += T(mode[j].x) * y.x + T(mode[j].y) * y.y;
		}
		if (i < shape.hull_count()) {
			dilation += dot(in_all_lanes<T>(modes.dilation[i]), y);
		}
		along += dot(in_all_lanes<T>(shape.rest_positions()[i] * (shape.masses()[i] * per_mass)), y);
	}
	along -= dilation * T(shape.rest_inertia() * per_mass);
	T along_force = along * stiffness.rest;
	for (std::size_t j = 0; j < modes.count; ++j) {
		const T overlap(modes.dilation_overlap[j]);
		amplitudes[j] = (amplitudes[j] - dilation * overlap) * (stiffness.modes[j] - stiffness.rest);
		along_force += amplitudes[j] * overlap;
	}
	BasicVec2<T> sum;
	T torque = T(0);
	T reach = T(0); // sum m x · R q, over the inertia
	for (std::size_t i = 0; i < positions.size(); ++i) {
		const BasicVec2<T> rest = in_all_lanes<T>(shape.rest_positions()[i]);
		const BasicVec2<T> y = displacement(i) - rest * dilation;
		BasicVec2<T> force = y * (stiffness.rest * T(shape.masses()[i] * per_mass));
		const std::span<const Vec2> mode = modes.shape_of_point(i);
		for (std::size_t j = 0; j < mode.size(); ++j) {
			force += BasicVec2<T>{ T(mode[j].x) * amplitudes[j], T(mode[j].y) * amplitudes[j] };
		}
		if (i < shape.hull_count()) {
			force -= in_all_lanes<T>(modes.dilation[i]) * along_force;
		}
		const BasicVec2<T> arm = frame.rotation.apply_inverse(positions[i] - frame.center);
		torque -= cross(arm, force);
		reach += dot(arm, rest) * T(shape.masses()[i]);
		force = frame.rotation.apply(force);
		forces[i] -= force;
		sum += force;
	}
	// The frame turns with the points: the slope of the energy by its angle is the torque found so far, and the slope
	// of its angle by a point is m R q / reach, turned by a right angle. With both, the forces have no torque.
	const T least(LEAST_REACH * shape.rest_inertia());
	const T turn = torque / select(reach > least, reach, least);
	// The rounding of the sum would turn with the body and drive it.
	for (std::size_t i = 0; i < positions.size(); ++i) {
		const BasicVec2<T> across = perpendicular(frame.rotation.apply(in_all_lanes<T>(shape.rest_positions()[i])));
		forces[i] += sum * T(shape.masses()[i] * per_mass) - across * (turn * T(shape.masses()[i]));
	}
}

} // namespace softbody
