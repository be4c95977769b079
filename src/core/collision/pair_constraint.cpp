// SPDX-License-Identifier: MIT
// Solves a contact of a hull point with another body's hull edge.
#include "core/collision/pair_constraint.h"

#include "core/base/constants.h"
#include "core/base/pack.h"
#include "core/geometry/circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softbody {

void SolverBody::begin_step() {
	std::ranges::copy(hull(), before.begin());
	path = 0;
}

void SolverBody::begin_substep() {
	const Vec2 *now = positions.data();
	Vec2 *old = before.data();
	const std::size_t last = before.size() - 2; // of an odd number of points, the last but one is measured twice
	RealPack longest(0); // path along an axis
	for (std::size_t next = 0; next < before.size(); next += 2) {
		const std::size_t i = std::min(next, last);
		const RealPack way = two_at(now + i) - two_at(old + i);
		longest = greater(greater(way, -way), longest);
	}
	std::copy_n(now, before.size(), old);
	path += std::numbers::sqrt2_v<Real> * greatest_lane(longest);
}

void SolverBody::measure_extent() {
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
	const Circle circle = circle_around(now);
	center = circle.center;
	radius = circle.radius + way; // the start positions are no farther away than the longest path
	box = box.grown(way);
}

void SolverBody::take_frame(const BodyFrame &frame) {
	spin_change = 0;
	mass_center = frame.center;
	const bool is_free = inverse_mass > 0; // a pinned body turns about its pins, if at all
	inertia = is_free ? frame.inertia : Real(0);
	spin = is_free ? frame.angular_velocity : Real(0);
}

void SolverBody::apply_spin_change() {
	if (spin_change == 0) {
		return;
	}
	for (std::size_t i = 0; i < positions.size(); ++i) {
		velocities[i] += perpendicular(positions[i] - mass_center) * spin_change;
	}
}

void resist_pair_rolling(SolverBody &a, SolverBody &b, Real normal_impulse) {
	const Real inverse_mass_a = a.inertia > 0 ? 1 / a.inertia : Real(0);
	const Real inverse_mass_b = b.inertia > 0 ? 1 / b.inertia : Real(0);
	const Real inverse_mass = inverse_mass_a + inverse_mass_b;
	if (!(inverse_mass > 0)) {
		return;
	}
	const Real most = std::min(a.rolling_resistance, b.rolling_resistance) * std::min(a.rest_radius, b.rest_radius) *
			normal_impulse;
	const Real impulse = std::clamp((b.spin - a.spin) / inverse_mass, -most, most);
	if (!std::isfinite(impulse)) {
		return; // a body that is about to be reset must not affect the other
	}
	a.spin += impulse * inverse_mass_a;
	a.spin_change += impulse * inverse_mass_a;
	b.spin -= impulse * inverse_mass_b;
	b.spin_change -= impulse * inverse_mass_b;
}

namespace {

void move(SolverBody &body, Vec2 shift) {
	for (Vec2 &p : body.positions) {
		p += shift;
	}
	body.box = { body.box.min + shift, body.box.max + shift };
	body.center += shift;
}

} // namespace

bool part_bodies(SolverBody &body, SolverBody &other, Vec2 direction, Real distance) {
	const Real inverse_mass = body.inverse_mass + other.inverse_mass;
	if (!(inverse_mass > 0)) {
		return false;
	}
	const Real most = DEEP_OVERLAP * std::min(body.reach(), other.reach());
	const Vec2 shift = direction * (std::min(distance, most) / inverse_mass);
	if (!is_finite(shift)) {
		return false;
	}
	move(body, shift * body.inverse_mass);
	move(other, -shift * other.inverse_mass);
	return true;
}

} // namespace softbody
