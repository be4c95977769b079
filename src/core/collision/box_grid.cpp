// SPDX-License-Identifier: MIT
// A hashed grid of several cell sizes, for asking.
#include "core/collision/box_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

// Boxes larger than this many doublings of the smallest cells share the last level, which is asked one by one.
constexpr std::uint32_t LEVELS = 24;

// What lies where no cell has a number is gathered at the edge.
constexpr Real FARTHEST_CELL = Real(1 << 30);

// Cells are a little larger than the boxes in them, so that rounding cannot put a box that just touches out of reach.
constexpr Real ROOM = Real(1.01);

Real extent_of(const Aabb &box) {
	return std::max(box.max.x - box.min.x, box.max.y - box.min.y) * ROOM;
}

std::int32_t cell_coordinate(Real position, Real size) {
	// In this order, what is no number gets one.
	return std::int32_t(std::max(-FARTHEST_CELL, std::min(FARTHEST_CELL, std::floor(position / size))));
}

} // namespace

BoxGrid::Entry BoxGrid::entry_of(const Aabb &box, std::uint32_t name) const {
	Entry entry;
	entry.box = box;
	entry.name = name;
	Real size = cell_size_;
	for (const Real extent = extent_of(box); size < extent && entry.level + 1 < LEVELS; size *= 2) {
		++entry.level;
	}
	const Vec2 center = (box.min + box.max) * Real(0.5);
	entry.x = cell_coordinate(center.x, size);
	entry.y = cell_coordinate(center.y, size);
	return entry;
}

std::uint32_t BoxGrid::bucket_of(const Level &level, std::int32_t x, std::int32_t y) {
	std::uint64_t key = (std::uint64_t(std::uint32_t(x)) << 32) | std::uint32_t(y);
	key ^= key >> 31;
	key *= 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio (Knuth's multiplicative hash)
	key ^= key >> 29;
	return level.first_bucket + (std::uint32_t(key) & (level.buckets - 1));
}

void BoxGrid::assign(std::span<const Aabb> boxes, std::span<const std::uint32_t> names) {
	extents_.clear();
	unsorted_.clear();
	levels_.clear();
	for (const Aabb &box : boxes) {
		extents_.push_back(extent_of(box));
	}
	cell_size_ = 1;
	if (!extents_.empty()) {
		// Small boxes share the cells of the ordinary ones, instead of adding levels to every question.
		const auto middle = extents_.begin() + std::ptrdiff_t(extents_.size() / 2);
		std::nth_element(extents_.begin(), middle, extents_.end());
		cell_size_ = *middle > 0 ? *middle : Real(1);
	}
	std::array<std::uint32_t, LEVELS> counts{};
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		unsorted_.push_back(entry_of(boxes[i], names[i]));
		++counts[unsorted_.back().level];
	}
	std::array<std::uint32_t, LEVELS> place_of_level{};
	std::uint32_t entries = 0;
	std::uint32_t buckets = 0;
	for (std::uint32_t level = 0; level < LEVELS; ++level) {
		if (counts[level] > 0) {
			place_of_level[level] = std::uint32_t(levels_.size());
			const std::uint32_t own = std::bit_ceil(2 * counts[level]);
			levels_.push_back({ std::ldexp(cell_size_, int(level)), entries, entries + counts[level], buckets, own });
			entries += counts[level];
			buckets += own;
		}
	}
	// Counted by bucket; filled from the back, each start moves to where its bucket begins.
	bucket_starts_.assign(buckets + 1, 0);
	for (const Entry &entry : unsorted_) {
		++bucket_starts_[bucket_of(levels_[place_of_level[entry.level]], entry.x, entry.y)];
	}
	std::uint32_t sum = 0;
	for (std::uint32_t &start : bucket_starts_) {
		sum += start;
		start = sum;
	}
	entries_.resize(unsorted_.size());
	for (const Entry &entry : unsorted_) {
		entries_[--bucket_starts_[bucket_of(levels_[place_of_level[entry.level]], entry.x, entry.y)]] = entry;
	}
	if (counts[LEVELS - 1] > 0) {
		levels_.back().cell_size = std::numeric_limits<Real>::infinity(); // its boxes are of any size
	}
}

// Until `visit` says that it has seen enough.
template <class Visit>
bool BoxGrid::visit(const Aabb &box, const Visit &visit) const {
	for (const Level &level : levels_) {
		const Real size = level.cell_size;
		// A box of this level reaches at most half a cell beyond its center.
		const Aabb reach = box.grown(size / 2);
		const Real width = (reach.max.x - reach.min.x) / size + 1;
		const Real height = (reach.max.y - reach.min.y) / size + 1;
		if (!(width * height < Real(level.end - level.begin))) { // more cells than boxes, or no number
			for (std::uint32_t k = level.begin; k < level.end; ++k) {
				if (entries_[k].box.overlaps(box) && visit(entries_[k].name)) {
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
					if (entry.x == x && entry.y == y && entry.box.overlaps(box) && visit(entry.name)) {
						return true;
					}
				}
			}
		}
	}
	return false;
}

bool BoxGrid::overlaps_any(const Aabb &box) const {
	return visit(box, [](std::uint32_t) { return true; });
}

void BoxGrid::collect(const Aabb &box, std::vector<std::uint32_t> &names) const {
	visit(box, [&](std::uint32_t name) {
		names.push_back(name);
		return false;
	});
}

} // namespace softbody
