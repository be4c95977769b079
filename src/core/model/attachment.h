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

/// A place that follows the deformed body: an eye, a hat, a camera. The rigid motion that fits the points best carries
/// it, with weights 1/d⁴ of the distance d at rest (rigid moving least squares: Schaefer, McPhail, Warren 2006, section
/// 2.3; their 1/d² would give far points an equal part in the rotation). Made at a point, it follows the point. Works
/// inside and outside the hull.
class Attachment {
public:
	/// At `place`, in the frame of `rest_positions` [length]. Refuses an empty list and non-finite values. O(points).
	static Result<Attachment> create(std::span<const Vec2> rest_positions, Vec2 place);

	/// The present place, and the rotation of the flesh around it since creation. Where the rotation is undefined, as
	/// all points that count coincide, it is `otherwise`. Precondition: as many positions as at creation. O(points).
	Pose follow(std::span<const Vec2> positions, Rotation otherwise = {}) const;

	std::size_t point_count() const { return weights_.size(); }

private:
	Attachment() = default;

	std::vector<Real> weights_; ///< sum 1
	std::vector<Vec2> arms_; ///< at rest, from the weighted center to the points, times their weight [length]
	Vec2 arm_; ///< from the weighted center to the place
};

} // namespace softbody
