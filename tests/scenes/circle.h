// SPDX-License-Identifier: MIT
// Round bodies: the thesis's test body and its relatives.
#pragma once

#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"

#include <memory>

namespace softbody::testing {

/// `point_count` hull points on a circle, and a center point unless `options` leave it out.
inline Result<std::shared_ptr<const SoftBodyShape>> circle_shape(Real radius, int point_count, const StructureOptions &options) {
	const Result<std::vector<Vec2>> hull = circle_hull(radius, point_count);
	return hull ? SoftBodyCreator::create_polygon(hull.value(), options) : hull.error();
}

} // namespace softbody::testing
