// SPDX-License-Identifier: MIT
// What joints fasten to chains, and the chains that carry it.
#include "core/dynamics/joint_solver.h"

#include "core/base/constants.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// Least inverse mass of a body that a joint moves, over the greatest: the mass of a body that only turns has no bound along its arm.
constexpr double LEAST_INVERSE_MASS = 1e-6;

} // namespace

// A joint at an edge holds the nearer of its sections.
void JointSolver::take_section(Side &side, const JointAnchor &anchor) const {
	const ChainShape *chain = side.body->shape().chain();
	const std::uint32_t point = anchor.fraction > Real(0.5) ? std::uint32_t(side.place.b) : anchor.point;
	side.section = chain != nullptr ? chain->section_of(point) : ChainShape::NO_SECTION;
	if (side.section == ChainShape::NO_SECTION) {
		return;
	}
	const auto [left, right, center] = chain->sections()[side.section];
	const std::span<const Real> w = side.body->inverse_masses();
	const bool is_held = w[left] == 0 || w[right] == 0 || w[center] == 0;
	side.place.inverse_mass = is_held ? Real(0) : 1 / chain->masses()[side.section];
}

void JointSolver::push_section(const Side &side, std::span<Vec2> values, Vec2 impulse) {
	const auto [left, right, center] = side.body->shape().chain()->sections()[side.section];
	for (const std::uint32_t point : { left, right, center }) {
		values[point] += impulse * side.place.inverse_mass;
	}
}

// Rigid joints without a length. What a spring or a rod fastens to a chain is pushed and pulled from outside, as contacts are.
void JointSolver::find_chains() {
	chain_ends_.clear();
	chain_loads_.clear();
	for (std::uint32_t i = 0; i < active_.size(); ++i) {
		const Joint &joint = world_->joints()[active_[i].joint];
		for (std::uint32_t end = 0; end < 2 && std::isinf(joint.stiffness) && joint.rest_length == 0; ++end) {
			const Side &side = active_[i].sides[end];
			if (side.body && side.section != ChainShape::NO_SECTION && side.place.inverse_mass > 0) {
				chain_ends_.push_back({ side.active_index, i, end });
			}
		}
	}
	std::ranges::stable_sort(chain_ends_, {}, &ChainEnd::active_index);
	chain_loads_.resize(chain_ends_.size());
}

std::span<ChainLoad> JointSolver::loads_of(std::uint32_t active_index) {
	const auto first = std::ranges::lower_bound(chain_ends_, active_index, {}, &ChainEnd::active_index);
	const auto last = std::ranges::upper_bound(chain_ends_, active_index, {}, &ChainEnd::active_index);
	return std::span(chain_loads_).subspan(std::size_t(first - chain_ends_.begin()), std::size_t(last - first));
}

ChainLoad JointSolver::load_at(Side &own, Side &other, Real elapsed, Real h) const {
	ChainLoad load;
	update_place(own, elapsed);
	update_place(other, elapsed + h);
	load.section = own.section;
	load.offset = difference(own.at, own.body->positions()[own.body->shape().chain()->sections()[own.section].center]);
	load.place = other.at;
	load.velocity = Vec2d(velocity_of(other));
	if (!is_finite(other.at) || !is_finite(velocity_of(other))) { // a body that is about to be reset must not affect others
		load.place = own.at;
		load.velocity = {};
		return load;
	}
	if (other.body) {
		load.is_fixed = !(other.place.inverse_mass > 0);
		load.mass_xx = load.mass_yy = load.is_fixed ? 0 : 1 / double(other.place.inverse_mass);
		return load;
	}
	if (other.rigid == NO_RIGID_BODY || !world_->rigid_bodies()[other.rigid].is_dynamic()) {
		load.is_fixed = true;
		return load;
	}
	// The inverse of the inverse mass at the joint, 1/m + arms over the inertia.
	const RigidBody &rigid = world_->rigid_bodies()[other.rigid];
	const Vec2d arm(other.arm);
	const double least = LEAST_INVERSE_MASS * (double(rigid.inverse_mass) + double(rigid.inverse_inertia) * length_squared(arm));
	const double a = double(rigid.inverse_mass) + double(rigid.inverse_inertia) * arm.y * arm.y + least;
	const double b = -double(rigid.inverse_inertia) * arm.x * arm.y;
	const double c = double(rigid.inverse_mass) + double(rigid.inverse_inertia) * arm.x * arm.x + least;
	const double determinant = a * c - b * b;
	load.mass_xx = c / determinant;
	load.mass_xy = -b / determinant;
	load.mass_yy = a / determinant;
	return load;
}

std::size_t JointSolver::solve_chains(const ColliderIndex &surroundings, Real elapsed, Real h, const SubstepGroup &group, ContactLog &log) {
	std::size_t contacts = 0;
	for (std::size_t begin = 0, end = 0; begin < chain_ends_.size(); begin = end) {
		while (end < chain_ends_.size() && chain_ends_[end].active_index == chain_ends_[begin].active_index) {
			++end;
		}
		SoftBodyData &body = *active_[chain_ends_[begin].joint].sides[chain_ends_[begin].end].body;
		if (!group.has(chain_ends_[begin].active_index) || is_still(active_[chain_ends_[begin].joint].sides[chain_ends_[begin].end])) {
			continue;
		}
		bool is_pulled = false;
		for (std::size_t i = begin; i < end; ++i) {
			Active &active = active_[chain_ends_[i].joint];
			chain_loads_[i] = load_at(active.sides[chain_ends_[i].end], active.sides[1 - chain_ends_[i].end], elapsed, h);
			is_pulled |= !chain_loads_[i].is_fixed;
		}
		const std::span<ChainLoad> loads = std::span(chain_loads_).subspan(begin, end - begin);
		contacts += chain_stepper_.solve_velocities(surroundings, body, elapsed, h, loads, is_pulled ? double(JOINT_PULL / dt_) : 0.0, log);
		for (std::size_t i = begin; i < end; ++i) {
			Active &active = active_[chain_ends_[i].joint];
			const Vec2 impulse(chain_loads_[i].impulse);
			if (!is_finite(impulse)) {
				continue;
			}
			if (!chain_loads_[i].is_fixed) {
				apply(active.sides[1 - chain_ends_[i].end], -impulse);
			}
			active.total += chain_ends_[i].end == 0 ? impulse : -impulse;
		}
	}
	return contacts;
}

} // namespace softbody
