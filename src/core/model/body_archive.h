// SPDX-License-Identifier: MIT
// The order of a body's values in bytes.
#pragma once

#include "core/model/body_state.h"
#include "core/model/state_archive.h"

#include <cstddef>
#include <cstdint>

namespace softbody {

/// Shows the values of a state to a `StateWriter` or `StateReader`, in the order of the bytes. `state` is a `BodyState`, or what
/// has members of the same names (`BodyView`).
template <class State>
void visit_state(State &state, auto &archive) {
	constexpr std::size_t INDEX = sizeof(std::uint32_t);
	constexpr std::size_t VECTOR = 2 * sizeof(Real);
	const auto each = [&](auto &...values) { (archive.visit(values), ...); };
	auto &memory = state.memory();
	archive.visit_points(state.positions);
	archive.visit_points(state.velocities);
	archive.visit_points(memory.previous_positions);
	archive.visit_points(memory.last_valid_hull);
	archive.visit_points(state.rest_positions);
	archive.visit_list(state.pinned_points, INDEX, each);
	archive.visit_list(memory.external_forces, INDEX + VECTOR, [&](auto &external) { each(external.point, external.force); });
	archive.visit_list(memory.pin_targets, INDEX + VECTOR, [&](auto &target) { each(target.point, target.position); });
	archive.visit_list(memory.pair_touches, 2 * INDEX + 1 + 2 * sizeof(Real), [&](auto &pair) {
		each(pair.other.index, pair.other.generation, pair.touch.touching, pair.touch.approach, pair.touch.missing);
	});
	archive.visit_list(memory.one_ways, sizeof(std::uint64_t) + 1, [&](auto &one_way) { each(one_way.collider, one_way.held); });
	each(state.rotation_memory.c, state.rotation_memory.s);
	each(memory.touch.touching, memory.touch.approach, memory.touch.restitution, memory.touch.normal, memory.touch.surface_velocity,
			memory.touch.account);
	each(memory.rest.rest_time, memory.rest.drowsy_center, memory.rest.drowsy_velocity, memory.rest.asleep, memory.rest.island,
			memory.rest.surroundings);
	each(memory.damage_pause, memory.placed, memory.active, memory.frozen, memory.load.force, memory.load.torque, memory.acceleration,
			memory.fluids);
}

} // namespace softbody
