// SPDX-License-Identifier: MIT
// Moves pinned points to their targets at the end of a step.
#pragma once

#include "core/model/world_data.h"

#include <cstdint>
#include <vector>

namespace softbody {

/// Moves pins to their targets (SoftBodyData::set_pin_target). During a step such a pin has the velocity that takes it
/// to its target in a straight line. It has no inverse mass, so every integrator moves it by exactly that, in any
/// number of substeps, and springs and contacts see a moving point. After the step it is put exactly at its target, and
/// rests.
class PinMotion {
public:
	/// Sets the velocities of pins of active bodies that have targets, for a step of `dt` [s]. `is_rearranged`: the
	/// list of bodies was rebuilt. O(1) while no target is set, else O(bodies).
	void begin_step(WorldData &world, Real dt, bool is_rearranged);
	/// Puts moved pins at their targets.
	void end_step(WorldData &world);

private:
	std::vector<std::uint32_t> body_indices_; ///< of bodies in the world
	std::uint64_t seen_targets_ = 0;
};

} // namespace softbody
