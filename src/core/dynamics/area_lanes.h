// SPDX-License-Identifier: MIT
// A body's area as a compliant constraint, for any scalar type: included where it is instantiated.
#pragma once

#include "core/dynamics/pressure_lanes.h"
#include "core/model/body_lanes.h"

#include <span>

namespace softbody {

/// Below this share of its target the area term hardens no further [1]: at nothing it would grow without bound.
inline constexpr Real LEAST_HARDENED_AREA = Real(0.25);

/// Ends a substep of `h` [s] by the constraint C = s A0 (J - 1/J) / 2, J = A / (s A0), with compliance A0/K and damping β. For
/// small strains C is A - s A0; like a neo-Hookean solid it hardens as the area goes to nothing (XPBD, Macklin, Müller and
/// Chentanez 2016, eq. 18 and 26, from a zero multiplier):
///   λ = -(C + β dA/dt) K h²/A0 / (1 + (1 + β/h) K h²/A0 sum w |∂A/∂x|²).
/// Positions move by w λ ∂A/∂x, velocities by the same over h. The gradient along which they move is that of the points at the
/// start of the substep, x - v h: then angular momentum stays exactly, as it does for forces there (the gradient of the end
/// took a tenth of a body's spin in a second). It is stable for every K. O(hull points).
template <class T>
void hold_area(const BodyLanes<T> &body, Real h) {
	const SoftBodyShape &shape = body.model.shape;
	const BodySettings &settings = body.model.settings;
	const std::span<const BasicVec2<T>> hull = std::span<const BasicVec2<T>>(body.positions).first(shape.hull_count());
	const std::size_t count = hull.size();
	const auto way_across = [&](std::size_t i) { // of the gradient at the start, doubled and turned back by 90 degrees
		const std::size_t last = i == 0 ? count - 1 : i - 1;
		const std::size_t next = i + 1 == count ? 0 : i + 1;
		return (hull[last] - hull[next]) - (body.velocities[last] - body.velocities[next]) * T(h);
	};
	T mobility = T(0);
	T rate = T(0);
	for (std::size_t i = 0; i < count; ++i) {
		const BasicVec2<T> gradient = area_derivative<T>(hull, i);
		mobility += dot(gradient, perpendicular(way_across(i))) * T(Real(0.5) * body.inverse_masses[i]);
		rate += dot(gradient, body.velocities[i]);
	}
	const T target(settings.inflation * shape.rest_area());
	const T fill = hull_area<T>(hull) / target;
	const T least(LEAST_HARDENED_AREA);
	const T held = select(fill > least, fill, least);
	// C = target (J - 1/J) / 2, and its slope by the area; below the least share along the tangent.
	const T slope = (T(1) + T(1) / (held * held)) * T(Real(0.5));
	const T excess = ((held - T(1) / held) * T(Real(0.5)) + (fill - held) * slope) * target;
	const T elastic = slope * T(settings.area_stiffness / shape.rest_area() * h * h);
	const T viscous = slope * slope * T(settings.area_stiffness / shape.rest_area() * settings.elastic_damping_time * h);
	const T least_mobility = select(mobility > T(0), mobility, T(0));
	const T impulse = -(elastic * excess + viscous * rate * T(h)) / (T(1) + (elastic * slope + viscous) * least_mobility);
	// Where points were when the substep began does not change by a shift: one loop does.
	const T per_h(1 / h);
	for (std::size_t i = 0; i < count; ++i) {
		const BasicVec2<T> shift = perpendicular(way_across(i)) * (impulse * T(Real(0.5) * body.inverse_masses[i]));
		body.positions[i] += shift;
		body.velocities[i] += shift * per_h;
	}
}

} // namespace softbody
