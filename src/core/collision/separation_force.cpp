// SPDX-License-Identifier: MIT
// The thesis's answer to a contact.
#include "core/collision/separation_force.h"

#include "core/geometry/polygon_overlap.h"

#include <numeric>
#include <span>

namespace softbody {

namespace {

Vec2 mean_of(std::span<const Vec2> points, Vec2 origin) {
	Vec2 sum;
	for (const Vec2 p : points) {
		sum += p - origin;
	}
	return sum * (1 / Real(points.size()));
}

} // namespace

void SeparationForce::begin_substep(Real stiffness, Real h) {
	stiffness_ = stiffness;
	h_ = h;
}

Real SeparationForce::handle(SolverBody &a, SolverBody &b) {
	const Real force = stiffness_ * Real(overlap_area(a.hull(), b.hull()));
	if (!(force > 0)) {
		return 0;
	}
	const Vec2 origin = a.hull()[0];
	const Vec2 way = mean_of(a.hull(), origin) - mean_of(b.hull(), origin);
	const Real distance = length(way);
	const Vec2 direction = distance > 0 ? way * (1 / distance) : Vec2{ 1, 0 };
	push(a, b, direction * (force * h_));
	push(b, a, direction * (-force * h_));
	return force;
}

void SeparationForce::push(SolverBody &body, const SolverBody &other, Vec2 impulse) {
	edges_.assign(other.positions.first(other.before.size()));
	loaded_.clear();
	for (std::size_t i = 0; i < body.before.size(); ++i) {
		if (edges_.contains(body.positions[i])) {
			loaded_.push_back(i);
		}
	}
	if (loaded_.empty()) {
		loaded_.resize(body.before.size());
		std::iota(loaded_.begin(), loaded_.end(), std::size_t(0));
	}
	const Vec2 share = impulse * (1 / Real(loaded_.size()));
	for (const std::size_t i : loaded_) {
		body.velocities[i] += share * body.inverse_masses[i];
	}
}

} // namespace softbody
