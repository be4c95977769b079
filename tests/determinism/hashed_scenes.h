// SPDX-License-Identifier: MIT
// Scenes whose end is compared to the last bit: between threads, compilers and levels of optimization, and with a run that was
// put back in between.
#pragma once

#include "core/base/parallel_for.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <functional>
#include <span>

namespace softbody::testing {

struct HashedScene {
	const char *name;
	std::function<WorldData()> make;
	std::function<void(WorldData &world, int tick)> drive; ///< before each tick; may be empty
};

/// Built without a call of a sine or another function of a library of mathematics, so that their bits are the same on every
/// machine whose compiler rounds as IEEE 754 says.
std::span<const HashedScene> hashed_scenes();

/// Of all states and contacts after `ticks` steps of 1/60 s.
std::uint64_t run_hashed(const HashedScene &scene, int ticks, const ParallelFor &parallel_for);
/// Of the states alone; after a third of the ticks all bodies are saved, stepped on for `detour` ticks, and put back.
std::uint64_t run_hashed_with_detour(const HashedScene &scene, int ticks, int detour, const ParallelFor &parallel_for);

} // namespace softbody::testing
