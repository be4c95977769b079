// SPDX-License-Identifier: MIT
// The test body of the thesis: eight hull points and a center, in meters.
#pragma once

#include "core/model/soft_body_data.h"
#include "scenes/circle.h"
#include "thesis/damping_ratio.h"

#include <memory>

namespace softbody::testing {

inline constexpr Real THESIS_RADIUS = Real(0.5); ///< [m]
inline constexpr int THESIS_HULL_POINTS = 8;
inline constexpr Real THESIS_MASS = 1; ///< [kg], a ninth on every point

/// Eight hull springs and eight centre springs, all of stiffness k [N/m] and damping c [N·s/m].
inline std::shared_ptr<const SoftBodyShape> thesis_shape(Real stiffness = 100, Real damping = 0) {
	return circle_shape(THESIS_RADIUS, THESIS_HULL_POINTS, { THESIS_MASS, stiffness, damping, true }).value();
}

/// The same springs with a damping ratio, which is c / sqrt(k m) with m the mass of one point.
inline std::shared_ptr<const SoftBodyShape> thesis_shape_with_ratio(Real stiffness, Real ratio) {
	return thesis_shape(stiffness, damping_for_ratio(ratio, stiffness, THESIS_MASS, THESIS_HULL_POINTS + 1));
}

inline SoftBodyData thesis_body(std::shared_ptr<const SoftBodyShape> shape, const BodySettings &settings = {}, const Pose &pose = {}) {
	return SoftBodyData::create(std::move(shape), settings, pose).value();
}

} // namespace softbody::testing
