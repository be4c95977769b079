// SPDX-License-Identifier: MIT
// A hashed grid of several cell sizes.
#include "core/collision/broad_phase.h"

#include "core/base/hash.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <type_traits>

namespace softbody {

namespace {

// Margin of a kept box, as a share of its extent [1]. Larger: fewer searches, but more candidates that do not touch.
constexpr Real BOX_MARGIN = Real(0.08);

// Above this share of bodies that have left their boxes [1], the candidates of all bodies are searched again.
constexpr Real MOST_MOVED = Real(0.3);

constexpr std::size_t BODIES_A_TASK = 256;

// Extent of the largest bodies of a level, and side of the squares by which pairs are grouped, in the level's unit. Two
// bodies of a level that touch are less than 2 units apart, so the first bodies of two pairs that share a body are less
// than 4 units apart.
constexpr Real GROUPED_EXTENT = Real(1.99);
constexpr Real GROUP_SQUARE = 4;
constexpr std::uint32_t SQUARE_COLORS = 4;

// Level of pairs with a body whose extent is not finite or too large. All of them form one group, after all others.
constexpr std::uint32_t UNGROUPED = 1 << 16;

// The least n with extent < GROUPED_EXTENT 2^n, counted from LOWEST_LEVEL.
constexpr int LOWEST_LEVEL = std::numeric_limits<Real>::min_exponent - 2;

std::uint32_t level_of(Real extent) {
	constexpr int DIGITS = std::numeric_limits<Real>::digits - 1; // of the fraction; the exponent lies above it
	using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
	if (!(extent < std::numeric_limits<Real>::max() / GROUP_SQUARE)) {
		return UNGROUPED;
	}
	return std::uint32_t(std::bit_cast<Bits>(extent / GROUPED_EXTENT) >> DIGITS); // valid as the extent is not negative
}

Real unit_of(std::uint32_t level) {
	return std::ldexp(Real(1), int(level) + LOWEST_LEVEL + 1);
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
			boxes_[i] = bodies[i].box.grown(BOX_MARGIN * bodies[i].box.extent());
			has_moved_[i] = 1;
			moved_.push_back(i);
		}
	}
	if (!same_bodies || !moved_.empty()) {
		++rebuild_count_;
		const bool seeks_all = !same_bodies || moved_.size() > std::size_t(MOST_MOVED * Real(bodies.size()));
		sought_bodies_ += seeks_all ? bodies.size() : moved_.size();
		names_.resize(bodies.size());
		std::iota(names_.begin(), names_.end(), 0u);
		grid_.assign(boxes_, names_, !seeks_all);
		if (seeks_all) {
			find_all_pairs(bodies, parallel_for);
		} else {
			replace_pairs_of_moved(bodies);
		}
	}
	keep_overlapping(bodies, exceptions);
	group_pairs(bodies);
}

void BroadPhase::find_pairs_of(std::uint32_t i, std::span<const BroadPhaseBody> bodies, bool moved_only,
		std::vector<BodyPair> &found) const {
	const std::uint32_t own_level = grid_.level_of(i);
	// Every pair is found once: by the body of the lower level, and within a level by the body of lower index. If only
	// bodies that have moved search, such a body also finds its pairs with bodies that have not moved.
	grid_.visit(boxes_[i], moved_only ? 0 : own_level, [&](std::uint32_t other, std::uint32_t level) {
		const bool is_found_by_other = level < own_level || (level == own_level && other <= i);
		const bool is_ours = !is_found_by_other || (moved_only && !has_moved_[other]);
		const BroadPhaseBody &a = bodies[i];
		const BroadPhaseBody &b = bodies[other];
		if (is_ours && ((a.mask & b.layer) | (b.mask & a.layer)) != 0) {
			found.push_back({ std::min(i, other), std::max(i, other) });
		}
		return false;
	});
}

void BroadPhase::find_all_pairs(std::span<const BroadPhaseBody> bodies, const ParallelFor &parallel_for) {
	const std::size_t count = boxes_.size();
	found_by_task_.resize(MOST_SLICES);
	for (std::vector<BodyPair> &found : found_by_task_) {
		found.clear();
	}
	run_slices(parallel_for, count, BODIES_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i) {
			find_pairs_of(std::uint32_t(i), bodies, false, found_by_task_[task]);
		}
	});
	// Counting sort by the first body, then a sort by the second among the few pairs of one first body.
	starts_.assign(count + 1, 0);
	std::size_t pairs = 0;
	for (const std::vector<BodyPair> &found : found_by_task_) {
		pairs += found.size();
		for (const BodyPair pair : found) {
			++starts_[pair.a];
		}
	}
	std::inclusive_scan(starts_.begin(), starts_.end(), starts_.begin());
	found_.resize(pairs);
	for (const std::vector<BodyPair> &found : found_by_task_) {
		for (const BodyPair pair : found) {
			found_[--starts_[pair.a]] = pair;
		}
	}
	for (std::size_t body = 0; body < count; ++body) { // its pairs now lie from its start to the next body's
		std::sort(found_.begin() + starts_[body], found_.begin() + starts_[body + 1]);
	}
}

void BroadPhase::replace_pairs_of_moved(std::span<const BroadPhaseBody> bodies) {
	found_by_task_.resize(MOST_SLICES);
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

// Pairs are sorted by the extent of their larger body into levels, each twice as large as the one before. For each
// level the plane is divided into squares of GROUP_SQUARE of its units, colored by parity: (even, even), (odd, even),
// ... A pair belongs to the square that holds the center of its first body. Two pairs of one level that share a body
// have first bodies less than the side of a square apart. Different squares of one color are at least that far apart.
// So such pairs are in one group, or in groups of different colors. The group of a pair depends on its two boxes alone,
// so that distant events do not change the order in which the contacts of an island are solved.
void BroadPhase::group_pairs(std::span<const BroadPhaseBody> bodies) {
	constexpr std::uint32_t NONE = UINT32_MAX;
	groups_.clear();
	first_groups_.clear();
	pairs_.resize(overlapping_.size());
	squares_.clear();
	square_at_.assign(std::bit_ceil(2 * overlapping_.size() + 4), NONE); // at most half full
	const auto square_of = [&](std::uint64_t key, std::uint32_t color) {
		std::size_t slot = std::size_t(mixed(key + color)) & (square_at_.size() - 1);
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
		const std::uint32_t level = level_of(std::max(bodies[pair.a].box.extent(), bodies[pair.b].box.extent()));
		if (level == UNGROUPED) {
			last_square = square_of(0, level * SQUARE_COLORS);
		} else if (pair.a != last_body || level != last_level) {
			const Real size = GROUP_SQUARE * unit_of(level);
			const Vec2 center = bodies[pair.a].box.center();
			const std::int32_t x = cell_coordinate(center.x, size);
			const std::int32_t y = cell_coordinate(center.y, size);
			last_square = square_of(cell_key(x, y), level * SQUARE_COLORS + std::uint32_t(x & 1) + 2 * std::uint32_t(y & 1));
		}
		last_body = pair.a;
		last_level = level;
		++squares_[last_square].count;
		square_of_pair_[i] = last_square;
	}
	// Squares by color, in the order in which pairs first fell into them; then the pairs of each square.
	in_order_.resize(squares_.size());
	std::iota(in_order_.begin(), in_order_.end(), 0u);
	std::ranges::sort(in_order_, [&](std::uint32_t a, std::uint32_t b) { // std::stable_sort would allocate each time
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
