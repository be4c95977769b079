// SPDX-License-Identifier: MIT
// Who takes contact substeps in a step, and how many.
#include "core/dynamics/contact_substeps.h"

#include "core/base/constants.h"
#include "core/dynamics/integrators/integrator_step.h"

#include <algorithm>

namespace softbody {

namespace {

int needed_substeps(const ActiveBodies &bodies, const CrewState &crew, std::uint32_t lane, int least) {
	const int own = bodies.plan_of(crew, lane).substeps;
	return crew.coupled >> lane & 1 ? std::max(least, std::min(own, MAX_CONTACT_SUBSTEPS)) : own;
}

// Whether a body that is in no heap ends in the same bits by as many contact substeps as it takes force substeps.
bool may_be_divided(const ActiveBodies &bodies, const CrewState &crew, std::uint32_t lane) {
	return integrator_traits(bodies.plan_of(crew, lane).integrator).hands_nothing_on;
}

} // namespace

void ContactSubsteps::choose(ActiveBodies &bodies, std::span<const std::uint32_t> coupled, const Couplings &couplings,
		int least, std::vector<std::uint32_t> &free) {
	if (const std::optional<int> common = common_need(bodies, coupled, least)) {
		heaps_.set_common(*common);
		of_rigid_bodies_ = couplings.beside_dynamic.empty() ? 0 : *common;
		return;
	}
	find_heaps(bodies, coupled, couplings, least);
	of_rigid_bodies_ = couplings.beside_dynamic.empty() ? 0 : heaps_.of(couplings.beside_dynamic[0]);
	for (const std::uint32_t crew : coupled) {
		leave_free(bodies, crew);
		if (bodies.state(crew).stepped() != 0) {
			free.push_back(crew);
		}
	}
}

// Where all take the same number, there is no need to know who belongs to which heap.
std::optional<int> ContactSubsteps::common_need(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled,
		int least) const {
	std::optional<int> common;
	for (const std::uint32_t i : coupled) {
		const CrewState &state = bodies.state(i);
		for (std::uint32_t lane = 0; lane < bodies.crew(i).count; ++lane) {
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

void ContactSubsteps::find_heaps(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled,
		const Couplings &couplings, int least) {
	heaps_.begin(bodies.count());
	for (const std::span<const BodyPair> pairs : { couplings.pairs, couplings.joined }) {
		for (const auto [a, b] : pairs) {
			heaps_.join(a, b);
		}
	}
	for (const std::uint32_t row : couplings.beside_dynamic) {
		heaps_.join(couplings.beside_dynamic[0], row);
	}
	for (const std::uint32_t row : couplings.beside_dynamic) {
		heaps_.need(row, least); // frozen ones, too
	}
	for (const std::uint32_t i : coupled) {
		const CrewState &state = bodies.state(i);
		for (std::uint32_t lane = 0; lane < bodies.crew(i).count; ++lane) {
			if (state.awake & state.coupled & 1u << lane) {
				heaps_.need(state.rows[lane], needed_substeps(bodies, state, lane, least));
			}
		}
	}
	heaps_.finish();
}

// Bodies of a crew go side by side: who is in no heap goes with one that takes as many substeps, if there is one.
void ContactSubsteps::leave_free(ActiveBodies &bodies, std::uint32_t crew) {
	CrewState &state = bodies.state(crew);
	const std::uint32_t count = bodies.crew(crew).count;
	const std::uint32_t in_heaps = state.coupled;
	for (std::uint32_t lane = 0; lane < count; ++lane) {
		if ((state.awake & ~in_heaps & 1u << lane) && may_be_divided(bodies, state, lane)) {
			const int own = bodies.plan_of(state, lane).substeps;
			for (std::uint32_t other = 0; other < count; ++other) {
				if ((in_heaps & 1u << other) && heaps_.of(state.rows[other]) == own) {
					heaps_.add(state.rows[lane], own);
					state.coupled |= 1u << lane;
				}
			}
		}
	}
	state.turn = ~state.coupled & ALL_LANES;
}

} // namespace softbody
