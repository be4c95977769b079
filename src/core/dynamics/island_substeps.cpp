// SPDX-License-Identifier: MIT
// Number of contact substeps for each island of bodies.
#include "core/dynamics/island_substeps.h"

#include <algorithm>

namespace softbody {

void IslandSubsteps::set_common(int count) {
	of_active_.clear();
	counts_.assign(1, count);
}

void IslandSubsteps::begin(std::uint32_t count) {
	islands_.reset(count);
	of_active_.assign(count, 0);
	needs_.assign(count, 0);
	needing_.clear();
	counts_.clear();
}

void IslandSubsteps::need(std::uint32_t active_index, int count) {
	std::uint16_t &need = needs_[islands_.find(active_index)];
	need = std::max(need, std::uint16_t(count));
	needing_.push_back(active_index);
}

void IslandSubsteps::finish() {
	for (const std::uint32_t active_index : needing_) {
		of_active_[active_index] = needs_[islands_.find(active_index)];
		if (std::ranges::find(counts_, of_active_[active_index]) == counts_.end()) {
			counts_.push_back(of_active_[active_index]);
		}
	}
	std::ranges::sort(counts_);
}

} // namespace softbody
