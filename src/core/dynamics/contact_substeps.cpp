// SPDX-License-Identifier: MIT
// Number of contact substeps for each body in a step.
#include "core/dynamics/contact_substeps.h"

#include "core/base/constants.h"

#include <algorithm>

namespace softbody {

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
