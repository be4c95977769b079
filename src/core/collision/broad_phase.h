// SPDX-License-Identifier: MIT
// Which bodies may touch: all pairs whose boxes overlap, found in time that grows with the number of bodies.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/box_grid.h"
#include "core/geometry/aabb.h"

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// What the broad phase knows of a body.
struct BroadPhaseBody {
	Aabb box; ///< in which the body stays during the coming step
	std::uint32_t layer = 1;
	std::uint32_t mask = 0xffffffffu;
	bool rests = false; ///< two bodies that rest are no pair
};

/// Two bodies that may touch, as places in the list given to the broad phase; a < b.
struct BodyPair {
	std::uint32_t a = 0;
	std::uint32_t b = 0;
	friend auto operator<=>(BodyPair, BodyPair) = default;
};

/// Finds pairs with a hashed grid of several cell sizes: each body lies in one cell of the level whose cells are as
/// large as its box, and asks the neighboring cells of its own and all other levels. Boxes are kept with a margin: as
/// long as every body stays within its own, the candidates of the last time hold; of a few bodies that have left theirs,
/// only those are sought anew. Of the candidates, those whose boxes overlap as they are now become pairs.
///
/// The pairs come in groups that several threads may work on at once: no two groups of one color share a body.
/// Pairs, groups and their order depend on the present boxes alone, not on where bodies were in earlier steps, so that a
/// state that is put back goes on as it did; and the order of two pairs that share a body depends on their own boxes alone,
/// so that a island does the same whatever happens elsewhere.
class BroadPhase {
public:
	/// `version` tells whether the list still means the same bodies. O(bodies) expected.
	/// `exceptions`, sorted, are no pairs.
	void update(std::span<const BroadPhaseBody> bodies, std::uint64_t version, const ParallelFor &parallel_for = {},
			std::span<const BodyPair> exceptions = {});

	std::span<const BodyPair> pairs() const { return pairs_; }
	/// How many colors there are now: one after the other.
	std::size_t color_count() const { return first_groups_.empty() ? 0 : first_groups_.size() - 1; }
	struct Group {
		std::uint32_t begin = 0;
		std::uint32_t end = 0;
	};
	/// The groups of a color, which are runs of `pairs()` and follow one another.
	std::span<const Group> groups(std::size_t color) const;
	/// How often candidates were sought anew, of all bodies or of some.
	std::uint64_t rebuild_count() const { return rebuild_count_; }
	/// Of how many bodies they were, all in all.
	std::uint64_t sought_bodies() const { return sought_bodies_; }

private:
	/// Those that body `i` is part of, and whose other body has a higher number or, with `moved_only`, has not moved.
	void find_pairs_of(std::uint32_t i, std::span<const BroadPhaseBody> bodies, bool moved_only, std::vector<BodyPair> &found) const;
	void find_all_pairs(std::span<const BroadPhaseBody> bodies, const ParallelFor &parallel_for);
	void replace_pairs_of_moved(std::span<const BroadPhaseBody> bodies);
	void keep_overlapping(std::span<const BroadPhaseBody> bodies, std::span<const BodyPair> exceptions);
	void group_pairs(std::span<const BroadPhaseBody> bodies);

	std::vector<Aabb> boxes_; ///< with margin
	std::vector<BodyPair> pairs_;
	std::vector<Group> groups_;
	std::vector<std::size_t> first_groups_; ///< of each color, and the end
	std::uint64_t version_ = 0;
	std::uint64_t rebuild_count_ = 0;
	std::uint64_t sought_bodies_ = 0;

	BoxGrid grid_; ///< of the boxes with margin, by body
	std::vector<std::uint32_t> names_; ///< 0, 1, 2, ...
	std::vector<BodyPair> found_; ///< candidates, in order
	std::vector<BodyPair> overlapping_; ///< those of them that overlap now, in order
	// Scratch.
	std::vector<std::uint32_t> moved_;
	std::vector<char> has_moved_;
	std::vector<std::vector<BodyPair>> found_by_task_;
	std::vector<BodyPair> kept_;
	std::vector<std::uint32_t> starts_;
	struct Square {
		std::uint64_t key;
		std::uint32_t color;
		std::uint32_t count; ///< of pairs, then the place of the next one
	};
	std::vector<Square> squares_;
	std::vector<std::uint32_t> square_at_; ///< a hash table
	std::vector<std::uint32_t> square_of_pair_;
	std::vector<std::uint32_t> in_order_;
};

} // namespace softbody
