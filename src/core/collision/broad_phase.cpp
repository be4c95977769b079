// SPDX-License-Identifier: MIT
// A hashed grid of several cell sizes.
#include "core/collision/broad_phase.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <type_traits>

namespace softbody {

namespace {

// Margin of a kept box, as a share of its extent. Larger: fewer rebuilds, more pairs that do not touch.
constexpr Real BOX_MARGIN = Real(0.08);

// Above this share of bodies that have left their boxes, all pairs are sought anew.
constexpr Real MOST_MOVED = Real(0.3);

constexpr std::size_t BODIES_A_TASK = 256;
constexpr std::size_t TASKS = 32;

// Level of all boxes that are larger than so many doublings of the smallest cells: everybody looks at all of them.
constexpr std::uint32_t ALL_SIZES = 23;

// Extent of the largest bodies of a level, and side of the squares by which pairs are grouped, in the level's unit. Two bodies
// of a level that touch are less than 2 units apart, so that all who share a body with a pair are within 4 of it.
constexpr Real GROUPED_EXTENT = Real(1.99);
constexpr Real GROUP_SQUARE = 4;
constexpr std::uint32_t SQUARE_COLORS = 4;

// The level of pairs with a body that has no size one could tell: all in one group, after all others.
constexpr std::uint32_t UNGROUPED = 1 << 16;

// Bodies flung to where no cell has a number are gathered at the edge.
constexpr Real FARTHEST_CELL = Real(1 << 30);

Real extent_of(const Aabb &box) {
	return std::max(box.max.x - box.min.x, box.max.y - box.min.y);
}

std::int32_t cell_coordinate(Real position, Real size) {
	// In this order, what is no number gets one.
	return std::int32_t(std::max(-FARTHEST_CELL, std::min(FARTHEST_CELL, std::floor(position / size))));
}

// The least n with extent < GROUPED_EXTENT 2^n, counted from LOWEST_LEVEL.
constexpr int LOWEST_LEVEL = std::numeric_limits<Real>::min_exponent - 2;

std::uint32_t level_of(Real extent) {
	constexpr int DIGITS = std::numeric_limits<Real>::digits - 1; // of the fraction; above it the exponent
	using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
	if (!(extent < std::numeric_limits<Real>::max() / GROUP_SQUARE)) {
		return UNGROUPED;
	}
	return std::uint32_t(std::bit_cast<Bits>(extent / GROUPED_EXTENT) >> DIGITS); // of what is not negative
}

Real unit_of(std::uint32_t level) {
	return std::ldexp(Real(1), int(level) + LOWEST_LEVEL + 1);
}

std::uint64_t mix(std::uint64_t key) {
	key ^= key >> 31;
	key *= 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio (Knuth's multiplicative hash)
	return key ^ (key >> 29);
}

} // namespace

void BroadPhase::update(std::span<const BroadPhaseBody> bodies, std::uint64_t version, const ParallelFor &parallel_for,
		std::span<const BodyPair> exceptions) {
	const bool same_bodies = version == version_ && boxes_.size() == bodies.size() && rebuild_count_ > 0;
	version_ = version;
	boxes_.resize(bodies.size());
	has_moved_.assign(bodies.size(), 0);
	moved_.clear();
	for (std::uint32_t i = 0; i < bodies.size(); ++i) {
		if (!same_bodies || !boxes_[i].contains(bodies[i].box)) {
			boxes_[i] = bodies[i].box.grown(BOX_MARGIN * extent_of(bodies[i].box));
			has_moved_[i] = 1;
			moved_.push_back(i);
		}
	}
	if (same_bodies && moved_.empty()) {
		keep_overlapping(bodies, exceptions);
		group_pairs(bodies);
		return;
	}
	++rebuild_count_;
	if (!same_bodies || moved_.size() > std::size_t(MOST_MOVED * Real(bodies.size()))) {
		sought_bodies_ += bodies.size();
		choose_cell_size();
		fill_grid();
		find_all_pairs(bodies, parallel_for);
	} else {
		sought_bodies_ += moved_.size();
		fill_grid();
		replace_pairs_of_moved(bodies);
	}
	keep_overlapping(bodies, exceptions);
	group_pairs(bodies);
}

void BroadPhase::choose_cell_size() {
	extents_.clear();
	for (const Aabb &box : boxes_) {
		if (std::isfinite(extent_of(box))) { // in endless cells nobody would find anybody
			extents_.push_back(extent_of(box));
		}
	}
	// Most bodies lie in cells of level 0, and few of those cells hold several.
	cell_size_ = 1;
	if (!extents_.empty()) {
		const auto most = extents_.begin() + std::ptrdiff_t(extents_.size() * 3 / 4);
		std::nth_element(extents_.begin(), most, extents_.end());
		cell_size_ = *most > 0 ? *most : Real(1);
	}
}

BroadPhase::Entry BroadPhase::cell_of(const Aabb &box, std::uint32_t body) const {
	const Real extent = extent_of(box);
	Entry entry;
	entry.body = body;
	Real size = cell_size_;
	while (size < extent && entry.level < ALL_SIZES) {
		size *= 2;
		entry.level = size < std::numeric_limits<Real>::max() / 4 ? entry.level + 1 : ALL_SIZES;
	}
	if (entry.level == ALL_SIZES) {
		return entry; // in no cell
	}
	const Vec2 center = (box.min + box.max) * Real(0.5);
	entry.x = cell_coordinate(center.x, size);
	entry.y = cell_coordinate(center.y, size);
	return entry;
}

std::size_t BroadPhase::bucket_of(std::int32_t x, std::int32_t y, std::uint32_t level) const {
	const std::uint64_t place = (std::uint64_t(std::uint32_t(x)) << 32) | std::uint32_t(y);
	const std::size_t last_bucket = bucket_starts_.size() - 2; // their number is a power of two; the end is one more
	return std::size_t(mix(place + (std::uint64_t(level) << 27))) & last_bucket;
}

void BroadPhase::fill_grid() {
	const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(2 * boxes_.size(), 2));
	bucket_starts_.assign(buckets + 1, 0);
	cells_.clear();
	used_levels_ = 0;
	for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
		cells_.push_back(cell_of(boxes_[i], i));
		const Entry &entry = cells_.back();
		used_levels_ |= 1u << entry.level;
		++bucket_starts_[bucket_of(entry.x, entry.y, entry.level) + 1];
	}
	for (std::size_t i = 1; i < bucket_starts_.size(); ++i) {
		bucket_starts_[i] += bucket_starts_[i - 1];
	}
	entries_.resize(cells_.size());
	// Filled from the back, each start moves to where its bucket begins, and bodies stay in order.
	for (std::size_t i = cells_.size(); i-- > 0;) {
		const Entry &entry = cells_[i];
		entries_[--bucket_starts_[bucket_of(entry.x, entry.y, entry.level) + 1]] = entry;
	}
	for (std::size_t i = 0; i + 1 < bucket_starts_.size(); ++i) {
		bucket_starts_[i] = bucket_starts_[i + 1];
	}
	bucket_starts_.back() = std::uint32_t(entries_.size());
}

