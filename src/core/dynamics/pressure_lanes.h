// SPDX-License-Identifier: MIT
// The forces of pressure, for any scalar type: included where they are instantiated.
#pragma once

#include "core/dynamics/pressure.h"

namespace softbody {

// From A = sum of x_i × x_{i+1} / 2: the vector from the next to the last neighbor, turned by +90 degrees, halved.
template <class T>
BasicVec2<T> area_derivative(std::span<const BasicVec2<T>> hull, std::size_t i) {
	const std::size_t count = hull.size();
	return perpendicular(hull[i == 0 ? count - 1 : i - 1] - hull[i + 1 == count ? 0 : i + 1]) * T(Real(0.5));
}

template <class T>
T hull_area(std::span<const BasicVec2<T>> hull) {
	T twice = T(0);
	for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
		twice += cross(hull[i] - hull[0], hull[i + 1] - hull[0]);
	}
	return twice * T(Real(0.5));
}

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
