// SPDX-License-Identifier: MIT
// Solves a contact of a hull point with another body's hull edge.
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

/// View of a body for contacts between bodies. Valid until the list of bodies is rebuilt.
struct alignas(64) SolverBody { // one cache line holds what most substeps read of a pair that does not touch
	// Set by `measure_extent`.
	Aabb box; ///< around the hull's points, now and before; may be too large by `way`
	Vec2 center; ///< mean of the hull's points, center of a circle around them, now and before
	Real radius = 0; ///< of that circle [length]
	Real way = 0; ///< longest path of a hull point in this substep [length]
	Real path = 0; ///< bound of the path of any hull point in the substeps of this step that have ended [length]
	Real width = 0; ///< of the body's thinner part (SoftBodyShape::width) [length]
	Real inverse_mass = 0; ///< of the body as a whole; 0 when a point is pinned
	Real friction = 0; ///< negative when rough; see `combine_friction`
	std::uint32_t body_index = 0; ///< in `WorldData::soft_bodies()`
	/// Whether the integrator leaves a velocity ahead of the motion of the substep: the velocity includes the forces of
	/// the whole substep, the motion does not.
	bool velocity_leads = false;
	Real implicit_share = 1; ///< share of a change of velocity that the motion of its substep holds (SubstepPlan)
	bool is_monitored = false; ///< BodySettings::contact_monitor
	std::span<Vec2> positions; ///< of all points, the hull's first
	std::span<Vec2> before; ///< hull points at the start of the substep
	std::span<Vec2> velocities;
	std::span<const Real> inverse_masses;
	Real rolling_resistance = 0;
	Real rest_radius = 0; ///< of the shape at rest [length]
	Real pace = 0; ///< highest speed of a point when the step began [length/s]
	// For bounces between bodies.
	Vec2 acceleration; ///< of a body that nothing touches; 0 if it is pinned or rests [length/s²]
	Real pull = 0; ///< magnitude of its acceleration, and at least that of the world's gravity [length/s²]
	Real restitution = 0; ///< negative when absorbent; see `signed_restitution`
	Vec2 mass_velocity; ///< of the mass center when the substep began [length/s]
	Vec2 mass_center; ///< then too; `take_frame` sets it anew
	// Set by `take_frame`; changed by `resist_pair_rolling`.
	Real inertia = 0; ///< about the mass center [mass·length²]
	Real spin = 0; ///< angular velocity [rad/s]
	Real spin_change = 0;

	/// Measure of the body's size for deep contacts, the same from all directions [length].
	Real reach() const { return rest_radius + way; }
	std::span<Vec2> hull() const { return positions.first(before.size()); }
	/// Stores the hull points as `before`, in the first substep of a step.
	void begin_step();
	/// Stores the hull points as `before`, and adds to `path` how far they have come since the last substep began.
	/// O(hull points).
	void begin_substep();
	/// Measures box, circle and way. O(hull points).
	void measure_extent();
	/// Sets mass center, inertia and spin. A pinned body gets inertia 0, which means that it cannot be turned.
	void take_frame(const BodyFrame &frame);
	/// Turns the velocities by the change of spin. O(points).
	void apply_spin_change();
};

/// A hull point of one body inside another.
struct PairContact {
	std::uint32_t point = 0; ///< of the first body
	std::uint32_t edge_start = 0; ///< hull points of the second body
	std::uint32_t edge_end = 0;
	Real t = 0; ///< place on the edge, 0..1
	Vec2 normal; ///< unit, out of the second body
	Real depth = 0; ///< [length], >= 0
	bool is_fresh = false; ///< the point is known to have entered in this substep, so its whole depth is removed
};

/// Solves one contact between two bodies. Point and edge are moved apart along the normal. Of their approach they lose
/// the part that made the depth within this substep of `h` [s]. Friction (`combine_friction`, as Godot combines
/// coefficients) acts by Coulomb's law on the sliding speed, together with the way slid. Restitution is applied to
/// whole bodies (give_back_pair_bounce). Moving apart gives no velocity: overlapping bodies part without a jump. All
/// changes are shared by inverse mass, with opposite impulses in one place, so that linear and angular momentum stay. A
/// depth that exceeds the motion of this substep and DEEP_OVERLAP of the smaller body moves the bodies as wholes, which
/// strains no spring. Overlap older than the substep is removed gradually. Returns the normal impulse [mass·length/s].
/// O(1), or O(points) for a deep overlap. Inline so that contact data stays in registers.
Real solve_pair_contact(SolverBody &body, SolverBody &other, const PairContact &contact, Real h);

/// Rolling resistance between two bodies that pressed on each other with a summed normal impulse J [mass·length/s]: an
/// angular impulse of at most r R J against their relative spin, with r the smaller rolling resistance and R the
/// smaller radius. Equal and opposite, so that angular momentum stays. Changes only `spin` and `spin_change`. O(1).
void resist_pair_rolling(SolverBody &a, SolverBody &b, Real normal_impulse);

/// Moves two crossing bodies apart as wholes, along the unit `direction` from the second to the first, by at most
/// DEEP_OVERLAP of the smaller one. Velocities do not change. Bodies with pinned points do not move; returns false if
/// both have some. O(points).
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
		const Real size = std::min(body.reach(), other.reach());
		const Real fresh = std::max(-dot(relative_way, normal), Real(0));
		if (depth > fresh + DEEP_OVERLAP * size) {
			part_bodies(body, other, normal, depth - fresh);
		}
		push = std::min(depth, fresh + OLD_OVERLAP_PUSH * size);
	}
	// The point met the edge somewhere within the substep. The approach loses the part that made the depth, as
	// velocities derived from the moved positions would. Removing the whole approach at every graze would keep a pile
	// trembling.
	Real deepening = depth / h;
	if (body.velocity_leads || other.velocity_leads) {
		// Forces may have added velocity after the motion of the substep: in an explicit Euler step, all of it. It must
		// be removed too, or piles keep trembling.
		deepening += std::max(approach + dot(relative_way, normal) / h, Real(0));
	}
	// No change if the two already part. Without a branch: half of all contacts part, which no processor can predict.
	const Real normal_change = std::max(Real(0), std::min(approach, deepening));
	const Real friction = combine_friction(body.friction, other.friction);
	const ContactChange<Real> change = contact_change(relative, normal, push, normal_change, friction,
			h * std::min(body.implicit_share, other.implicit_share));
	const Real per_impulse = 1 / inverse_mass;
	const Vec2 shift = change.position * per_impulse;
	const Vec2 impulse = change.velocity * per_impulse;
	// A body that is about to be reset must not affect the other. A sum is finite only if all its terms are, so one
	// test replaces four.
	if (!std::isfinite((shift.x + shift.y) + (impulse.x + impulse.y))) {
		return 0;
	}
	sides.part(body.positions, other.positions, shift);
	sides.part(body.velocities, other.velocities, impulse);
	return normal_change * per_impulse;
}

} // namespace softbody
