// SPDX-License-Identifier: MIT
// Carries a drawn outline of many points along with a simulated hull of few.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <span>
#include <vector>

namespace softbody {

/// Weights of the hull's points for each point of an outline that the hull stands for. A drawn point is their weighted
/// sum. At rest the outline is the drawn one, up to rounding. Any affine map of the hull is followed exactly, as the weights sum
/// to 1 and reproduce the place at rest. Along the outline the motion is continuously differentiable in the length of the hull
/// at rest: a bend of the hull shows no corners that were not drawn.
class OutlineBinding {
public:
	OutlineBinding() = default;
	/// `outline` is the drawn polygon, `hull` and `places` are those of `SimplifiedOutline` at rest [length].
	/// O(outline · hull).
	OutlineBinding(std::span<const Vec2> outline, std::span<const Vec2> hull, std::span<const double> places);

	/// Whether the constructor would make the same weights of these.
	bool is_made_of(std::span<const Vec2> outline, std::span<const Vec2> hull, std::span<const double> places) const;

	std::size_t outline_count() const { return outline_.size(); }
	std::size_t hull_count() const { return hull_.size(); }
	/// Weights of the hull's points [1] for the point of the outline of that index.
	std::span<const Real> weights_of(std::size_t index) const { return std::span(weights_).subspan(index * hull_.size(), hull_.size()); }
	/// Writes the places of the outline for a hull that is now at `hull`, in the order of the constructor.
	/// O(outline · hull), no allocation.
	void place(std::span<const Vec2> hull, std::span<Vec2> outline) const;
	/// Writes the places of the hull whose outline is nearest to this one in the mean square: the reverse of `place`, as far
	/// as the hull can show the outline. Values of the same kind, such as velocities, are carried alike.
	/// O(outline · hull² + hull³); allocates.
	void fit(std::span<const Vec2> outline, std::span<Vec2> hull) const;

private:
	std::vector<Vec2> outline_;
	std::vector<Vec2> hull_;
	std::vector<double> places_;
	std::vector<Real> weights_; ///< hull_count for each point of the outline
};

} // namespace softbody
