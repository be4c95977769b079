// SPDX-License-Identifier: MIT
// Finds all pairs of bodies whose boxes overlap, in time that grows with the number of bodies.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/box_grid.h"
#include "core/geometry/aabb.h"

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Data of a body for the broad phase.
struct BroadPhaseBody {
	Aabb box; ///< contains the body during the coming step
	std::uint32_t layer = 1;
	std::uint32_t mask = 0xffffffffu;
	bool rests = false; ///< two resting bodies form no pair
};

/// Two bodies that may touch, as indices into the list given to the broad phase; a < b.
struct BodyPair {
	std::uint32_t a = 0;
	std::uint32_t b = 0;
	friend auto operator<=>(BodyPair, BodyPair) = default;
};

/// Finds pairs with a hashed grid of several cell sizes. Each body lies in one cell of the level whose cells are as
/// large as its box, and searches the neighboring cells of its own and all other levels. Boxes are kept with a margin.
/// As long as every body stays within its kept box, the last candidates stay valid. If a few bodies have left theirs,
/// only their candidates are searched again. Candidates whose present boxes overlap become pairs.
///
/// Pairs come in groups for several threads: no two groups of one color share a body. Pairs, groups and their order
/// depend on the present boxes alone, not on earlier steps, so that a restored state continues as before. The order of
/// two pairs that share a body depends on their own boxes alone, so that an island does not depend on events elsewhere.
class BroadPhase {
public:
	/// Finds the pairs of the coming step. `version` changes when the list of bodies changes. `exceptions`, sorted, are
	/// pairs to leave out. O(bodies) expected.
	void update(std::span<const BroadPhaseBody> bodies, std::uint64_t version, const ParallelFor &parallel_for = {},
			std::span<const BodyPair> exceptions = {});

	std::span<const BodyPair> pairs() const { return pairs_; }
	/// Number of colors. The groups of one color are done before those of the next.
	std::size_t color_count() const { return first_groups_.empty() ? 0 : first_groups_.size() - 1; }
	struct Group {
		std::uint32_t begin = 0;
		std::uint32_t end = 0;
	};
	/// The groups of a color: consecutive ranges of `pairs()`.
	std::span<const Group> groups(std::size_t color) const;
	/// Number of searches for candidates, of all bodies or of some.
	std::uint64_t rebuild_count() const { return rebuild_count_; }
	/// Total number of bodies whose candidates were searched.
	std::uint64_t sought_bodies() const { return sought_bodies_; }

private:
	/// Finds the pairs of body `i` with bodies of higher level or index. With `moved_only`, also its pairs with all
	/// bodies that have not moved.
	void find_pairs_of(std::uint32_t i, std::span<const BroadPhaseBody> bodies, bool moved_only, std::vector<BodyPair> &found) const;
	void find_all_pairs(std::span<const BroadPhaseBody> bodies, const ParallelFor &parallel_for);
	void replace_pairs_of_moved(std::span<const BroadPhaseBody> bodies);
	void keep_overlapping(std::span<const BroadPhaseBody> bodies, std::span<const BodyPair> exceptions);
	void group_pairs(std::span<const BroadPhaseBody> bodies);

	std::vector<Aabb> boxes_; ///< with margin
	std::vector<BodyPair> pairs_;
	std::vector<Group> groups_;
	std::vector<std::size_t> first_groups_; ///< of each color, then the end
	std::uint64_t version_ = 0;
	std::uint64_t rebuild_count_ = 0;
	std::uint64_t sought_bodies_ = 0;

	BoxGrid grid_; ///< boxes with margin, named by body
	std::vector<std::uint32_t> names_; ///< 0, 1, 2, ...
	std::vector<BodyPair> found_; ///< candidates, sorted
	std::vector<BodyPair> overlapping_; ///< candidates that overlap now, sorted
	// Scratch memory.
	std::vector<std::uint32_t> moved_;
	std::vector<char> has_moved_;
	std::vector<std::vector<BodyPair>> found_by_task_;
	std::vector<BodyPair> kept_;
	std::vector<std::uint32_t> starts_;
	struct Square {
		std::uint64_t key;
		std::uint32_t color;
		std::uint32_t count; ///< of pairs, then the index of the next pair
	};
	std::vector<Square> squares_;
	std::vector<std::uint32_t> square_at_; ///< hash table
	std::vector<std::uint32_t> square_of_pair_;
	std::vector<std::uint32_t> in_order_;
};

} // namespace softbody
