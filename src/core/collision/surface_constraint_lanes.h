// SPDX-License-Identifier: MIT
// Contacts of borders with the points of bodies, for any scalar type. Included where it is instantiated.
#pragma once

#include "core/collision/surface_constraint.h"
#include "core/geometry/round_outline.h"
#include "core/model/body_frame.h"

namespace softbody {

/// Solves the contacts of a border with the round edges of bodies (`SoftBodyShape::bulges`), where they bulge deeper than
/// both ends. The ends share all changes by inverse mass, as in `PointOnEdge`.
template <class T>
void solve_round_edges(const BodyLanes<T> &body, const Border &border, Real h, BasicContactLoad<T> &load,
		std::span<BasicPointSolution<T>> solutions) {
	const Surface &surface = border.surface;
	const Real friction = combined_friction(body.model.settings, surface);
	const Real restitution = combined_restitution(body.model.settings, surface);
	const BasicVec2<T> normal = in_all_lanes<T>(border.plane.normal);
	const BasicVec2<T> position = in_all_lanes<T>(border.plane.position);
	const std::span<BasicVec2<T>> x = body.positions;
	const std::span<BasicVec2<T>> v = body.velocities;
	const std::span<const Real> bulges = body.model.shape.bulges();
	const std::size_t count = bulges.size();
	for (std::size_t a = 0; a < count; ++a) {
		const std::size_t b = a + 1 < count ? a + 1 : 0;
		const T at_a = dot(normal, x[a] - position);
		const T at_b = dot(normal, x[b] - position);
		const Real lighter = std::max(body.inverse_masses[a], body.inverse_masses[b]);
		if (!(bulges[a] > 0) || lighter == 0 || !any(at_a + at_b < T(4 * bulges[a]))) {
			continue;
		}
		const OutlineEdge<T> edge{ x[a > 0 ? a - 1 : count - 1], x[a], x[b], x[b + 1 < count ? b + 1 : 0] };
		const T bulge = present_bulge(edge, bulges[a]);
		const auto is_round = both(bulge > T(LEAST_BULGE * bulges[a]), dot(normal, perpendicular(x[b] - x[a])) > T(0));
		const T t = deepest_share(at_a, at_b, select(is_round, bulge, T(bulges[a])));
		const T distance = at_a + (at_b - at_a) * t - height_of_bulge(t, bulge);
		const auto is_inside = both(both(is_round, distance < T(0)), both(t > T(0), t < T(1)));
		if (!any(is_inside)) {
			continue;
		}
		const T share_b = select(is_inside, t, T(0));
		const T share_a = T(1) - share_b;
		const T by_a = T(body.inverse_masses[a]) * share_a;
		const T by_b = T(body.inverse_masses[b]) * share_b;
		const T inverse_mass = greater(by_a * share_a + by_b * share_b, T(LEAST_EDGE_INVERSE_MASS * lighter));
		const BasicVec2<T> place = x[a] * share_a + x[b] * share_b;
		const BasicVec2<T> relative = v[a] * share_a + v[b] * share_b - surface.velocity_at(place);
		const T normal_change = select(is_inside, greater(-dot(relative, normal), T(0)), T(0));
		const ContactChange<T> change =
				contact_change(relative, normal, select(is_inside, -distance, T(0)), normal_change, friction, h);
		x[a] += change.position * (by_a / inverse_mass);
		x[b] += change.position * (by_b / inverse_mass);
		v[a] += change.velocity * (by_a / inverse_mass);
		v[b] += change.velocity * (by_b / inverse_mass);
		const T impulse = normal_change / inverse_mass;
		load.contacts += select(is_inside, T(1), T(0));
		load.add(impulse, normal, dot(change.velocity, perpendicular(normal)) / inverse_mass, place, surface, restitution);
		if (!solutions.empty()) {
			const auto is_nearer_a = t < T(Real(0.5));
			const auto note = [&](BasicPointSolution<T> &end, auto is_nearest) {
				end.depth = select(both(is_inside, is_nearest), greater(end.depth, -distance), end.depth);
				end.normal_impulse += select(is_nearest, impulse, T(0));
			};
			note(solutions[a], is_nearer_a);
			note(solutions[b], !is_nearer_a);
		}
	}
}

template <class T>
void solve_border(const BodyLanes<T> &body, const Border &border, Real bounce_threshold, Real h,
		BasicContactLoad<T> &load, std::span<BasicPointSolution<T>> solutions) {
	const Surface &surface = border.surface;
	const Real friction = combined_friction(body.model.settings, surface);
	const Real restitution = combined_restitution(body.model.settings, surface);
	const Real of_points = bounces_by_points(body.model.shape, body.model.settings) ? restitution : Real(0);
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
		if (load.is_summed || !solutions.empty()) {
			const T impulse = normal_change * T(1 / body.inverse_masses[i]);
			const T sliding = dot(change.velocity, perpendicular(normal)) * T(1 / body.inverse_masses[i]);
			load.add(impulse, normal, sliding, x, surface, restitution);
			if (!solutions.empty()) {
				solutions[i] = { depth, impulse };
			}
		}
	}
	if (has_round_edges(body.model.shape, body.model.settings)) {
		solve_round_edges<T>(body, border, h, load, solutions);
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
