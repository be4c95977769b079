// SPDX-License-Identifier: MIT
// Number of contact substeps for each body in a step.
#include "core/dynamics/contact_substeps.h"

#include "core/base/constants.h"

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

void ContactSubsteps::choose(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled, const Couplings &couplings,
		int least) {
	const auto need_of = [&](std::uint32_t i) { return std::max(least, std::min(bodies.plan(i).substeps, MAX_CONTACT_SUBSTEPS)); };
	const int first = coupled.empty() ? least : need_of(coupled[0]);
	if (std::ranges::all_of(coupled, [&](std::uint32_t i) { return need_of(i) == first; })) {
		island_substeps_.set_common(first); // then islands are not needed
	} else {
		island_substeps_.begin(bodies.count());
		for (const std::span<const BodyPair> pairs : { couplings.pairs, couplings.joined }) {
			for (const auto [a, b] : pairs) {
				island_substeps_.join(a, b);
			}
		}
		for (const std::uint32_t i : couplings.beside_dynamic) {
			island_substeps_.join(couplings.beside_dynamic[0], i);
		}
		for (const std::uint32_t i : couplings.beside_dynamic) {
			island_substeps_.need(i, least); // includes frozen bodies
		}
		for (const std::uint32_t i : coupled) {
			island_substeps_.need(i, need_of(i));
		}
		island_substeps_.finish();
	}
	of_rigid_bodies_ = couplings.beside_dynamic.empty() ? 0 : island_substeps_.of(couplings.beside_dynamic[0]);
}

} // namespace softbody
