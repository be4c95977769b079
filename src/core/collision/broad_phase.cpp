// SPDX-License-Identifier: MIT
// A hashed grid of several cell sizes.
#include "core/collision/broad_phase.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace softbody {

namespace {

// Margin of a kept box, as a share of its extent [1]. Larger: fewer searches, but more candidates that do not touch.
constexpr Real BOX_MARGIN = Real(0.08);

// Above this share of bodies that have left their boxes [1], the candidates of all bodies are searched again.
constexpr Real MOST_MOVED = Real(0.3);

constexpr std::size_t BODIES_A_TASK = 256;

// Bodies of a slab [1]. Larger: less to do side by side. Smaller: groups that are not worth a task.
constexpr std::uint32_t SLAB_BODIES = 128;

// Most that the circles of a pair may differ in size to count as a link [1]. A body that is about to be reset may reach
// over all others, and must not change the order of their pairs.
constexpr Real MOST_RATIO = 16;

Aabb box_of(const BroadPhaseBody &body) {
	return Aabb{ body.center, body.center }.grown(body.radius);
}

bool are_alike(const BroadPhaseBody &a, const BroadPhaseBody &b) {
	return a.radius <= MOST_RATIO * b.radius && b.radius <= MOST_RATIO * a.radius;
}

bool may_touch(const BroadPhaseBody &a, const BroadPhaseBody &b) {
	const Real reach = a.radius + b.radius;
	return length_squared(a.center - b.center) <= reach * reach;
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
		const Aabb box = box_of(bodies[i]);
		if (!same_bodies || !boxes_[i].contains(box)) {
			boxes_[i] = box.grown(BOX_MARGIN * box.extent());
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
		if (!(a.rests && b.rests) && may_touch(a, b)) {
			overlapping_.push_back(pair);
		}
	}
	if (!exceptions.empty()) {
		std::erase_if(overlapping_, [&](BodyPair pair) { return std::ranges::binary_search(exceptions, pair); });
	}
}

// Lists the links of each body: the other bodies of its pairs with bodies of like size.
void BroadPhase::link_bodies(std::span<const BroadPhaseBody> bodies) {
	starts_.assign(bodies.size() + 1, 0);
	for (const BodyPair pair : overlapping_) {
		if (are_alike(bodies[pair.a], bodies[pair.b])) {
			++starts_[pair.a];
			++starts_[pair.b];
		}
	}
	std::inclusive_scan(starts_.begin(), starts_.end(), starts_.begin());
	links_.resize(starts_.back());
	for (const BodyPair pair : overlapping_) {
		if (are_alike(bodies[pair.a], bodies[pair.b])) {
			links_[--starts_[pair.a]] = pair.b;
			links_[--starts_[pair.b]] = pair.a;
		}
	}
}

// Walks each island level by level, from its body of lowest index. A level is linked only to itself, the one before and
// the one after. Consecutive levels form a slab. Small islands share one. Returns the number of slabs.
std::uint32_t BroadPhase::find_slabs() {
	constexpr std::uint32_t NONE = UINT32_MAX;
	const std::uint32_t count = std::uint32_t(starts_.size() - 1);
	slab_of_.assign(count, NONE);
	std::uint32_t slab = 0;
	std::uint32_t in_slab = 0; // bodies
	for (std::uint32_t first = 0; first < count; ++first) {
		if (slab_of_[first] != NONE || starts_[first] == starts_[first + 1]) {
			continue;
		}
		level_.assign(1, first);
		std::uint32_t levels = 0; // of this island, in the slab
		for (slab_of_[first] = slab; !level_.empty(); level_.swap(next_level_)) {
			++levels;
			in_slab += std::uint32_t(level_.size());
			// With two levels a slab's pairs with the slab before and with the slab after share no body.
			if (in_slab >= SLAB_BODIES && levels >= 2) {
				++slab;
				in_slab = 0;
				levels = 0;
			}
			next_level_.clear();
			for (const std::uint32_t body : level_) {
				for (std::uint32_t k = starts_[body]; k < starts_[body + 1]; ++k) {
					if (slab_of_[links_[k]] == NONE) {
						slab_of_[links_[k]] = slab;
						next_level_.push_back(links_[k]);
					}
				}
			}
		}
	}
	return slab + 1;
}

// Three phases: pairs within a slab, pairs of a slab with the next, and pairs of bodies of unlike size.
void BroadPhase::group_pairs(std::span<const BroadPhaseBody> bodies) {
	link_bodies(bodies);
	const std::uint32_t slabs = find_slabs();
	group_of_pair_.resize(overlapping_.size());
	group_ends_.assign(2 * slabs + 1, 0);
	for (std::size_t i = 0; i < overlapping_.size(); ++i) {
		const auto [a, b] = overlapping_[i];
		std::uint32_t group = 2 * slabs;
		if (are_alike(bodies[a], bodies[b])) {
			group = slab_of_[a] == slab_of_[b] ? slab_of_[a] : slabs + std::min(slab_of_[a], slab_of_[b]);
		}
		group_of_pair_[i] = group;
		++group_ends_[group];
	}
	groups_.clear();
	first_groups_.assign(1, 0);
	std::uint32_t begin = 0;
	for (std::uint32_t group = 0; group <= 2 * slabs; ++group) {
		const std::uint32_t end = begin + group_ends_[group];
		if (begin < end) {
			groups_.push_back({ begin, end });
		}
		group_ends_[group] = begin;
		begin = end;
		if (group + 1 == slabs || group + 1 == 2 * slabs || group == 2 * slabs) {
			first_groups_.push_back(groups_.size());
		}
	}
	pairs_.resize(overlapping_.size());
	for (std::size_t i = 0; i < overlapping_.size(); ++i) {
		pairs_[group_ends_[group_of_pair_[i]]++] = overlapping_[i];
	}
}

std::span<const BroadPhase::Group> BroadPhase::groups(std::size_t phase) const {
	return { groups_.data() + first_groups_[phase], first_groups_[phase + 1] - first_groups_[phase] };
}

} // namespace softbody