void BroadPhase::find_pairs_of(std::uint32_t i, std::span<const BroadPhaseBody> bodies, bool moved_only,
		std::vector<BodyPair> &found) const {
	const std::uint32_t own_level = cells_[i].level;
	const Aabb &box = boxes_[i];
	const auto meet = [&](const Entry &other) {
		// Every pair is found once: by the finer level, within a level by the lower number; where only those that have
		// moved ask, also by whoever meets one that has not.
		const bool is_found_by_other = other.level < own_level || (other.level == own_level && other.body <= i);
		if (is_found_by_other && (!moved_only || has_moved_[other.body])) {
			return;
		}
		const BroadPhaseBody &a = bodies[i];
		const BroadPhaseBody &b = bodies[other.body];
		const bool notice = ((a.mask & b.layer) | (b.mask & a.layer)) != 0;
		if (notice && box.overlaps(boxes_[other.body])) {
			found.push_back({ std::min(i, other.body), std::max(i, other.body) });
		}
	};
	const std::uint32_t first_level = moved_only ? 0 : own_level;
	for (std::uint32_t levels = used_levels_ >> first_level << first_level; levels != 0; levels &= levels - 1) {
		const std::uint32_t level = std::uint32_t(std::countr_zero(levels));
		// A body of this level reaches half a cell beyond its center.
		const Real size = std::ldexp(cell_size_, int(std::min(level, ALL_SIZES - 1)));
		const std::int32_t left = cell_coordinate(box.min.x - size / 2, size);
		const std::int32_t right = cell_coordinate(box.max.x + size / 2, size);
		const std::int32_t top = cell_coordinate(box.min.y - size / 2, size);
		const std::int32_t bottom = cell_coordinate(box.max.y + size / 2, size);
		const Real cells = (Real(right) - Real(left) + 1) * (Real(bottom) - Real(top) + 1);
		if (level == ALL_SIZES || cells > Real(cells_.size())) {
			for (const Entry &other : cells_) {
				if (other.level == level) {
					meet(other);
				}
			}
			continue;
		}
		for (std::int32_t y = top; y <= bottom; ++y) {
			for (std::int32_t x = left; x <= right; ++x) {
				const std::size_t bucket = bucket_of(x, y, level);
				for (std::uint32_t k = bucket_starts_[bucket]; k < bucket_starts_[bucket + 1]; ++k) {
					const Entry &other = entries_[k];
					if (other.x == x && other.y == y && other.level == level) {
						meet(other);
					}
				}
			}
		}
	}
}

