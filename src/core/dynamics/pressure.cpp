// SPDX-License-Identifier: MIT
// Pressure: a body that holds its area.
#include "core/dynamics/pressure.h"

namespace softbody {

namespace {

// From A = sum of x_i × x_{i+1} / 2: the way from the next to the last neighbour, turned by +90 degrees, halved.
Vec2 area_derivative(std::span<const Vec2> hull, std::size_t i) {
	const std::size_t count = hull.size();
	return perpendicular(hull[i == 0 ? count - 1 : i - 1] - hull[i + 1 == count ? 0 : i + 1]) * Real(0.5);
}

Real hull_area(std::span<const Vec2> hull) {
	Real twice = 0;
	for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
		twice += cross(hull[i] - hull[0], hull[i + 1] - hull[0]);
	}
	return twice / 2;
}

} // namespace

Real area_and_gradient(std::span<const Vec2> hull, std::span<Vec2> gradient) {
	for (std::size_t i = 0; i < hull.size(); ++i) {
		gradient[i] = area_derivative(hull, i);
	}
	return hull_area(hull);
}

Real pressure_at(const SoftBodyData &body, Real area) {
	return body.settings().pressure_stiffness * (body.settings().inflation - area / body.shape().rest_area());
}

void add_pressure_forces(const SoftBodyData &body, std::span<const Vec2> positions, std::span<Vec2> forces) {
	const std::span<const Vec2> hull = positions.first(body.shape().hull_count());
	const Real pressure = pressure_at(body, hull_area(hull));
	for (std::size_t i = 0; i < hull.size(); ++i) {
		forces[i] += area_derivative(hull, i) * pressure;
	}
}

} // namespace softbody
