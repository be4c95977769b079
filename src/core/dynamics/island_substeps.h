// SPDX-License-Identifier: MIT
// How many contact substeps each island of bodies takes.
#pragma once

#include "core/collision/substep_group.h"
#include "core/dynamics/islands.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Bodies that may touch, or are joined, advance in common substeps: as many as the one of them takes that needs most. Who
/// has nothing to do with them takes no more than it needs itself, and what it does depends on its own island alone.
/// Bodies go by their active index in a list of active bodies.
class IslandSubsteps {
public:
	/// Everybody takes `count` (1..65535): nothing need be known of islands. O(1).
	void set_common(int count);

	/// Begins with `count` bodies, each of them alone and in no island that takes substeps together. O(count).
	void begin(std::uint32_t count);
	/// Puts two bodies into one island.
	void join(std::uint32_t a, std::uint32_t b) { islands_.join(a, b); }
	/// A body of a island needs at least `count` (1..65535) substeps. Once all have been joined.
	void need(std::uint32_t active_index, int count);
	/// Gives every body that has a need what its island needs. O(count).
	void finish();

	/// The different numbers of substeps, ascending.
	std::span<const int> counts() const { return counts_; }
	bool are_common() const { return of_active_.empty(); }
	/// How many the body takes; 0: it is in no island. With a common count, that.
	int of(std::uint32_t active_index) const { return of_active_.empty() ? counts_[0] : of_active_[active_index]; }
	/// Those who take `count`.
	SubstepGroup group(int count) const { return { of_active_, std::uint16_t(count) }; }

private:
	Islands islands_;
	std::vector<std::uint16_t> of_active_; ///< empty with a common count
	std::vector<std::uint16_t> needs_; ///< of islands, by name
	std::vector<std::uint32_t> needing_; ///< active indices
	std::vector<int> counts_;
};

} // namespace softbody
