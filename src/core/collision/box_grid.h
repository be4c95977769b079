// SPDX-License-Identifier: MIT
// Which of many boxes overlap a given one, found in time that does not depend on how many there are.
#pragma once

#include "core/geometry/polygon.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Boxes in a hashed grid of several cell sizes: each lies in the cell of its center, on the level whose cells are as
/// large as the box, and a question visits on every level the cells from which a box may reach. A tile map and the
/// long floor under it thus cost what is near.
class BoxGrid {
public:
	/// Replaces the content; box i goes by the name `names[i]`. O(boxes) expected.
	void assign(std::span<const Aabb> boxes, std::span<const std::uint32_t> names);
	bool empty() const { return entries_.empty(); }
	/// O(boxes near it).
	bool overlaps_any(const Aabb &box) const;
	/// Appends the names of the boxes that overlap `box`, in no particular order, each once. O(boxes near it).
	void collect(const Aabb &box, std::vector<std::uint32_t> &names) const;

private:
	struct Entry {
		Aabb box;
		std::int32_t x = 0; ///< cell
		std::int32_t y = 0;
		std::uint32_t level = 0;
		std::uint32_t name = 0;
	};
	/// The boxes of one level, by bucket.
	struct Level {
		Real cell_size = 0;
		std::uint32_t begin = 0; ///< of its entries
		std::uint32_t end = 0;
		std::uint32_t first_bucket = 0; ///< of `bucket_starts_`
		std::uint32_t buckets = 0; ///< a power of two
	};

	Entry entry_of(const Aabb &box, std::uint32_t name) const;
	static std::uint32_t bucket_of(const Level &level, std::int32_t x, std::int32_t y);
	template <class Visit>
	bool visit(const Aabb &box, const Visit &visit) const;

	Real cell_size_ = 1; ///< of level 0; every further level doubles it
	std::vector<Level> levels_; ///< those in use
	std::vector<Entry> entries_;
	std::vector<std::uint32_t> bucket_starts_;
	// Scratch.
	std::vector<Entry> unsorted_;
	std::vector<Real> extents_;
};

} // namespace softbody
