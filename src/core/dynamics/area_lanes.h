// SPDX-License-Identifier: MIT
// A body's area as a compliant constraint, for any scalar type: included where it is instantiated.
#pragma once

#include "core/dynamics/pressure_lanes.h"
#include "core/model/body_lanes.h"

#include <algorithm>
#include <span>

namespace softbody {

/// Share of its target below which an area is pushed no harder [1]. Without it the push would grow without bound, and a
/// body turned inside out would return with so much energy that it shot away.
inline constexpr Real LEAST_HARDENED_AREA = Real(0.25);

/// Least share of the rest area as a target of the area term [1]; a smaller inflation counts as this.
inline constexpr Real LEAST_AIMED_AREA = Real(0.05);

/// Ends a substep of `h` [s] by the force of the area's energy K A0 C² / (2 target²), with the strain C = target (J - 1/J) / 2,
/// target = s A0 and J = A / target. For small strains C is A - s A0; like a neo-Hookean solid it hardens as the area goes
/// to 0. With the push q = h² K/A0 C'² sum w |∂A/∂x|² that this force makes in the substep, as a share of C,
///   λ = -C/C' min(q, 1) / (sum w |∂A/∂x|²):
/// up to q = 1 this is the force itself, so what rests on the body finds the stiffness of its material; beyond, it is the
/// correction that ends at C = 0 (position-based dynamics, Müller et al. 2007), as no greater one is stable. Damping β acts on
/// the rate of the area, implicitly, with the share of the substep that 1 - min(q, 1) leaves.
/// Positions move by w λ ∂A/∂x, velocities by that over h. The gradient of the motion is that of the points at the
/// start of the substep, x - v h, which keeps angular momentum, as forces there do. Where the hull has changed wildly
/// within the substep, it is the gradient of the end. Stable for every K. O(hull points).
template <class T>
void hold_area(const BodyLanes<T> &body, Real h) {
	const SoftBodyShape &shape = body.model.shape;
	const BodySettings &settings = body.model.settings;
	const std::span<const BasicVec2<T>> hull = std::span<const BasicVec2<T>>(body.positions).first(shape.hull_count());
	const std::size_t count = hull.size();
	const auto next_of = [&](std::size_t i) { return i + 1 == count ? 0 : i + 1; };
	const auto last_of = [&](std::size_t i) { return i == 0 ? count - 1 : i - 1; };
	T inverse_mass = T(0);
	T start_inverse_mass = T(0); // of this gradient with the one at the start
	T start_size = T(0);
	T rate = T(0);
	for (std::size_t i = 0; i < count; ++i) {
		const BasicVec2<T> gradient = area_derivative<T>(hull, i);
		const BasicVec2<T> turned = body.velocities[last_of(i)] - body.velocities[next_of(i)];
		const BasicVec2<T> start = gradient - perpendicular(turned) * T(Real(0.5) * h);
		const T weight(body.inverse_masses[i]);
		inverse_mass += length_squared(gradient) * weight;
		start_inverse_mass += dot(gradient, start) * weight;
		start_size += length_squared(start) * weight;
		rate += dot(gradient, body.velocities[i]);
	}
	// Where the hull has changed so much in the substep that the two gradients differ, the present one is safe.
	const auto is_calm = both(start_inverse_mass > inverse_mass * T(Real(0.5)), start_size < inverse_mass * T(2));
	inverse_mass = select(is_calm, start_inverse_mass, inverse_mass);
	const T back = select(is_calm, T(h), T(0));
	const T target(std::max(settings.inflation, LEAST_AIMED_AREA) * shape.rest_area());
	const T fill = hull_area<T>(hull) / target;
	const T least(LEAST_HARDENED_AREA);
	const T held = select(fill > least, fill, least);
	// C = target (J - 1/J) / 2, and its slope by the area; both held at the least share below it.
	const T slope = (T(1) + T(1) / (held * held)) * T(Real(0.5));
	const T excess = (held - T(1) / held) * T(Real(0.5)) * target;
	const ForceCoefficients<T> &coefficients = body.model.coefficients;
	const T stiffness = coefficients.area_stiffness / T(shape.rest_area()) * T(h) * T(h);
	const T push = slope * slope * stiffness * inverse_mass;
	const T whole = T(1) / (slope * inverse_mass);
	const T impulse_at_rest = select(push < T(1), slope * stiffness, whole) * excess;
	const T viscous = slope * slope * (coefficients.area_stiffness / T(shape.rest_area()) * coefficients.elastic_damping_time * T(h));
	const T left = select(push < T(1), T(1) - push, T(0));
	const T impulse = -impulse_at_rest - viscous * rate * left * T(h) / (T(1) + viscous * inverse_mass);
	// Edges between neighbors are those before any point is moved.
	const auto place = [&](std::size_t i) { return body.positions[i] - body.velocities[i] * back; };
	const T per_h(1 / h);
	const BasicVec2<T> first = place(0);
	BasicVec2<T> last = place(count - 1);
	for (std::size_t i = 0; i < count; ++i) {
		const BasicVec2<T> here = place(i);
		const BasicVec2<T> next = i + 1 == count ? first : place(i + 1);
		const BasicVec2<T> shift = perpendicular(last - next) * (impulse * T(Real(0.5) * body.inverse_masses[i]));
		body.positions[i] += shift;
		body.velocities[i] += shift * per_h;
		last = here;
	}
}

} // namespace softbody
