// SPDX-License-Identifier: MIT
// What a contact of a hull point with another body's hull edge does to the three points.
#include "core/collision/pair_response.h"

#include "core/base/constants.h"
#include "core/base/pack.h"

#include <algorithm>
#include <cmath>

namespace softbody {

void TouchingBody::begin_substep() {
	std::ranges::copy(hull(), before.begin());
}

void TouchingBody::measure_extent() {
	const std::span<const Vec2> now = hull();
	const std::span<const Vec2> old = before;
	const std::size_t packs = packs_for(now.size());
	PackedAabb around;
	RealPack longest(0);
	for (std::size_t i = 0; i < packs; ++i) {
		const BasicVec2<RealPack> here = pack_of(now, i);
		around.include(here);
		longest = greater(length_squared(here - pack_of(old, i)), longest);
	}
	way = std::sqrt(greatest_lane(longest));
	box = around.joined();
	centre = (box.min + box.max) * Real(0.5);
	const BasicVec2<RealPack> middle = in_all_lanes<RealPack>(centre);
	RealPack farthest(0);
	for (std::size_t i = 0; i < packs; ++i) {
		farthest = greater(length_squared(pack_of(now, i) - middle), farthest);
	}
	// Where the points come from is no farther away than the way of the fastest.
	radius = std::sqrt(greatest_lane(farthest)) + way;
	box = box.grown(way);
}

void TouchingBody::take_frame(const BodyFrame &frame) {
	spin_change = 0;
	mass_centre = frame.centre;
	const bool is_free = inverse_mass > 0; // pinned, it turns about its pins, if at all
	inertia = is_free ? frame.inertia : Real(0);
	spin = is_free ? frame.angular_velocity : Real(0);
}

void TouchingBody::apply_spin_change() {
	if (spin_change == 0) {
		return;
	}
	for (std::size_t i = 0; i < positions.size(); ++i) {
		velocities[i] += perpendicular(positions[i] - mass_centre) * spin_change;
	}
}

void resist_pair_rolling(TouchingBody &a, TouchingBody &b, Real normal_impulse) {
	const Real mobility_a = a.inertia > 0 ? 1 / a.inertia : Real(0);
	const Real mobility_b = b.inertia > 0 ? 1 / b.inertia : Real(0);
	const Real mobility = mobility_a + mobility_b;
	if (!(mobility > 0)) {
		return;
	}
	const Real most = std::min(a.rolling_resistance, b.rolling_resistance) * std::min(a.rolling_radius, b.rolling_radius) *
			normal_impulse;
	const Real impulse = std::clamp((b.spin - a.spin) / mobility, -most, most);
	if (!std::isfinite(impulse)) {
		return; // who is about to be reset must not take the other along
	}
	a.spin += impulse * mobility_a;
	a.spin_change += impulse * mobility_a;
	b.spin -= impulse * mobility_b;
	b.spin_change -= impulse * mobility_b;
}

namespace {

void move(TouchingBody &body, Vec2 shift) {
	for (Vec2 &p : body.positions) {
		p += shift;
	}
	body.box = { body.box.min + shift, body.box.max + shift };
	body.centre += shift;
}

} // namespace

bool part_bodies(TouchingBody &body, TouchingBody &other, Vec2 direction, Real distance) {
	const Real mobility = body.inverse_mass + other.inverse_mass;
	if (!(mobility > 0)) {
		return false;
	}
	const Real most = DEEP_OVERLAP * std::min(body.radius, other.radius);
	const Vec2 shift = direction * (std::min(distance, most) / mobility);
	if (!is_finite(shift)) {
		return false;
	}
	move(body, shift * body.inverse_mass);
	move(other, -shift * other.inverse_mass);
	return true;
}

Real answer_pair_contact(TouchingBody &body, TouchingBody &other, const PairContact &contact, Real h) {
	const auto [p, a, b, t, normal, depth, is_fresh] = contact;
	const Real share_a = 1 - t;
	const Real share_b = t;
	const Real mobility_p = body.inverse_masses[p];
	const Real mobility_a = other.inverse_masses[a] * share_a;
	const Real mobility_b = other.inverse_masses[b] * share_b;
	// An impulse J on the point and -J on the edge change their distance by J w, w = w_p + w_a (1-t)² + w_b t².
	const Real mobility = mobility_p + mobility_a * share_a + mobility_b * share_b;
	if (!(mobility > 0)) {
		return 0; // both pinned
	}
	const Vec2 relative =
			body.velocities[p] - (other.velocities[a] * share_a + other.velocities[b] * share_b);
	const Real approach = -dot(relative, normal);
	const Vec2 edge_way = (other.positions[a] - other.before[a]) * share_a + (other.positions[b] - other.before[b]) * share_b;
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
	Vec2 shift = normal * push;
	Vec2 velocity_change;
	Real normal_change = 0;
	if (approach > 0) {
		const Real friction = std::min(body.friction, other.friction);
		// The point met the edge somewhere within the substep: what it came too far is what its approach must lose, as
		// velocities that follow from the moved positions would. Taking all of the approach from every graze instead
		// keeps a pile trembling for good (200 bodies, 8 substeps: 1e-3 J each after 16 s instead of 1e-5).
		Real deepening = depth / h;
		if (body.velocity_leads || other.velocity_leads) {
			// What forces have added to the velocity after the way was gone, all of it in an explicit Euler step, would
			// stay otherwise: piles kept 1 J a body.
			deepening += std::max(approach + dot(relative_way, normal) / h, Real(0));
		}
		normal_change = std::min(approach, deepening);
		const Vec2 slide = relative + normal * approach;
		const Real slide_speed = length(slide);
		velocity_change = normal * normal_change;
		if (slide_speed > 0) {
			const Vec2 brake = slide * (-std::min(slide_speed, friction * normal_change) / slide_speed);
			velocity_change += brake;
			shift += brake * h;
		}
	}
	shift *= 1 / mobility;
	velocity_change *= 1 / mobility;
	// Who is about to be reset must not take the other along. A sum is finite only if all of it is: one question for four.
	if (!std::isfinite((shift.x + shift.y) + (velocity_change.x + velocity_change.y))) {
		return 0;
	}
	body.positions[p] += shift * mobility_p;
	body.velocities[p] += velocity_change * mobility_p;
	other.positions[a] -= shift * mobility_a;
	other.velocities[a] -= velocity_change * mobility_a;
	other.positions[b] -= shift * mobility_b;
	other.velocities[b] -= velocity_change * mobility_b;
	return normal_change / mobility;
}

} // namespace softbody