void BroadPhase::find_all_pairs(std::span<const BroadPhaseBody> bodies, const ParallelFor &parallel_for) {
	const std::size_t count = boxes_.size();
	const std::size_t tasks = std::clamp<std::size_t>(count / BODIES_A_TASK, 1, TASKS);
	found_by_task_.resize(TASKS);
	run_tasks(parallel_for, tasks, [&](std::size_t task) {
		std::vector<BodyPair> &found = found_by_task_[task];
		found.clear();
		for (std::size_t i = count * task / tasks; i < count * (task + 1) / tasks; ++i) {
			find_pairs_of(std::uint32_t(i), bodies, false, found);
		}
	});
	// Into order: counted by the first body, then by the second among the few of one first body.
	starts_.assign(count + 1, 0);
	std::size_t pairs = 0;
	for (std::size_t task = 0; task < tasks; ++task) {
		pairs += found_by_task_[task].size();
		for (const BodyPair pair : found_by_task_[task]) {
			++starts_[pair.a + 1];
		}
	}
	for (std::size_t i = 1; i < starts_.size(); ++i) {
		starts_[i] += starts_[i - 1];
	}
	found_.resize(pairs);
	for (std::size_t task = tasks; task-- > 0;) {
		const std::vector<BodyPair> &found = found_by_task_[task];
		for (std::size_t k = found.size(); k-- > 0;) {
			found_[--starts_[found[k].a + 1]] = found[k];
		}
	}
	for (std::size_t begin = 0; begin < found_.size();) {
		std::size_t end = begin + 1;
		while (end < found_.size() && found_[end].a == found_[begin].a) {
			++end;
		}
		std::sort(found_.begin() + std::ptrdiff_t(begin), found_.begin() + std::ptrdiff_t(end));
		begin = end;
	}
}

void BroadPhase::replace_pairs_of_moved(std::span<const BroadPhaseBody> bodies) {
	found_by_task_.resize(TASKS);
	std::vector<BodyPair> &fresh = found_by_task_[0];
	fresh.clear();
	for (const std::uint32_t i : moved_) {
		find_pairs_of(i, bodies, true, fresh);
	}
	std::ranges::sort(fresh);
	kept_.clear();
	std::ranges::copy_if(found_, std::back_inserter(kept_),
			[&](BodyPair pair) { return !has_moved_[pair.a] && !has_moved_[pair.b]; });
	found_.resize(kept_.size() + fresh.size());
	std::ranges::merge(kept_, fresh, found_.begin());
}

void BroadPhase::keep_overlapping(std::span<const BroadPhaseBody> bodies, std::span<const BodyPair> exceptions) {
	overlapping_.clear();
	for (const BodyPair pair : found_) {
		const BroadPhaseBody &a = bodies[pair.a];
		const BroadPhaseBody &b = bodies[pair.b];
		if (!(a.rests && b.rests) && a.box.overlaps(b.box)) {
			overlapping_.push_back(pair);
		}
	}
	if (!exceptions.empty()) {
		std::erase_if(overlapping_, [&](BodyPair pair) { return std::ranges::binary_search(exceptions, pair); });
	}
}

