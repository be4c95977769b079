// SPDX-License-Identifier: MIT
// Contacts of borders with the points of bodies, for any scalar type. Included where it is instantiated.
#pragma once

#include "core/collision/surface_constraint.h"
#include "core/model/body_frame.h"

#include <type_traits>

namespace softbody {

template <class T>
void solve_border(const BodyLanes<T> &body, const Border &border, Real bounce_threshold, Real h,
		BasicContactLoad<T> &load, std::span<BasicPointSolution<T>> solutions) {
	const Surface &surface = border.surface;
	const Real friction = combined_friction(body.model.settings, surface);
	const Real restitution = combined_restitution(body.model.settings, surface);
	const Real of_points = bounces_by_points(body.model.shape, body.model.settings) ? restitution : Real(0);
	// Bodies in SIMD lanes have no bounce to remember.
	const bool load_matters = std::is_same_v<T, Real> || body.model.settings.rolling_resistance > 0;
	const BasicVec2<T> normal = in_all_lanes<T>(border.plane.normal);
	const BasicVec2<T> position = in_all_lanes<T>(border.plane.position);
	for (std::size_t i = 0; i < body.model.shape.hull_count(); ++i) {
		BasicVec2<T> &x = body.positions[i];
		BasicVec2<T> &v = body.velocities[i];
		const T distance = dot(normal, x - position);
		const auto is_inside = distance < T(0);
		if (!any(is_inside) || body.inverse_masses[i] == 0) {
			continue;
		}
		const BasicVec2<T> relative = v - surface.velocity_at(x);
		const T approach = -dot(relative, normal);
		const T normal_change = select(both(is_inside, approach > T(0)),
				approach + rebound_speed(approach, of_points, bounce_threshold), T(0));
		const T depth = select(is_inside, -distance, T(0));
		const ContactChange<T> change = contact_change(relative, normal, depth, normal_change, friction, h);
		x += change.position;
		v += change.velocity;
		load.contacts += select(is_inside, T(1), T(0));
		if (load_matters || !solutions.empty()) {
			const T impulse = normal_change * T(1 / body.inverse_masses[i]);
			const T sliding = dot(change.velocity, perpendicular(normal)) * T(1 / body.inverse_masses[i]);
			load.add(impulse, normal, sliding, x, surface, restitution);
			if (!solutions.empty()) {
				solutions[i] = { depth, impulse };
			}
		}
	}
}

template <class T>
void resist_rolling(const BodyLanes<T> &body, const BasicContactLoad<T> &load) {
	const SoftBodyShape &shape = body.model.shape;
	const Real resistance = body.model.settings.rolling_resistance;
	const auto is_loaded = load.normal_impulse > T(0);
	if (!(resistance > 0) || !any(is_loaded)) {
		return;
	}
	const BasicBodyFrame<T> frame =
			measure_frame<T>(shape, body.model.rotation_memory, body.positions, body.velocities);
	const T spin = frame.angular_velocity - load.surface_spin / load.normal_impulse;
	const T most = T(resistance * shape.radius()) * load.normal_impulse / frame.inertia;
	const T change = select(both(is_loaded, frame.inertia > T(0)), -greater(-most, lesser(spin, most)), T(0));
	for (std::size_t i = 0; i < shape.point_count(); ++i) {
		if (body.inverse_masses[i] > 0) {
			body.velocities[i] += perpendicular(body.positions[i] - frame.center) * change;
		}
	}
}

} // namespace softbody
