// SPDX-License-Identifier: MIT
// Pressure: a body that holds its area (thesis 2.1.3 and 2.1.4), for any scalar type.
#pragma once

#include "core/base/vec2.h"
#include "core/model/body_settings.h"
#include "core/model/soft_body_shape.h"

#include <span>

namespace softbody {

/// Derivative of the hull's area A = sum of x_i × x_{i+1} / 2 with respect to point i [length]: half the vector from the next
/// to the last neighbor, turned outward.
template <class T>
BasicVec2<T> area_derivative(std::span<const BasicVec2<T>> hull, std::size_t i) {
	const std::size_t count = hull.size();
	return perpendicular(hull[i == 0 ? count - 1 : i - 1] - hull[i + 1 == count ? 0 : i + 1]) * T(Real(0.5));
}

/// Signed area of the hull [length²]. O(hull points).
template <class T>
T hull_area(std::span<const BasicVec2<T>> hull) {
	T twice = T(0);
	for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
		twice += cross(hull[i] - hull[0], hull[i + 1] - hull[0]);
	}
	return twice * T(Real(0.5));
}

/// Adds the pressure's force p ∂A/∂x_i on every hull point, with p = k_p (s - A/A0) [force/length], positive when it pushes
/// outward. Linear in the area rather than 1/A (Matyka 2004): a gas law explodes as the hull is crushed and changes sign when
/// the hull is inverted; this one always pushes towards the target area. Its work is p dA. The forces sum to zero force and
/// zero torque, because rigid motion does not change the area.
template <class T>
void add_pressure_forces(const SoftBodyShape &shape, const BodySettings &settings,
		std::span<const BasicVec2<T>> positions, std::span<BasicVec2<T>> forces) {
	const std::span<const BasicVec2<T>> hull = positions.first(shape.hull_count());
	const T fill = hull_area<T>(hull) / T(shape.rest_area());
	const T pressure = T(settings.pressure_stiffness) * (T(settings.inflation) - fill);
	for (std::size_t i = 0; i < hull.size(); ++i) {
		forces[i] += area_derivative<T>(hull, i) * pressure;
	}
}

} // namespace softbody
