// SPDX-License-Identifier: MIT
// Finds all pairs of bodies whose circles overlap, in time that grows with the number of bodies.
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
	Vec2 center; ///< of a circle that contains the body during the coming step
	Real radius = 0; ///< of that circle [length]
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
/// only their candidates are searched again. Candidates whose present circles overlap become pairs. Circles look the
/// same from all directions, so that a scene that is turned has the same pairs.
///
/// Pairs come in groups for several threads, and groups in phases: no two groups of one phase share a body. Pairs, groups
/// and their order depend on the present circles alone, not on earlier steps, so that a restored state continues as
/// before. The order of two pairs that share a body depends on their own island alone, not on events elsewhere.
class BroadPhase {
public:
	/// Finds the pairs of the coming step. `version` changes when the list of bodies changes. `exceptions`, sorted, are
	/// pairs to leave out. O(bodies) expected.
	void update(std::span<const BroadPhaseBody> bodies, std::uint64_t version, const ParallelFor &parallel_for = {},
			std::span<const BodyPair> exceptions = {});

	std::span<const BodyPair> pairs() const { return pairs_; }
	/// Number of phases. The groups of one phase are done before those of the next.
	std::size_t phase_count() const { return first_groups_.empty() ? 0 : first_groups_.size() - 1; }
	struct Group {
		std::uint32_t begin = 0;
		std::uint32_t end = 0;
	};
	/// The groups of a phase: consecutive ranges of `pairs()`, none empty.
	std::span<const Group> groups(std::size_t phase) const;
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
	void link_bodies(std::span<const BroadPhaseBody> bodies);
	std::uint32_t find_slabs();

	std::vector<Aabb> boxes_; ///< with margin
	std::vector<BodyPair> pairs_;
	std::vector<Group> groups_;
	std::vector<std::size_t> first_groups_; ///< of each phase, then the end
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
	std::vector<std::uint32_t> links_; ///< bodies linked to each body, from its start on
	std::vector<std::uint32_t> slab_of_; ///< of each body
	std::vector<std::uint32_t> level_;
	std::vector<std::uint32_t> next_level_;
	std::vector<std::uint32_t> group_of_pair_;
	std::vector<std::uint32_t> group_ends_; ///< counts, then the index of the next pair
};

} // namespace softbody
