// SPDX-License-Identifier: MIT
// Finds the boxes that overlap a given box, in time that does not depend on the total number of boxes.
#pragma once

#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Cell of side `size` > 0 that holds a position. Cells beyond 2^30 are merged into the last one.
inline std::int32_t cell_coordinate(Real position, Real size) {
	constexpr Real FARTHEST_CELL = Real(1 << 30);
	// The order of arguments matters: NaN maps to a valid cell.
	return std::int32_t(std::max(-FARTHEST_CELL, std::min(FARTHEST_CELL, std::floor(position / size))));
}

constexpr std::uint64_t cell_key(std::int32_t x, std::int32_t y) {
	return (std::uint64_t(std::uint32_t(x)) << 32) | std::uint32_t(y);
}

/// Boxes in a hashed grid of several cell sizes. Each box lies in the cell of its center, on the level whose cells are
/// as large as the box. A query visits, on every level, the cells from which a box may reach. A tile map and the long
/// floor under it thus cost only the boxes nearby.
class BoxGrid {
public:
	/// Replaces the content; box i is named `names[i]`. `keep_cell_size` leaves the size of the cells unchanged.
	/// O(boxes) expected.
	void assign(std::span<const Aabb> boxes, std::span<const std::uint32_t> names, bool keep_cell_size = false);
	bool empty() const { return entries_.empty(); }
	/// Whether any box overlaps `box`. O(boxes near it).
	bool overlaps_any(const Aabb &box) const;
	/// Appends the names of the boxes that overlap `box`, in no particular order, each once. O(boxes near it).
	void collect(const Aabb &box, std::vector<std::uint32_t> &names) const;

	/// Level of box i of the last `assign`. Boxes of a higher level are larger.
	std::uint32_t level_of(std::size_t i) const { return level_of_[i]; }
	/// Calls `visit(name, level)` for each box of `least_level` or higher that overlaps `box`, in no particular order, until one
	/// returns true. Returns whether one did. O(boxes near it).
	template <class Visit>
	bool visit(const Aabb &box, std::uint32_t least_level, const Visit &visit) const;

private:
	struct Entry {
		Aabb box;
		std::int32_t x = 0; ///< cell
		std::int32_t y = 0;
		std::uint32_t level = 0;
		std::uint32_t name = 0;
	};
	/// The boxes of one level, sorted by bucket.
	struct Level {
		std::uint32_t number = 0;
		Real cell_size = 0;
		std::uint32_t begin = 0; ///< first of its entries
		std::uint32_t end = 0;
		std::uint32_t first_bucket = 0; ///< in `bucket_starts_`
		std::uint32_t buckets = 0; ///< a power of two
	};

	void choose_cell_size(std::span<const Aabb> boxes);
	Entry entry_of(const Aabb &box, std::uint32_t name) const;
	static std::uint32_t bucket_of(const Level &level, std::int32_t x, std::int32_t y);
	Real cell_size_ = 1; ///< side of the cells of level 0 [length]; every further level doubles it
	std::vector<Level> levels_; ///< the levels in use
	std::vector<Entry> entries_;
	std::vector<std::uint32_t> bucket_starts_;
	std::vector<std::uint32_t> level_of_;
	// Scratch memory.
	std::vector<Entry> unsorted_;
	std::vector<Real> extents_;
};

template <class Visit>
bool BoxGrid::visit(const Aabb &box, std::uint32_t least_level, const Visit &visit) const {
	for (const Level &level : levels_) {
		if (level.number < least_level) {
			continue;
		}
		const Real size = level.cell_size;
		// A box of this level reaches at most half a cell beyond its center.
		const Aabb reach = box.grown(size / 2);
		const Real width = (reach.max.x - reach.min.x) / size + 1;
		const Real height = (reach.max.y - reach.min.y) / size + 1;
		// With more cells than boxes, with an inverted box, or with NaN, each box is tested.
		if (!(width > 0 && height > 0 && width * height < Real(level.end - level.begin))) {
			for (std::uint32_t k = level.begin; k < level.end; ++k) {
				if (entries_[k].box.overlaps(box) && visit(entries_[k].name, level.number)) {
					return true;
				}
			}
			continue;
		}
		const std::int32_t right = cell_coordinate(reach.max.x, size);
		const std::int32_t bottom = cell_coordinate(reach.max.y, size);
		for (std::int32_t y = cell_coordinate(reach.min.y, size); y <= bottom; ++y) {
			for (std::int32_t x = cell_coordinate(reach.min.x, size); x <= right; ++x) {
				const std::uint32_t bucket = bucket_of(level, x, y);
				for (std::uint32_t k = bucket_starts_[bucket]; k < bucket_starts_[bucket + 1]; ++k) {
					const Entry &entry = entries_[k];
					if (entry.x == x && entry.y == y && entry.box.overlaps(box) && visit(entry.name, level.number)) {
						return true;
					}
				}
			}
		}
	}
	return false;
}

} // namespace softbody
