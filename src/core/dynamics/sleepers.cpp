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

void Sleepers::set_asleep(std::uint32_t row, bool asleep, const OnChange &on_change) {
	count_ += std::size_t(asleep) - std::size_t(asleep_[row]);
	asleep_[row] = asleep;
	on_change(row, !asleep);
}

bool Sleepers::is_frozen(const WorldData &world, std::span<const std::uint32_t> places, std::uint32_t row) const {
	return asleep_[row] && world.soft_bodies()[places[row]].is_frozen();
}

void Sleepers::take_over(WorldData &world, std::span<const std::uint32_t> places, bool is_new, const OnChange &on_change) {
	std::vector<WokenIsland> woken = world.take_woken_islands();
	if (!is_new && woken.empty()) {
		return;
	}
	std::ranges::sort(woken);
	for (std::uint32_t row = 0; row < places.size(); ++row) {
		SoftBodyData &body = world.soft_bodies()[places[row]];
		RestState &rest = body.rest_state();
		if (rest.asleep && (!world.has_sleeping() || std::ranges::binary_search(woken, WokenIsland{ rest.island, rest.restored }))) {
			body.wake();
		}
		rest.restored = 0;
		const bool is_still = body.is_asleep() || body.is_frozen();
		if (is_still != (asleep_[row] != 0)) {
			set_asleep(row, is_still, on_change);
		}
	}
	world.take_woken_islands(); // what this has added
}

void Sleepers::let_sleep(WorldData &world, std::span<const std::uint32_t> places, std::span<const BodyPair> pairs,
		std::span<const char> touched, std::span<const BodyPair> joined, std::span<const char> restless,
		const OnChange &on_change) {
	islands_.reset(std::uint32_t(places.size()));
	const auto join = [&](BodyPair pair) {
		const auto [a, b] = pair;
		if (is_frozen(world, places, a) || is_frozen(world, places, b)) {
			return; // what rests on one frozen body is no island
		}
		if (asleep_[a] != asleep_[b]) {
			world.soft_bodies()[places[asleep_[a] ? a : b]].wake();
		}
		islands_.join(a, b);
	};
	for (std::size_t i = 0; i < pairs.size(); ++i) {
		if (touched[i]) {
			join(pairs[i]);
		}
	}
	std::ranges::for_each(joined, join);
	least_rest_.assign(places.size(), std::numeric_limits<Real>::max());
	for (std::uint32_t row = 0; row < places.size(); ++row) {
		const SoftBodyData &body = world.soft_bodies()[places[row]];
		if (!asleep_[row]) {
			Real &least = least_rest_[islands_.find(row)];
			const bool may_sleep = body.settings().can_sleep && (restless.empty() || !restless[row]);
			least = std::min(least, may_sleep ? body.rest_time() : Real(0));
		}
	}
	names_.assign(places.size(), 0);
	for (std::uint32_t row = 0; row < places.size(); ++row) {
		const std::uint32_t island = islands_.find(row);
		if (asleep_[row] || least_rest_[island] < SLEEP_TIME) {
			continue;
		}
		// Named after its first body, which sleeps on no other: so that the name tells nothing of the past.
		if (names_[island] == 0) {
			names_[island] = world.id_at(places[row]).index + std::uint64_t(1);
		}
		set_asleep(row, true, on_change);
		RestState &rest = world.soft_bodies()[places[row]].rest_state();
		rest.asleep = true;
		rest.island = names_[island];
	}
}

} // namespace softbody
