// SPDX-License-Identifier: MIT
// What a contact of a hull point with another body's hull edge does to the three points.
#pragma once

#include "core/base/constants.h"
#include "core/base/vec2.h"
#include "core/collision/point_edge_constraint.h"
#include "core/geometry/aabb.h"
#include "core/model/body_frame.h"
#include "core/model/body_settings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace softbody {

/// What contacts between bodies need of a body. A view that stays valid until bodies are rearranged.
struct alignas(64) SolverBody { // a line of the cache, which a pair that does not touch reads alone
	// As `measure_extent` found them.
	Aabb box; ///< around the hull's points, now and before; up to a way larger
	Vec2 center; ///< of a circle around the same, likewise
	Real radius = 0; ///< of that circle [length]
	Real way = 0; ///< of the fastest hull point in this substep [length]
	Real width = 0; ///< of its thinner part (SoftBodyShape::width) [length]
	Real inverse_mass = 0; ///< of the body as a whole; 0 when a point is pinned
	Real friction = 0; ///< negative when rough; see `combine_friction`
	std::uint32_t body_index = 0; ///< in `WorldData::soft_bodies()`
	/// Whether its integrator leaves a velocity that is ahead of the way just gone, as it holds the forces of the whole
	/// substep and the way does not.
	bool velocity_leads = false;
	bool is_monitored = false; ///< BodySettings::contact_monitor
	std::span<Vec2> positions; ///< of all points, the hull's first
	std::span<Vec2> before; ///< where the hull's points were at the start of the substep
	std::span<Vec2> velocities;
	std::span<const Real> inverse_masses;
	Real rolling_resistance = 0;
	Real rolling_radius = 0; ///< [length]
	// As `take_frame` set them, and what `resist_pair_rolling` has changed since.
	Vec2 mass_center;
	Real inertia = 0; ///< about it [mass·length²]
	Real spin = 0; ///< angular velocity [rad/s]
	Real spin_change = 0;

	std::span<Vec2> hull() const { return positions.first(before.size()); }
	/// Keeps the hull's points as those before.
	void begin_substep();
	/// Measures box, circle and way. O(hull points).
	void measure_extent();
	/// Sets mass center, inertia and spin. A pinned body has no inertia, which stands for what cannot be turned.
	void take_frame(const BodyFrame &frame);
	/// Turns the velocities by the change of spin. O(points).
	void apply_spin_change();
};

/// A hull point of one body inside another, ready to be solved.
struct PairContact {
	std::uint32_t point = 0; ///< of the first body
	std::uint32_t edge_start = 0; ///< hull points of the second body
	std::uint32_t edge_end = 0;
	Real t = 0; ///< place on the edge, 0..1
	Vec2 normal; ///< unit, out of the second body
	Real depth = 0; ///< [length], >= 0
	bool is_fresh = false; ///< the point is known to have come in during this substep, so that all of it is pushed out
};

/// Answers one contact between two bodies: moves point and edge apart along the normal, takes from their approach
/// what brought them so deep within this substep of `h` [s], and takes from the sliding speed what Coulomb's law allows,
/// with the way slid. What bounces does so as a whole (give_back_pair_bounce).
/// Moving apart gives no velocity: bodies that start inside one another part without a jump.
/// All changes are shared out by inverse mass, with impulses equal and opposite in one place, so that linear and
/// angular momentum stay. Friction: `combine_friction`, as Godot combines coefficients.
/// What is deeper than the way of this substep and DEEP_OVERLAP of the smaller body explain is not the points' doing:
/// the bodies part as a whole, which strains no spring; what is older than the substep is undone by and by. Returns the
/// normal impulse [mass·length/s]. O(1), or O(points) where it is deep. Inline, with all that finds a contact: the parts of
/// one do not go through memory then (3 % of a pile's step).
Real solve_pair_contact(SolverBody &body, SolverBody &other, const PairContact &contact, Real h);

/// Brakes the spin of two bodies relative to each other, which pressed on each other with a summed normal impulse J
/// [mass·length/s]: by an angular impulse of at most r R J, with r the smaller rolling resistance and R the smaller
/// radius. Equal and opposite, so that angular momentum stays. Changes `spin` and `spin_change` only. O(1).
void resist_pair_rolling(SolverBody &a, SolverBody &b, Real normal_impulse);

/// Moves two bodies that lie across each other apart as wholes, along the unit `direction` from the second to the
/// first, by at most DEEP_OVERLAP of the smaller one. Their velocities stay, and so do bodies with pinned points:
/// false when both are. O(points).
bool part_bodies(SolverBody &body, SolverBody &other, Vec2 direction, Real distance);

inline Real solve_pair_contact(SolverBody &body, SolverBody &other, const PairContact &contact, Real h) {
	const auto &[p, a, b, t, normal, depth, is_fresh] = contact;
	const PointAgainstEdge sides{ p, body.inverse_masses[p], PointOnEdge({ a, b, t }, other.inverse_masses) };
	const Real inverse_mass = sides.inverse_mass();
	if (!(inverse_mass > 0)) {
		return 0; // both pinned
	}
	const Vec2 relative = body.velocities[p] - sides.edge.of(other.velocities);
	const Real approach = -dot(relative, normal);
	const Vec2 edge_way = sides.edge.between(other.positions[a] - other.before[a], other.positions[b] - other.before[b]);
	const Vec2 relative_way = body.positions[p] - body.before[p] - edge_way;
	Real push = depth;
	if (!is_fresh && body.inverse_mass + other.inverse_mass > 0) {
		const Real size = std::min(body.radius, other.radius);
		const Real fresh = std::max(-dot(relative_way, normal), Real(0));
		if (depth > fresh + DEEP_OVERLAP * size) {
			part_bodies(body, other, normal, depth - fresh);
		}
		push = std::min(depth, fresh + OLD_OVERLAP_PUSH * size);
	}
	// The point met the edge somewhere within the substep: what it came too far is what its approach must lose, as
	// velocities that follow from the moved positions would. Taking all of the approach from every graze instead
	// keeps a pile trembling for good (200 bodies, 8 substeps: 1e-3 J each after 16 s instead of 1e-5).
	Real deepening = depth / h;
	if (body.velocity_leads || other.velocity_leads) {
		// What forces have added to the velocity after the way was gone, all of it in an explicit Euler step, would
		// stay otherwise: piles kept 1 J a body.
		deepening += std::max(approach + dot(relative_way, normal) / h, Real(0));
	}
	// Nothing where they part already. No branch: half of all contacts do, and no processor can guess which.
	const Real normal_change = std::max(Real(0), std::min(approach, deepening));
	const ContactChange<Real> change = contact_change(relative, normal, push, normal_change,
			combine_friction(body.friction, other.friction), h);
	const Real per_impulse = 1 / inverse_mass;
	const Vec2 shift = change.position * per_impulse;
	const Vec2 impulse = change.velocity * per_impulse;
	// A body that is about to be reset must not take the other along. A sum is finite only if all of it is: one question
	// for four.
	if (!std::isfinite((shift.x + shift.y) + (impulse.x + impulse.y))) {
		return 0;
	}
	sides.part(body.positions, other.positions, shift);
	sides.part(body.velocities, other.velocities, impulse);
	return normal_change * per_impulse;
}

} // namespace softbody
