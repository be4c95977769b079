// SPDX-License-Identifier: MIT
// Who sleeps: islands of bodies at rest fall asleep together, and wake together.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/dynamics/islands.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace softbody {

/// Bodies that touch form an island. When all its bodies have hardly moved (SLEEP_SPEED, SLEEP_SPEED_WEIGHTLESS) for
/// SLEEP_TIME, they fall asleep together, and wake together. Bodies go by their active index in a list of active bodies, of which
/// `body_indices` tells where each stands in the world. A frozen body counts as one that sleeps and never wakes; it joins nobody.
class Sleepers {
public:
	/// Told of each body that falls asleep or wakes, once.
	using OnChange = std::function<void(std::uint32_t active_index, bool is_awake)>;

	/// Another list, of which nobody is known to sleep.
	void reset(std::size_t count);
	bool operator[](std::uint32_t active_index) const { return asleep_[active_index] != 0; }
	/// One a active index, not 0 for who sleeps.
	std::span<const char> flags() const { return asleep_; }
	std::size_t count() const { return count_; }
	bool is_everybody() const { return count_ == asleep_.size(); }

	/// Takes over who was woken or put to sleep from outside since the last step, and wakes all that slept on the same
	/// island. Without `is_new`, the list being as it was, O(1) where nobody was woken; else O(bodies log woken).
	void take_over(WorldData &world, std::span<const std::uint32_t> body_indices, bool is_new, const OnChange &on_change);

	/// After a step: whom somebody awake has touched is woken for the next one, and islands at rest fall asleep. `pairs`
	/// with `touched` are the contacts of the step, `joined` those that joints hold together or that lie beside one rigid
	/// body. Bodies whose `restless` is set (or nobody, if it is empty) stay awake. O(bodies + pairs).
	void let_sleep(WorldData &world, std::span<const std::uint32_t> body_indices, std::span<const BodyPair> pairs,
			std::span<const char> touched, std::span<const BodyPair> joined, std::span<const char> restless,
			const OnChange &on_change);

private:
	bool is_frozen(const WorldData &world, std::span<const std::uint32_t> body_indices, std::uint32_t active_index) const;
	void set_asleep(std::uint32_t active_index, bool asleep, const OnChange &on_change);

	std::vector<char> asleep_;
	std::size_t count_ = 0;
	Islands islands_;
	std::vector<Real> least_rest_; ///< of each island [s]
	std::vector<std::uint64_t> names_; ///< of those islands that fall asleep, else 0
};

} // namespace softbody
