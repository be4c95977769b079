// SPDX-License-Identifier: MIT
// Who takes contact substeps in a step, and how many.
#include "core/dynamics/contact_substeps.h"

#include "core/base/constants.h"
#include "core/dynamics/integrators/integrator_step.h"

#include <algorithm>

namespace softbody {

namespace {

int needed_substeps(const ActiveBodies &bodies, const BatchState &batch, std::uint32_t lane, int least) {
	const int own = bodies.plan_of(batch, lane).substeps;
	return batch.coupled >> lane & 1 ? std::max(least, std::min(own, MAX_CONTACT_SUBSTEPS)) : own;
}

// Whether a body that is in no island ends in the same bits by as many contact substeps as it takes force substeps.
bool may_be_divided(const ActiveBodies &bodies, const BatchState &batch, std::uint32_t lane) {
	return integrator_traits(bodies.plan_of(batch, lane).integrator).hands_nothing_on;
}

} // namespace

void ContactSubsteps::choose(ActiveBodies &bodies, std::span<const std::uint32_t> coupled, const Couplings &couplings,
		int least, std::vector<std::uint32_t> &free) {
	if (const std::optional<int> common = common_need(bodies, coupled, least)) {
		island_substeps_.set_common(*common);
		of_rigid_bodies_ = couplings.beside_dynamic.empty() ? 0 : *common;
		return;
	}
	find_islands(bodies, coupled, couplings, least);
	of_rigid_bodies_ = couplings.beside_dynamic.empty() ? 0 : island_substeps_.of(couplings.beside_dynamic[0]);
	for (const std::uint32_t batch : coupled) {
		leave_free(bodies, batch);
		if (bodies.state(batch).stepped() != 0) {
			free.push_back(batch);
		}
	}
}

// Where all take the same number, there is no need to know who belongs to which island.
std::optional<int> ContactSubsteps::common_need(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled,
		int least) const {
	std::optional<int> common;
	for (const std::uint32_t i : coupled) {
		const BatchState &state = bodies.state(i);
		for (std::uint32_t lane = 0; lane < bodies.batch(i).count; ++lane) {
			if (state.awake >> lane & 1) {
				const int needed = needed_substeps(bodies, state, lane, least);
				const bool is_coupled = state.coupled >> lane & 1;
				if (common.value_or(needed) != needed || !(is_coupled || may_be_divided(bodies, state, lane))) {
					return {};
				}
				common = needed;
			}
		}
	}
	return common.value_or(least);
}

void ContactSubsteps::find_islands(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled,
		const Couplings &couplings, int least) {
	island_substeps_.begin(bodies.count());
	for (const std::span<const BodyPair> pairs : { couplings.pairs, couplings.joined }) {
		for (const auto [a, b] : pairs) {
			island_substeps_.join(a, b);
		}
	}
	for (const std::uint32_t active_index : couplings.beside_dynamic) {
		island_substeps_.join(couplings.beside_dynamic[0], active_index);
	}
	for (const std::uint32_t active_index : couplings.beside_dynamic) {
		island_substeps_.need(active_index, least); // frozen ones, too
	}
	for (const std::uint32_t i : coupled) {
		const BatchState &state = bodies.state(i);
		for (std::uint32_t lane = 0; lane < bodies.batch(i).count; ++lane) {
			if (state.awake & state.coupled & 1u << lane) {
				island_substeps_.need(state.active_indices[lane], needed_substeps(bodies, state, lane, least));
			}
		}
	}
	island_substeps_.finish();
}

// Bodies of a batch go side by side: who is in no island goes with one that takes as many substeps, if there is one.
void ContactSubsteps::leave_free(ActiveBodies &bodies, std::uint32_t batch) {
	BatchState &state = bodies.state(batch);
	const std::uint32_t count = bodies.batch(batch).count;
	const std::uint32_t in_islands = state.coupled;
	for (std::uint32_t lane = 0; lane < count; ++lane) {
		if ((state.awake & ~in_islands & 1u << lane) && may_be_divided(bodies, state, lane)) {
			const int own = bodies.plan_of(state, lane).substeps;
			for (std::uint32_t other = 0; other < count; ++other) {
				if ((in_islands & 1u << other) && island_substeps_.of(state.active_indices[other]) == own) {
					island_substeps_.add(state.active_indices[lane], own);
					state.coupled |= 1u << lane;
				}
			}
		}
	}
	state.active_mask = ~state.coupled & ALL_LANES;
}

} // namespace softbody
