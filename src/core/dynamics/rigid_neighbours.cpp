// SPDX-License-Identifier: MIT
// Which bodies may meet a rigid body that they push back.
#include "core/dynamics/rigid_neighbours.h"

#include "core/collision/collision_handling.h"

#include <algorithm>

namespace softbody {

namespace {

constexpr std::size_t BODIES_A_TASK = 64;

Aabb way_of(const TouchingBody &body, Real dt) {
	return sweep_box(body.hull(), body.velocities, dt);
}

} // namespace

void RigidNeighbours::find(const ActiveBodies &bodies, WorldData &world, const SurroundingsIndex &surroundings,
		std::span<const char> asleep, Real dt, const ParallelFor &parallel_for) {
	is_near_.clear();
	restless_.clear();
	beside_.clear();
	if (!surroundings.has_dynamic_colliders()) {
		return;
	}
	is_near_.assign(bodies.count(), 0);
	restless_.assign(bodies.count(), 0);
	run_slices(parallel_for, bodies.count(), BODIES_A_TASK, [&](std::size_t, std::size_t begin, std::size_t end) {
		for (std::size_t row = begin; row < end; ++row) {
			is_near_[row] = surroundings.has_dynamic_collider_in(way_of(bodies.touching(std::uint32_t(row)), dt));
		}
	});
	for (std::uint32_t row = 0; row < bodies.count(); ++row) {
		if (is_near_[row] == 0) {
			continue;
		}
		surroundings.collect_dynamic(way_of(bodies.touching(row), dt), colliders_);
		for (const std::uint32_t collider : colliders_) {
			const std::uint32_t rigid = world.colliders()[collider].rigid_body;
			restless_[row] |= char(!world.rigid_bodies()[rigid].asleep);
			beside_.push_back({ rigid, row });
		}
		if (asleep[row] != 0 && restless_[row] != 0) {
			bodies.data(row).wake();
		}
	}
	std::ranges::sort(beside_);
}

void RigidNeighbours::report_sleepers(const ActiveBodies &bodies, WorldData &world, std::span<const char> asleep) const {
	for (const auto &[rigid, row] : beside_) {
		world.mutable_reactions()[rigid].beside_sleeper |= asleep[row] != 0 && !bodies.data(row).is_frozen();
	}
}

void RigidNeighbours::add_linked(std::vector<BodyPair> &pairs) const {
	for (std::size_t i = 1; i < beside_.size(); ++i) {
		const auto &[rigid, row] = beside_[i];
		if (rigid == beside_[i - 1].first && row != beside_[i - 1].second) {
			pairs.push_back({ beside_[i - 1].second, row });
		}
	}
}

} // namespace softbody
