// SPDX-License-Identifier: MIT
// Who takes part in a pass over bodies that not all of them take part in.
#pragma once

#include <cstdint>
#include <span>

namespace softbody {

/// Islands of bodies that have nothing to do with one another may take contact substeps of different length, those of each
/// length in a turn of their own. Bodies go by their active index in a list of active bodies.
struct SubstepGroup {
	std::span<const std::uint16_t> of_active; ///< the turn of each body; empty: there is but one, and it is everybody's
	std::uint16_t now = 0;

	bool has(std::uint32_t active_index) const { return of_active.empty() || of_active[active_index] == now; }
};

} // namespace softbody
