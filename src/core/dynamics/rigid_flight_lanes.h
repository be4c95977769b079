// SPDX-License-Identifier: MIT
// The step of bodies as rigid ones, for any scalar type. Included where it is instantiated.
#pragma once

#include "core/base/constants.h"
#include "core/collision/surface_constraint.h"
#include "core/dynamics/rigid_flight.h"
#include "core/model/body_frame_lanes.h"

#include <cstddef>
#include <type_traits>

namespace softbody {

/// Value of a lane of a scalar, of a vector or of a mask.
template <class T>
Real scalar_in_lane(const T &value, std::size_t lane) {
	if constexpr (std::is_same_v<T, Real>) {
		return value;
	} else {
		return value[lane];
	}
}
template <class T>
Vec2 vector_in_lane(const BasicVec2<T> &value, std::size_t lane) {
	return { scalar_in_lane<T>(value.x, lane), scalar_in_lane<T>(value.y, lane) };
}
template <class T>
bool mask_in_lane(const MaskOf<T> &mask, std::size_t lane) {
	if constexpr (std::is_same_v<T, Real>) {
		return mask;
	} else {
		return mask[lane];
	}
}

/// A rigid motion over a step.
template <class T>
struct BasicFlightMotion {
	BasicVec2<T> way; ///< of the center [length]
	BasicVec2<T> velocity; ///< at the end [length/s]
	T spin = T(0); ///< at the end [rad/s]
	T turn = T(0); ///< [rad]
};

/// Goes through the substeps as the body's method does, but with three degrees of freedom.
template <class T>
BasicFlightMotion<T> motion_ahead(const BasicBodyFrame<T> &frame, const FlightSlice &slice) {
	BasicFlightMotion<T> motion;
	motion.velocity = frame.velocity;
	motion.spin = frame.angular_velocity;
	const BasicVec2<T> gain = in_all_lanes<T>(slice.acceleration * slice.h);
	for (int i = 0; i < slice.substeps; ++i) {
		motion.way += (motion.velocity + gain * T(slice.early)) * T(slice.h);
		motion.turn += motion.spin * T(slice.h);
		motion.velocity += gain;
		motion.velocity -= motion.velocity * T(slice.lost);
		motion.spin -= motion.spin * T(slice.lost_spin);
	}
	return motion;
}

/// Moves those lanes of the bodies that may fly. The positions and velocities of the other lanes are then of no use. Without a lane that
/// flies nothing is written.
template <class T>
FlightResult fly_lanes(const BodyLanes<T> &bodies, const FlightSlice &slice, FlightGate &gate) {
	const SoftBodyShape &shape = bodies.model.shape;
	const Real radius = shape.radius();
	const auto frame = measure_frame<T>(shape, bodies.model.rotation_memory, bodies.positions, bodies.velocities);
	T farthest = T(0);
	T fastest = T(0);
	T outermost = T(0);
	// A NaN anywhere makes the sums of the frame NaN, and then no comparison below holds.
	for (std::size_t i = 0; i < bodies.positions.size(); ++i) {
		const BasicVec2<T> arm = bodies.positions[i] - frame.center;
		const BasicVec2<T> place = frame.rotation.apply(in_all_lanes<T>(shape.rest_positions()[i]));
		const BasicVec2<T> wobble = bodies.velocities[i] - frame.velocity - perpendicular(arm) * frame.angular_velocity;
		farthest = greater(farthest, length_squared(arm - place));
		fastest = greater(fastest, length_squared(wobble));
		outermost = greater(outermost, length_squared(arm));
	}
	const Real strain = FLIGHT_STRAIN * radius;
	const Real rate = FLIGHT_STRAIN_RATE * radius;
	const T most_spin = bodies.model.coefficients.shear_modulus * T(4 * FLIGHT_STRAIN * shape.rest_area() / shape.rest_inertia());
	MaskOf<T> may = both(frame.rotation_defined, farthest < T(strain * strain));
	may = both(may, fastest < T(rate * rate));
	may = both(may, frame.angular_velocity * frame.angular_velocity < most_spin);
	FlightResult result;
	if (!any(may)) {
		return result;
	}
	const BasicFlightMotion<T> motion = motion_ahead<T>(frame, slice);
	const T fall = T(length(slice.acceleration) * slice.duration);
	const T speed = length(frame.velocity) + fall;
	const T reach = sqrt(outermost) + speed * T(slice.duration) + T(FLIGHT_GAP * radius);
	for (const Border &border : slice.borders) {
		if (is_noticed(bodies.model.settings, border.surface)) {
			may = both(may, dot(frame.center - in_all_lanes<T>(border.plane.position), in_all_lanes<T>(border.plane.normal)) > reach);
		}
	}
	// The turn of twice the angle whose tangent is `half`: exact in length for any value. The series of the tangent ends below the
	// digits of a float for the turns that FLIGHT_STRAIN allows.
	const T quarter = motion.turn * T(Real(0.5));
	const T half = quarter + quarter * quarter * quarter * T(Real(1) / 3);
	const T share = T(2) / (T(1) + half * half);
	const T sine = half * share;
	const T cosine_less_one = T(0) - half * half * share;
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		if (!mask_in_lane<T>(may, lane) || !gate.is_clear(lane, vector_in_lane<T>(frame.center, lane), scalar_in_lane<T>(reach, lane))) {
			continue;
		}
		const Rotation old{ scalar_in_lane<T>(frame.rotation.c, lane), scalar_in_lane<T>(frame.rotation.s, lane) };
		const Vec2 turned = Vec2{ old.c, old.s } * (1 + scalar_in_lane<T>(cosine_less_one, lane)) +
				perpendicular(Vec2{ old.c, old.s }) * scalar_in_lane<T>(sine, lane);
		result.rotations[lane] = { turned.x, turned.y };
		result.speeds[lane] = scalar_in_lane<T>(speed, lane);
		result.flown |= std::uint32_t(1) << lane;
	}
	if (result.flown == 0) {
		return result;
	}
	for (std::size_t i = 0; i < bodies.positions.size(); ++i) {
		const BasicVec2<T> arm = bodies.positions[i] - frame.center;
		const BasicVec2<T> swing = arm * cosine_less_one + perpendicular(arm) * sine;
		bodies.positions[i] += motion.way + swing;
		bodies.velocities[i] = motion.velocity + perpendicular(arm + swing) * motion.spin;
	}
	return result;
}

} // namespace softbody
