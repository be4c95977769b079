// SPDX-License-Identifier: MIT
// Carries a place in or near a body along with its points.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/pose.h"

#include <cstddef>
#include <span>
#include <vector>

namespace softbody {

/// A place that goes with the deformed body: an eye, a hat, a camera. It is carried by the rigid motion that fits the
/// points best, those near the place counting most (rigid moving least squares: Schaefer, McPhail, Warren 2006, section
/// 2.3), with weights 1/d⁴ of the distance d at rest: with their 1/d² every point has the same part in the rotation,
/// however far. So it turns with the flesh around it, sits still in a body that
/// moves as a whole, and one that is made at a point goes where that point goes. Works inside and outside the hull.
class Attachment {
public:
	/// At `place`, in the coordinates of `rest_positions` [length]. Refuses no points and what is not finite. O(points).
	static Result<Attachment> create(std::span<const Vec2> rest_positions, Vec2 place);

	/// Where it is now, and how far what is around it has turned since it was made. Where that is undefined, as all points
	/// that count lie in one place, the rotation is `otherwise`. Precondition: as many positions as it was made with.
	/// O(points).
	Pose follow(std::span<const Vec2> positions, Rotation otherwise = {}) const;

	std::size_t point_count() const { return weights_.size(); }

private:
	Attachment() = default;

	std::vector<Real> weights_; ///< sum 1
	std::vector<Vec2> arms_; ///< at rest, from the weighted center to the points, times their weight [length]
	Vec2 arm_; ///< from there to the place
};

} // namespace softbody
