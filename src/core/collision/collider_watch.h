// SPDX-License-Identifier: MIT
// What has changed around sleeping bodies.
#pragma once

#include "core/collision/collider_index.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Compares the surroundings with those of the last step: colliders are told apart by what they are, not by their place
/// in the list, as many callers hand over a fresh list every step.
class ColliderWatch {
public:
	/// `index` must be up to date for the coming step. O(1) while nothing was added or removed and no rigid body moves,
	/// else O(n log n) in the number of colliders.
	void update(const ColliderIndex &index);
	/// Whether a border came, went or changed: then it may be anywhere.
	bool has_border_changed() const { return border_changed_; }
	/// Boxes of the colliders that came, went, changed or move.
	std::span<const Aabb> changed_boxes() const { return changed_; }
	/// Those of them that move now.
	std::span<const Aabb> moving_boxes() const { return { changed_.data(), moving_ }; }
	/// What is around a box now, as a number that stays the same while that does: colliders that stand still,
	/// are kinematic or belong to rigid bodies that sleep, and borders. O(colliders near).
	std::uint64_t describe(const ColliderIndex &index, const Aabb &box);

private:
	struct Seen {
		std::uint64_t hash = 0;
		Aabb box;
	};
	std::vector<Seen> seen_; ///< by hash
	std::vector<Seen> last_;
	std::vector<Aabb> changed_; ///< first those that move
	std::size_t moving_ = 0;
	std::vector<std::uint32_t> near_;
	std::uint64_t border_hash_ = 0;
	std::uint64_t version_ = UINT64_MAX;
	bool border_changed_ = false;
	bool had_rigid_bodies_ = false;
};

} // namespace softbody
