// SPDX-License-Identifier: MIT
// Carries points in and around an outline along with it.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <span>
#include <vector>

namespace softbody {

/// Mean value coordinates (Hormann and Floater 2006, eq. 11 and figure 10): weights of the points of a closed outline for places inside and
/// outside of it, which sum to 1. A carried place is the weighted sum of the outline's points. At rest it is the given place, up to
/// rounding, and any affine map of the outline is followed up to rounding. A place on a point of the outline follows that point to the bit; one on
/// an edge divides the edge as it did at rest. Weights are smooth elsewhere; the outline may be concave.
class CageBinding {
public:
	CageBinding() = default;
	/// Both at rest [length]: a simple polygon of three points or more in either winding, and finite places. O(points · outline).
	CageBinding(std::span<const Vec2> outline, std::span<const Vec2> points);

	std::size_t outline_count() const { return outline_count_; }
	std::size_t point_count() const { return outline_count_ > 0 ? weights_.size() / outline_count_ : 0; }
	/// Weights of the outline's points [1] for the place of that index.
	std::span<const Real> weights_of(std::size_t index) const { return std::span(weights_).subspan(index * outline_count_, outline_count_); }
	/// Writes the places for an outline that is now at `outline`. O(points · outline), no allocation.
	void place(std::span<const Vec2> outline, std::span<Vec2> points) const;

private:
	std::size_t outline_count_ = 0;
	std::vector<Real> weights_; ///< outline_count for each place
};

} // namespace softbody
