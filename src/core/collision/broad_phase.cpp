// SPDX-License-Identifier: MIT
// A hashed grid of several cell sizes.
#include "core/collision/broad_phase.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace softbody {

namespace {

// Margin of a kept box, as a share of its extent. Larger: fewer rebuilds, more pairs that do not touch.
constexpr Real BOX_MARGIN = Real(0.08);

// Level of all boxes that are larger than so many doublings of the smallest cells: everybody looks at all of them.
constexpr std::uint32_t ALL_SIZES = 23;

// Side of the cells by which pairs are grouped, in cells of level 0. Two bodies of extent up to 2 cells that touch
// are at most 2 cells apart, so that all who share a body with a pair are within 4 cells of it: see group_pairs.
constexpr Real GROUP_CELLS = 4;
constexpr std::uint32_t GROUPED_LEVELS = 2; // levels 0 and 1: extents up to 2 cells

// Bodies flung to where no cell has a number are gathered at the edge.
constexpr Real FARTHEST_CELL = Real(1 << 30);

Real extent_of(const Aabb &box) {
	return std::max(box.max.x - box.min.x, box.max.y - box.min.y);
}

std::int32_t cell_coordinate(Real position, Real size) {
	return std::int32_t(std::clamp(std::floor(position / size), -FARTHEST_CELL, FARTHEST_CELL));
}

std::uint64_t mix(std::uint64_t key) {
	key ^= key >> 31;
	key *= 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio (Knuth's multiplicative hash)
	return key ^ (key >> 29);
}

} // namespace

void BroadPhase::update(std::span<const BroadPhaseBody> bodies, std::uint64_t version) {
	if (still_holds(bodies, version)) {
		return;
	}
	const bool same_bodies = version == version_ && boxes_.size() == bodies.size();
	version_ = version;
	++rebuild_count_;
	boxes_.resize(bodies.size());
	for (std::size_t i = 0; i < bodies.size(); ++i) {
		if (!same_bodies || !boxes_[i].contains(bodies[i].box)) {
			boxes_[i] = bodies[i].box.grown(BOX_MARGIN * extent_of(bodies[i].box));
		}
	}
	choose_cell_size();
	fill_grid();
	find_pairs(bodies);
	group_pairs();
}

bool BroadPhase::still_holds(std::span<const BroadPhaseBody> bodies, std::uint64_t version) const {
	if (version != version_ || bodies.size() != boxes_.size() || rebuild_count_ == 0) {
		return false;
	}
	for (std::size_t i = 0; i < bodies.size(); ++i) {
		if (!boxes_[i].contains(bodies[i].box)) {
			return false;
		}
	}
	return true;
}

void BroadPhase::choose_cell_size() {
	extents_.clear();
	for (const Aabb &box : boxes_) {
		extents_.push_back(extent_of(box));
	}
	if (extents_.empty()) {
		return;
	}
	// Most bodies lie in cells of level 0, and few of those cells hold several.
	const auto most = extents_.begin() + std::ptrdiff_t(extents_.size() * 3 / 4);
	std::nth_element(extents_.begin(), most, extents_.end());
	cell_size_ = *most > 0 ? *most : Real(1);
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
	const Vec2 centre = (box.min + box.max) * Real(0.5);
	entry.x = cell_coordinate(centre.x, size);
	entry.y = cell_coordinate(centre.y, size);
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
	unsorted_.clear();
	used_levels_ = 0;
	for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
		unsorted_.push_back(cell_of(boxes_[i], i));
		const Entry &entry = unsorted_.back();
		used_levels_ |= 1u << entry.level;
		++bucket_starts_[bucket_of(entry.x, entry.y, entry.level) + 1];
	}
	for (std::size_t i = 1; i < bucket_starts_.size(); ++i) {
		bucket_starts_[i] += bucket_starts_[i - 1];
	}
	entries_.resize(unsorted_.size());
	// Filled from the back, each start moves to where its bucket begins, and bodies stay in order.
	for (std::size_t i = unsorted_.size(); i-- > 0;) {
		const Entry &entry = unsorted_[i];
		entries_[--bucket_starts_[bucket_of(entry.x, entry.y, entry.level) + 1]] = entry;
	}
	for (std::size_t i = 0; i + 1 < bucket_starts_.size(); ++i) {
		bucket_starts_[i] = bucket_starts_[i + 1];
	}
	bucket_starts_.back() = std::uint32_t(entries_.size());
}

