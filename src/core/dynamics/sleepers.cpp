// SPDX-License-Identifier: MIT
// Islands at rest fall asleep, and wake as one.
#include "core/dynamics/sleepers.h"

#include "core/base/constants.h"

#include <algorithm>
#include <limits>

namespace softbody {

void Sleepers::reset(std::size_t count) {
	asleep_.assign(count, 0);
	count_ = 0;
}

void Sleepers::set_asleep(std::uint32_t active_index, bool asleep, const OnChange &on_change) {
	count_ += std::size_t(asleep) - std::size_t(asleep_[active_index]);
	asleep_[active_index] = asleep;
	on_change(active_index, !asleep);
}

bool Sleepers::is_frozen(const WorldData &world, std::span<const std::uint32_t> body_indices, std::uint32_t active_index) const {
	return asleep_[active_index] && world.soft_bodies()[body_indices[active_index]].is_frozen();
}

void Sleepers::take_over(WorldData &world, std::span<const std::uint32_t> body_indices, bool is_new, const OnChange &on_change) {
	std::vector<WokenIsland> woken = world.take_woken_islands();
	if (!is_new && woken.empty()) {
		return;
	}
	std::ranges::sort(woken);
	for (std::uint32_t active_index = 0; active_index < body_indices.size(); ++active_index) {
		SoftBodyData &body = world.soft_bodies()[body_indices[active_index]];
		RestState &rest = body.rest_state();
		if (rest.asleep && (!world.has_sleeping() || std::ranges::binary_search(woken, WokenIsland{ rest.island, rest.restored }))) {
			body.wake();
		}
		rest.restored = 0;
		const bool is_still = body.is_asleep() || body.is_frozen();
		if (is_still != (asleep_[active_index] != 0)) {
			set_asleep(active_index, is_still, on_change);
		}
	}
	world.take_woken_islands(); // what this has added
}

void Sleepers::let_sleep(WorldData &world, std::span<const std::uint32_t> body_indices, std::span<const BodyPair> pairs,
		std::span<const char> touched, std::span<const BodyPair> joined, std::span<const char> restless,
		const OnChange &on_change) {
	islands_.reset(std::uint32_t(body_indices.size()));
	const auto join = [&](BodyPair pair) {
		const auto [a, b] = pair;
		if (is_frozen(world, body_indices, a) || is_frozen(world, body_indices, b)) {
			return; // what rests on one frozen body is no island
		}
		if (asleep_[a] != asleep_[b]) {
			world.soft_bodies()[body_indices[asleep_[a] ? a : b]].wake();
		}
		islands_.join(a, b);
	};
	for (std::size_t i = 0; i < pairs.size(); ++i) {
		if (touched[i]) {
			join(pairs[i]);
		}
	}
	std::ranges::for_each(joined, join);
	least_rest_.assign(body_indices.size(), std::numeric_limits<Real>::max());
	for (std::uint32_t active_index = 0; active_index < body_indices.size(); ++active_index) {
		const SoftBodyData &body = world.soft_bodies()[body_indices[active_index]];
		if (!asleep_[active_index]) {
			Real &least = least_rest_[islands_.find(active_index)];
			const bool may_sleep = body.settings().can_sleep && (restless.empty() || !restless[active_index]);
			least = std::min(least, may_sleep ? body.rest_time() : Real(0));
		}
	}
	names_.assign(body_indices.size(), 0);
	for (std::uint32_t active_index = 0; active_index < body_indices.size(); ++active_index) {
		const std::uint32_t island = islands_.find(active_index);
		if (asleep_[active_index] || least_rest_[island] < SLEEP_TIME) {
			continue;
		}
		// Named after its first body, which sleeps on no other: so that the name tells nothing of the past.
		if (names_[island] == 0) {
			names_[island] = world.id_at(body_indices[active_index]).index + std::uint64_t(1);
		}
		set_asleep(active_index, true, on_change);
		RestState &rest = world.soft_bodies()[body_indices[active_index]].rest_state();
		rest.asleep = true;
		rest.island = names_[island];
	}
}

} // namespace softbody
