// SPDX-License-Identifier: MIT
// Finds the bodies that may meet a dynamic rigid body.
#include "core/dynamics/rigid_neighbors.h"

#include "core/collision/environment_contact_solver.h"

#include <algorithm>

namespace softbody {

namespace {

constexpr std::size_t BODIES_A_TASK = 64;

Aabb way_of(const SolverBody &body, Real dt) {
	return sweep_box(body.hull(), body.velocities, dt);
}

} // namespace

void RigidNeighbors::find(const ActiveBodies &bodies, WorldData &world, const ColliderIndex &surroundings,
		Real dt, const ParallelFor &parallel_for) {
	is_near_.clear();
	restless_.clear();
	beside_.clear();
	if (!surroundings.has_dynamic_colliders()) {
		return;
	}
	is_near_.assign(bodies.count(), 0);
	restless_.assign(bodies.count(), 0);
	lists_.resize(bodies.count());
	run_slices(parallel_for, bodies.count(), BODIES_A_TASK, [&](std::size_t task_index, std::size_t begin, std::size_t end) {
		Task &task = tasks_[task_index];
		task.colliders.clear();
		for (std::size_t active_index = begin; active_index < end; ++active_index) {
			const Aabb way = way_of(bodies.solver_body(std::uint32_t(active_index)), dt);
			const Aabb box = with_room(way);
			surroundings.collect_dynamic(box, task.found);
			lists_[active_index] = { way, box, std::uint32_t(task_index), std::uint32_t(task.colliders.size()),
				std::uint32_t(task.colliders.size() + task.found.size()) };
			task.colliders.insert(task.colliders.end(), task.found.begin(), task.found.end());
			is_near_[active_index] =
					std::ranges::any_of(task.found, [&](std::uint32_t i) { return surroundings.bounds(i).overlaps(way); });
		}
	});
	for (std::uint32_t active_index = 0; active_index < bodies.count(); ++active_index) {
		if (is_near_[active_index] == 0) {
			continue;
		}
		const Aabb &way = lists_[active_index].way;
		for (const std::uint32_t collider : surroundings_of(active_index).colliders) {
			if (!surroundings.bounds(collider).overlaps(way)) {
				continue;
			}
			const std::uint32_t rigid = world.colliders()[collider].rigid_body;
			restless_[active_index] |= char(!world.rigid_bodies()[rigid].asleep);
			beside_.push_back({ rigid, active_index });
		}
		if (bodies.is_resting(active_index) && restless_[active_index] != 0) {
			bodies.data(active_index).wake();
		}
	}
	std::ranges::sort(beside_);
}

RigidSurroundings RigidNeighbors::surroundings_of(std::uint32_t active_index) const {
	const List &list = lists_[active_index];
	return { list.box, std::span(tasks_[list.task].colliders).subspan(list.begin, list.end - list.begin) };
}

void RigidNeighbors::report_sleepers(const ActiveBodies &bodies, WorldData &world) const {
	for (const auto &[rigid, active_index] : beside_) {
		world.mutable_reactions()[rigid].beside_sleeper |= bodies.is_resting(active_index) && !bodies.data(active_index).is_frozen();
	}
}

void RigidNeighbors::add_linked(std::vector<BodyPair> &pairs) const {
	for (std::size_t i = 1; i < beside_.size(); ++i) {
		const auto &[rigid, active_index] = beside_[i];
		if (rigid == beside_[i - 1].first && active_index != beside_[i - 1].second) {
			pairs.push_back({ beside_[i - 1].second, active_index });
		}
	}
}

} // namespace softbody