void BroadPhase::find_pairs(std::span<const BroadPhaseBody> bodies) {
	found_.clear();
	for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
		const std::uint32_t own_level = unsorted_[i].level;
		const Aabb &box = boxes_[i];
		for (std::uint32_t levels = used_levels_ >> own_level << own_level; levels != 0; levels &= levels - 1) {
			const std::uint32_t level = std::uint32_t(std::countr_zero(levels));
			const auto meet = [&](const Entry &other) {
				if (level == own_level && other.body <= i) {
					return; // found from the other side
				}
				const BroadPhaseBody &a = bodies[i];
				const BroadPhaseBody &b = bodies[other.body];
				const bool notice = ((a.mask & b.layer) | (b.mask & a.layer)) != 0;
				if (notice && box.overlaps(boxes_[other.body])) {
					found_.push_back({ std::min(i, other.body), std::max(i, other.body) });
				}
			};
			if (level == ALL_SIZES) {
				for (const Entry &other : unsorted_) {
					if (other.level == level) {
						meet(other);
					}
				}
				continue;
			}
			// A body of this level reaches half a cell beyond its centre.
			const Real size = std::ldexp(cell_size_, int(level));
			const std::int32_t left = cell_coordinate(box.min.x - size / 2, size);
			const std::int32_t right = cell_coordinate(box.max.x + size / 2, size);
			const std::int32_t top = cell_coordinate(box.min.y - size / 2, size);
			const std::int32_t bottom = cell_coordinate(box.max.y + size / 2, size);
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
}

// The plane is divided into squares of four cells, coloured like the points (even, even), (odd, even), ... Each pair
// belongs to the square that holds the centre of its first body. Two pairs that share a body have first bodies at
// most four cells apart, while different squares of one colour are more than that apart: so they are in the
// same group or of different colours. Pairs with a larger body form one last group.
void BroadPhase::group_pairs() {
	const Real size = GROUP_CELLS * cell_size_;
	std::unordered_map<std::uint64_t, std::uint32_t> known;
	struct Square {
		std::uint32_t colour;
		std::uint32_t count;
	};
	std::vector<Square> squares;
	group_of_pair_.clear();
	for (const BodyPair pair : found_) {
		std::uint64_t key = UINT64_MAX; // no square has this key: coordinates stop at 2^30
		std::uint32_t colour = COLOURS - 1;
		if (unsorted_[pair.a].level < GROUPED_LEVELS && unsorted_[pair.b].level < GROUPED_LEVELS) {
			const Vec2 centre = (boxes_[pair.a].min + boxes_[pair.a].max) * Real(0.5);
			const std::int32_t x = cell_coordinate(centre.x, size);
			const std::int32_t y = cell_coordinate(centre.y, size);
			key = (std::uint64_t(std::uint32_t(x)) << 32) | std::uint32_t(y);
			colour = std::uint32_t(x & 1) | (std::uint32_t(y & 1) << 1);
		}
		const auto [entry, is_new] = known.try_emplace(key, std::uint32_t(squares.size()));
		if (is_new) {
			squares.push_back({ colour, 0 });
		}
		++squares[entry->second].count;
		group_of_pair_.push_back(entry->second);
	}
	// Squares by colour, in the order in which pairs first fell into them; then each pair to its place.
	groups_.clear();
	std::vector<std::uint32_t> place(squares.size());
	std::uint32_t begin = 0;
	for (std::uint32_t colour = 0; colour < COLOURS; ++colour) {
		first_group_[colour] = groups_.size();
		for (std::size_t i = 0; i < squares.size(); ++i) {
			if (squares[i].colour == colour) {
				place[i] = begin;
				groups_.push_back({ begin, begin + squares[i].count });
				begin += squares[i].count;
			}
		}
	}
	first_group_[COLOURS] = groups_.size();
	pairs_.resize(found_.size());
	for (std::size_t i = 0; i < found_.size(); ++i) {
		pairs_[place[group_of_pair_[i]]++] = found_[i];
	}
}

std::span<const BroadPhase::Group> BroadPhase::groups(std::size_t colour) const {
	return { groups_.data() + first_group_[colour], first_group_[colour + 1] - first_group_[colour] };
}

} // namespace softbody
