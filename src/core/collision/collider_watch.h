// SPDX-License-Identifier: MIT
// Finds changes of the environment of sleeping bodies.
#pragma once

#include "core/collision/collider_index.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Compares the environment with that of the last step. Colliders are identified by their content, not by their index,
/// as many callers pass a new list every step.
class ColliderWatch {
public:
	/// `index` must be up to date for the coming step. O(1) while nothing was added or removed and no rigid body
	/// exists, else O(n log n) in the number of colliders.
	void update(const ColliderIndex &index);
	/// Whether a border was added, removed or changed. The change may then be anywhere.
	bool has_border_changed() const { return border_changed_; }
	/// Boxes of the colliders that were added, removed or changed, or that move.
	std::span<const Aabb> changed_boxes() const { return changed_; }
	/// Boxes of the colliders that move now. They come first in `changed_boxes`.
	std::span<const Aabb> moving_boxes() const { return { changed_.data(), moving_ }; }
	/// Hash of the environment around a box: of borders and of the colliders that stand still, are kinematic or belong
	/// to sleeping rigid bodies. Equal as long as those do not change. O(colliders near).
	std::uint64_t describe(const ColliderIndex &index, const Aabb &box);

private:
	struct Seen {
		std::uint64_t hash = 0;
		Aabb box;
	};
	std::vector<Seen> seen_; ///< sorted by hash
	std::vector<Seen> last_;
	std::vector<Seen> differing_; ///< scratch memory
	std::vector<Aabb> changed_; ///< moving colliders first
	std::size_t moving_ = 0;
	std::vector<std::uint32_t> near_;
	std::uint64_t border_hash_ = 0;
	std::uint64_t version_ = UINT64_MAX;
	bool border_changed_ = false;
	bool had_rigid_bodies_ = false;
};

} // namespace softbody
