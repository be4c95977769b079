// SPDX-License-Identifier: MIT
// How many contact substeps each heap of bodies takes.
#include "core/dynamics/heap_substeps.h"

#include <algorithm>

namespace softbody {

void HeapSubsteps::set_common(int count) {
	of_rows_.clear();
	counts_.assign(1, count);
}

void HeapSubsteps::begin(std::uint32_t rows) {
	islands_.reset(rows);
	of_rows_.assign(rows, 0);
	needs_.assign(rows, 0);
	needing_.clear();
	counts_.clear();
}

void HeapSubsteps::need(std::uint32_t row, int count) {
	std::uint16_t &heap = needs_[islands_.find(row)];
	heap = std::max(heap, std::uint16_t(count));
	needing_.push_back(row);
}

void HeapSubsteps::finish() {
	for (const std::uint32_t row : needing_) {
		of_rows_[row] = needs_[islands_.find(row)];
		if (std::ranges::find(counts_, of_rows_[row]) == counts_.end()) {
			counts_.push_back(of_rows_[row]);
		}
	}
	std::ranges::sort(counts_);
}

} // namespace softbody
