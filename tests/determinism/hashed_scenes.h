// SPDX-License-Identifier: MIT
// Scenes whose end is compared to the last bit: between threads, compilers, levels of optimization, processors and systems, and
// with a run that was put back in between.
#pragma once

#include "core/base/parallel_for.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <functional>
#include <span>

namespace softbody::testing {

class BitHash;

struct HashedScene {
	const char *name;
	std::function<WorldData()> make;
	std::function<void(WorldData &world, int tick)> drive; ///< before each tick; may be empty
	std::function<void(const WorldData &world, BitHash &hash)> draw = {}; ///< adds what is drawn of the end; may be empty
};

/// Built by functions whose bits are the same on every machine (core/base/elementary.h), and by no random numbers. Between
/// them they have joints, pins, self contacts, dents, cut pieces, every integrator and elastic model, dynamic rigid bodies, drawn
/// outlines with holes that few points stand for, ropes, fluids, and bodies that change between flying as rigid ones and bending.
std::span<const HashedScene> hashed_scenes();

/// Of all states and contacts after `ticks` steps of 1/60 s, and of what is drawn then.
std::uint64_t run_hashed(const HashedScene &scene, int ticks, const ParallelFor &parallel_for);
/// What one of these steps takes on the thread that calls, in the mean [µs], by the clock on the wall.
double time_hashed(const HashedScene &scene, int ticks);
/// Of the states alone; after a third of the ticks all bodies are saved, stepped on for `detour` ticks, and put back.
std::uint64_t run_hashed_with_detour(const HashedScene &scene, int ticks, int detour, const ParallelFor &parallel_for);

} // namespace softbody::testing