// Pairs are sorted by the extent of their larger body into levels, each twice as large as the one before. For each level the
// plane is divided into squares of GROUP_SQUARE of its units, colored like the points (even, even), (odd, even), ... A pair
// belongs to the square that holds the center of its first body. Two pairs of one level that share a body have first bodies
// less than the side of a square apart, while different squares of one color are at least that far apart: so they are in the
// same group or of different colors. Which group a pair falls into depends on its two boxes and nothing else, so that
// what happens elsewhere does not change the order in which the contacts of a island are solved.
void BroadPhase::group_pairs(std::span<const BroadPhaseBody> bodies) {
	constexpr std::uint32_t NONE = UINT32_MAX;
	groups_.clear();
	first_groups_.clear();
	pairs_.resize(overlapping_.size());
	squares_.clear();
	square_at_.assign(std::bit_ceil(2 * overlapping_.size() + 4), NONE); // at most half of it is taken
	const auto square_of = [&](std::uint64_t key, std::uint32_t color) {
		std::size_t slot = std::size_t(mix(key + color)) & (square_at_.size() - 1);
		while (square_at_[slot] != NONE && (squares_[square_at_[slot]].key != key || squares_[square_at_[slot]].color != color)) {
			slot = (slot + 1) & (square_at_.size() - 1);
		}
		if (square_at_[slot] == NONE) {
			square_at_[slot] = std::uint32_t(squares_.size());
			squares_.push_back({ key, color, 0 });
		}
		return square_at_[slot];
	};
	square_of_pair_.resize(overlapping_.size());
	std::uint32_t last_body = NONE;
	std::uint32_t last_level = NONE;
	std::uint32_t last_square = NONE;
	for (std::size_t i = 0; i < overlapping_.size(); ++i) {
		const BodyPair pair = overlapping_[i];
		const std::uint32_t level = level_of(std::max(extent_of(bodies[pair.a].box), extent_of(bodies[pair.b].box)));
		if (level == UNGROUPED) {
			last_square = square_of(0, level * SQUARE_COLORS);
		} else if (pair.a != last_body || level != last_level) {
			const Real size = GROUP_SQUARE * unit_of(level);
			const Vec2 center = (bodies[pair.a].box.min + bodies[pair.a].box.max) * Real(0.5);
			const std::int32_t x = cell_coordinate(center.x, size);
			const std::int32_t y = cell_coordinate(center.y, size);
			last_square = square_of((std::uint64_t(std::uint32_t(x)) << 32) | std::uint32_t(y),
					level * SQUARE_COLORS + std::uint32_t(x & 1) + 2 * std::uint32_t(y & 1));
		}
		last_body = pair.a;
		last_level = level;
		++squares_[last_square].count;
		square_of_pair_[i] = last_square;
	}
	// Squares by color, in the order in which pairs first fell into them; then each pair to its place.
	in_order_.resize(squares_.size());
	std::iota(in_order_.begin(), in_order_.end(), 0u);
	std::ranges::sort(in_order_, [&](std::uint32_t a, std::uint32_t b) { // a stable one takes memory each time
		return squares_[a].color != squares_[b].color ? squares_[a].color < squares_[b].color : a < b;
	});
	std::uint32_t begin = 0;
	std::uint32_t color = NONE;
	for (const std::uint32_t i : in_order_) {
		Square &square = squares_[i];
		if (square.color != color) {
			first_groups_.push_back(groups_.size());
			color = square.color;
		}
		const std::uint32_t end = begin + square.count;
		groups_.push_back({ begin, end });
		square.count = begin;
		begin = end;
	}
	first_groups_.push_back(groups_.size());
	for (std::size_t i = 0; i < overlapping_.size(); ++i) {
		pairs_[squares_[square_of_pair_[i]].count++] = overlapping_[i];
	}
}

std::span<const BroadPhase::Group> BroadPhase::groups(std::size_t color) const {
	return { groups_.data() + first_groups_[color], first_groups_[color + 1] - first_groups_[color] };
}

} // namespace softbody
