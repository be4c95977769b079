// SPDX-License-Identifier: MIT
// Pressure: a body that holds its area (thesis 2.1.3 and 2.1.4).
#pragma once

#include "core/base/vec2.h"
#include "core/model/body_settings.h"
#include "core/model/soft_body_data.h"
#include "core/model/soft_body_shape.h"

#include <span>

namespace softbody {

/// Signed area of the hull [length²], and its derivative with respect to each hull point [length]: half the vector
/// between the point's neighbors, turned outward. `gradient` has at least as many entries as `hull`. O(hull points).
Real area_and_gradient(std::span<const Vec2> hull, std::span<Vec2> gradient);

/// Adds the pressure's force p ∂A/∂x_i on every hull point, with p = k_p (s - A/A0) [force/length], positive when it pushes
/// outward. Linear in the area rather than 1/A (Matyka 2004): a gas law explodes as the hull is crushed and changes sign when
/// the hull is inverted; this one always pushes towards the target area. Its work is p dA. The forces sum to zero force and
/// zero torque, because rigid motion does not change the area.
template <class T>
void add_pressure_forces(const SoftBodyShape &shape, const BodySettings &settings,
		std::span<const BasicVec2<T>> positions, std::span<BasicVec2<T>> forces);

} // namespace softbody
