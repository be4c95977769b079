// SPDX-License-Identifier: MIT
// A hashed grid of several cell sizes, for box queries.
#include "core/collision/box_grid.h"

#include "core/base/hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace softbody {

namespace {

// Boxes larger than this many doublings of the smallest cells share the last level. A query tests them one by one.
constexpr std::uint32_t LEVELS = 24;

// Cells are a little larger than the boxes in them, so that rounding cannot put a box that just touches out of reach.
constexpr Real ROOM = Real(1.01);

} // namespace

BoxGrid::Entry BoxGrid::entry_of(const Aabb &box, std::uint32_t name) const {
	Entry entry;
	entry.box = box;
	entry.name = name;
	Real size = cell_size_;
	for (const Real extent = box.extent() * ROOM; size < extent && entry.level + 1 < LEVELS; size *= 2) {
		++entry.level;
	}
	const Vec2 center = box.center();
	entry.x = cell_coordinate(center.x, size);
	entry.y = cell_coordinate(center.y, size);
	return entry;
}

std::uint32_t BoxGrid::bucket_of(const Level &level, std::int32_t x, std::int32_t y) {
	return level.first_bucket + (std::uint32_t(mixed(cell_key(x, y))) & (level.buckets - 1));
}

void BoxGrid::choose_cell_size(std::span<const Aabb> boxes) {
	extents_.clear();
	for (const Aabb &box : boxes) {
		if (const Real extent = box.extent() * ROOM; std::isfinite(extent)) {
			extents_.push_back(extent);
		}
	}
	// Chosen so that most boxes lie in cells of level 0: a query visits few levels, and few of those cells hold several
	// boxes.
	cell_size_ = 1;
	if (!extents_.empty()) {
		const auto most = extents_.begin() + std::ptrdiff_t(extents_.size() * 3 / 4);
		std::nth_element(extents_.begin(), most, extents_.end());
		cell_size_ = *most > 0 ? *most : Real(1);
	}
}

void BoxGrid::assign(std::span<const Aabb> boxes, std::span<const std::uint32_t> names, bool keep_cell_size) {
	unsorted_.clear();
	levels_.clear();
	level_of_.clear();
	if (!keep_cell_size) {
		choose_cell_size(boxes);
	}
	std::array<std::uint32_t, LEVELS> counts{};
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		unsorted_.push_back(entry_of(boxes[i], names[i]));
		level_of_.push_back(unsorted_.back().level);
		++counts[unsorted_.back().level];
	}
	std::array<std::uint32_t, LEVELS> index_of_level{};
	std::uint32_t entries = 0;
	std::uint32_t buckets = 0;
	for (std::uint32_t level = 0; level < LEVELS; ++level) {
		if (counts[level] > 0) {
			index_of_level[level] = std::uint32_t(levels_.size());
			const std::uint32_t own = std::bit_ceil(2 * counts[level]);
			levels_.push_back({ level, std::ldexp(cell_size_, int(level)), entries, entries + counts[level], buckets, own });
			entries += counts[level];
			buckets += own;
		}
	}
	// Counting sort by bucket. Filling from the back moves each start to the beginning of its bucket.
	bucket_starts_.assign(buckets + 1, 0);
	for (const Entry &entry : unsorted_) {
		++bucket_starts_[bucket_of(levels_[index_of_level[entry.level]], entry.x, entry.y)];
	}
	std::inclusive_scan(bucket_starts_.begin(), bucket_starts_.end(), bucket_starts_.begin());
	entries_.resize(unsorted_.size());
	for (const Entry &entry : unsorted_) {
		entries_[--bucket_starts_[bucket_of(levels_[index_of_level[entry.level]], entry.x, entry.y)]] = entry;
	}
	if (counts[LEVELS - 1] > 0) {
		levels_.back().cell_size = std::numeric_limits<Real>::infinity(); // its boxes are of any size
	}
}

bool BoxGrid::overlaps_any(const Aabb &box) const {
	return visit(box, 0, [](std::uint32_t, std::uint32_t) { return true; });
}

void BoxGrid::collect(const Aabb &box, std::vector<std::uint32_t> &names) const {
	visit(box, 0, [&](std::uint32_t name, std::uint32_t) {
		names.push_back(name);
		return false;
	});
}

} // namespace softbody
