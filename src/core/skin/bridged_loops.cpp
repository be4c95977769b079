// SPDX-License-Identifier: MIT
// A polygon with holes as one outline.
#include "core/skin/bridged_loops.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace softbody {

namespace {

using Loop = std::vector<std::uint32_t>;

class Bridging {
public:
	Bridging(std::span<const Vec2> points, std::span<const std::size_t> loops) : points_(points) {
		std::uint32_t start = 0;
		for (const std::size_t count : loops) {
			Loop loop(count);
			std::iota(loop.begin(), loop.end(), start);
			const bool is_negative = signed_area(points.subspan(start, count)) < 0;
			if (is_negative != (start > 0)) { // holes run the other way around
				std::ranges::reverse(loop);
			}
			loops_.push_back(std::move(loop));
			start += std::uint32_t(count);
		}
	}

	Loop make() {
		Loop outline = loops_[0];
		std::vector<std::size_t> left(loops_.size() - 1);
		std::iota(left.begin(), left.end(), std::size_t(1));
		// From the right: the rightmost point of the rightmost hole sees the outline, whatever other holes there are.
		std::ranges::sort(left, [&](std::size_t a, std::size_t b) {
			const Real x = points_[rightmost(loops_[a])].x;
			const Real other = points_[rightmost(loops_[b])].x;
			return x > other || (x == other && a < b);
		});
		for (std::size_t k = 0; k < left.size(); ++k) {
			join(outline, loops_[left[k]], std::span(left).subspan(k));
		}
		return outline;
	}

private:
	std::uint32_t rightmost(const Loop &loop) const {
		return *std::ranges::max_element(loop, {}, [&](std::uint32_t i) { return points_[i].x; });
	}

	// The nearest point of the outline that the hole's rightmost point sees past everything.
	void join(Loop &r_outline, const Loop &hole, std::span<const std::size_t> left) const {
		const std::uint32_t from = rightmost(hole);
		std::vector<std::size_t> order(r_outline.size());
		std::iota(order.begin(), order.end(), std::size_t(0));
		const auto distance = [&](std::size_t at) { return dot(difference(points_[r_outline[at]], points_[from]), difference(points_[r_outline[at]], points_[from])); };
		std::ranges::stable_sort(order, {}, distance);
		std::size_t best = order[0]; // if rounding hides all of them
		for (const std::size_t at : order) {
			const bool is_free = opens_to(r_outline, at, from) && is_clear(r_outline, r_outline[at], from) &&
					std::ranges::all_of(left, [&](std::size_t other) { return is_clear(loops_[other], r_outline[at], from); });
			if (is_free) {
				best = at;
				break;
			}
		}
		// ... outline[best], hole from its point on and around to it again, outline[best] ...
		Loop detour;
		const std::size_t start = std::size_t(std::ranges::find(hole, from) - hole.begin());
		for (std::size_t i = 0; i <= hole.size(); ++i) {
			detour.push_back(hole[(start + i) % hole.size()]);
		}
		detour.push_back(r_outline[best]);
		r_outline.insert(r_outline.begin() + std::ptrdiff_t(best) + 1, detour.begin(), detour.end());
	}

	double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const { return signed_double_area(points_[a], points_[b], points_[c]); }

	// Whether a point lies in the corner of the outline at this place: a point of the outline may occur several times, once for each line
	// that ends there.
	bool opens_to(const Loop &outline, std::size_t at, std::uint32_t point) const {
		const std::uint32_t before = outline[(at + outline.size() - 1) % outline.size()];
		const std::uint32_t corner = outline[at];
		const std::uint32_t after = outline[(at + 1) % outline.size()];
		const bool is_left_of_first = turn(before, corner, point) > 0;
		const bool is_left_of_second = turn(corner, after, point) > 0;
		return turn(before, corner, after) >= 0 ? is_left_of_first && is_left_of_second : is_left_of_first || is_left_of_second;
	}

	// Whether the line from a to b meets no edge of a loop but those that end in a or b, and no point besides.
	bool is_clear(const Loop &loop, std::uint32_t a, std::uint32_t b) const {
		for (std::size_t i = 0; i < loop.size(); ++i) {
			const std::uint32_t c = loop[i];
			const std::uint32_t d = loop[(i + 1) % loop.size()];
			if (c != a && c != b && turn(a, b, c) == 0 && dot(difference(points_[a], points_[c]), difference(points_[b], points_[c])) <= 0) {
				return false;
			}
			if (c == a || c == b || d == a || d == b) {
				continue;
			}
			if ((turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0)) {
				return false;
			}
		}
		return true;
	}

	std::span<const Vec2> points_;
	std::vector<Loop> loops_;
};

} // namespace

std::vector<std::uint32_t> bridge_loops(std::span<const Vec2> points, std::span<const std::size_t> loops) {
	assert(!loops.empty());
	return Bridging(points, loops).make();
}

} // namespace softbody
