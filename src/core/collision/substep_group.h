// SPDX-License-Identifier: MIT
// Selects the bodies solved in a substep group.
#pragma once

#include <cstdint>
#include <span>

namespace softbody {

/// The islands that take one number of contact substeps. Separate islands may take contact substeps of different
/// length; each length is solved as a group of its own. Bodies are indexed by active index.
struct SubstepGroup {
	std::span<const std::uint16_t> of_active; ///< number of substeps of each body; empty: all bodies are in the group
	std::uint16_t now = 0;

	bool has(std::uint32_t active_index) const { return of_active.empty() || of_active[active_index] == now; }
};

} // namespace softbody
