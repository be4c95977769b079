// SPDX-License-Identifier: MIT
// Carries the outlines of a body's holes along with its hull.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/holed_polygon.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace softbody {

/// Share of its size down to which a hole closes as its hull says; from there on it closes ever less, and never turns inside out.
inline constexpr Real FREELY_CLOSED_HOLE = Real(0.5);

/// Places of the points of holes, which are not simulated, for the present places of the hull's points. The hull's displacement from rest is taken
/// in a frame that turns with the hull around the hole, and `hole_weights` make the holes' displacement of it. At rest the holes are the given
/// ones, to the bit of the weights, and rigid motion of the hull is followed up to rounding.
class HoleBinding {
public:
	HoleBinding() = default;
	/// All at rest [length]. `weights` are those of `hole_weights` for them.
	HoleBinding(const Holes &holes, std::span<const Vec2> hull, std::vector<std::array<Real, 4>> weights);

	std::size_t hull_count() const { return hull_.size(); }
	/// Number of points of each hole.
	std::span<const std::size_t> counts() const { return counts_; }
	std::size_t point_count() const { return rest_.size(); } ///< of all holes
	/// Writes the places of the points, hole after hole, for a hull that is now at `hull`. O(points of the holes · hull), no allocation.
	void place(std::span<const Vec2> hull, std::span<Vec2> points) const;

private:
	/// A place at rest, where it is now, and the turn since, as cosine and sine.
	struct Frame {
		Vec2 rest;
		Vec2 now;
		Vec2 turn{ 1, 0 };
	};
	Frame frame_of(std::size_t hole, std::span<const Vec2> hull) const;

	std::vector<Vec2> hull_; ///< from their mean
	std::vector<Vec2> rest_; ///< of the holes, from the mean of the hull's points
	std::vector<std::size_t> counts_;
	std::vector<std::array<Real, 4>> weights_; ///< hull_count for each point of the holes
	std::vector<Real> shares_; ///< hull_count for each hole, summing to 1: how much its frame goes with each point
};

} // namespace softbody
