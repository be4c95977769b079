// SPDX-License-Identifier: MIT
// Least-squares rigid motion of deformed bodies, for any scalar type: included where it is instantiated.
#pragma once

#include "core/base/constants.h"
#include "core/model/body_frame.h"

#include <limits>

namespace softbody {

template <class T>
BasicTranslation<T> measure_translation(const SoftBodyShape &shape, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities) {
	const std::span<const Real> masses = shape.masses();
	const BasicVec2<T> base = positions[0]; // sums relative to a point of the body keep digits far from the origin
	BasicVec2<T> center;
	BasicVec2<T> velocity;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		center += (positions[i] - base) * masses[i];
		velocity += velocities[i] * masses[i];
	}
	return { base + center * (1 / shape.total_mass()), velocity * (1 / shape.total_mass()) };
}

template <class T>
BasicBodyFrame<T> measure_frame(const SoftBodyShape &shape, const BasicRotation<T> &memory,
		std::span<const BasicVec2<T>> positions, std::span<const BasicVec2<T>> velocities) {
	const std::span<const Real> masses = shape.masses();
	const std::span<const Vec2> rest = shape.rest_positions();
	const BasicTranslation<T> translation = measure_translation<T>(shape, positions, velocities);
	BasicBodyFrame<T> frame;
	frame.center = translation.center;
	frame.velocity = translation.velocity;

	T along = T(0); // sum m q·r, proportional to the cosine
	T across = T(0); // sum m q×r, proportional to the sine
	T spin = T(0);
	for (std::size_t i = 0; i < positions.size(); ++i) {
		const BasicVec2<T> arm = positions[i] - frame.center;
		const BasicVec2<T> q = in_all_lanes<T>(rest[i] * masses[i]);
		along += dot(q, arm);
		across += cross(q, arm);
		spin += T(masses[i]) * cross(arm, velocities[i] - frame.velocity);
		frame.inertia += T(masses[i]) * length_squared(arm);
	}
	const T size = sqrt(along * along + across * across);
	const T least(DEGENERATE_LENGTH * shape.rest_inertia());
	frame.rotation_defined = both(size > least, size < T(std::numeric_limits<Real>::max()));
	frame.rotation.c = select(frame.rotation_defined, along / size, memory.c);
	frame.rotation.s = select(frame.rotation_defined, across / size, memory.s);
	frame.angular_velocity = select(frame.inertia > least, spin / frame.inertia, T(0));
	return frame;
}

} // namespace softbody
