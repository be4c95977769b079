// SPDX-License-Identifier: MIT
// A body's elastic triangles, for any scalar type: included where they are instantiated.
#pragma once

#include "core/base/constants.h"
#include "core/model/body_frame.h"
#include "core/model/body_lanes.h"

#include <span>

namespace softbody {

// The stable neo-Hookean solid in the plane (Smith, de Goes and Kim 2018, eq. 14 without its constant) has the energy
//   μ/2 (|F|² - 2) - μ (J - 1) + K/2 (J - 1)², J = det F, K = λ + μ,
// per rest area. In the singular values of F, s2 < 0 for an inverted triangle, it is μ/2 (s1 - s2)² + K/2 (J - 1)². F = I is
// free of force, and μ and λ are the Lamé parameters there.
//
// The code uses this energy for |F|²/2 < PLAIN_SIZE and K |J - 1| < MOST_PRESSURE μ. Beyond, it is softer against a
// change of area:
//   W(F) = μ/2 (s1 - s2)² + K h(C), C = (J - 1)/n, n² = max(1, |F|²/2 / PLAIN_SIZE),
// where h is C²/2 for |C| up to MOST_PRESSURE μ/K and linear beyond (Huber 1964). W is 0 for the same F. There are two
// reasons. The stiffness of (J - 1)² grows with the square of a stretch, so that a step that is stable at rest is not
// for a stretched body; that of h(C) along any plane wave stays below 2.42 times its value at rest. And unbounded
// pressures hold inverted triangles against each other forever, where shear alone unfolds them.
//
// Shear is quadratic in the positions: with u = F_xx - F_yy and v = F_xy + F_yx it is μ/2 (u² + v²). Its forces are
// linear and never vanish in a sheared triangle, inverted or not. |F|²/2 = J + (u² + v²)/2.

/// |F|²/2 above which a triangle's change of area is measured relative to its size [1]; 1 at rest. Larger: stretched
/// bodies are stiffer than the planned substeps bear. Smaller: moderate stretches deviate from the solid's.
inline constexpr Real PLAIN_SIZE = Real(1.1);

/// Largest pressure of a triangle over the shear modulus [1]. Larger: inverted triangles push so hard that they hold
/// one another there. Smaller: bodies pressed flat lose area. A disk pressed to 0.3 of its height has about 3.
inline constexpr Real MOST_PRESSURE = 4;

/// Shear of a triangle: zero for every turned and scaled copy of it.
template <class T>
struct TriangleShear {
	T u = T(0); ///< F_xx - F_yy [1]
	T v = T(0); ///< F_xy + F_yx [1]
};

/// Shear of the triangle with edges e1 and e2 from its first corner.
template <class T>
TriangleShear<T> triangle_shear(const ElasticTriangle &triangle, BasicVec2<T> e1, BasicVec2<T> e2) {
	const auto [g1, g2] = triangle.gradients;
	return { e1.x * T(g1.x) - e1.y * T(g1.y) + e2.x * T(g2.x) - e2.y * T(g2.y),
		e1.x * T(g1.y) + e1.y * T(g1.x) + e2.x * T(g2.y) + e2.y * T(g2.x) };
}

/// The derivative of u² / 2 + v² / 2 by a corner whose linear function has the gradient g.
template <class T>
BasicVec2<T> shear_derivative(const TriangleShear<T> &shear, Vec2 g) {
	return { shear.u * T(g.x) + shear.v * T(g.y), shear.v * T(g.x) - shear.u * T(g.y) };
}

/// The change of area of a triangle, with C and h as at the top of this file.
template <class T>
struct TriangleDilation {
	T strain = T(0); ///< C [1]
	T slope = T(0); ///< h'(C) [1]
	T pressure = T(0); ///< derivative of K h(C) by J [force/length]
	T softening = T(0); ///< minus the derivative of K h(C) by (u² + v²)/2 [force/length]
};

/// `ratio` is J, which is compared with `inflation` instead of 1.
template <class T>
TriangleDilation<T> triangle_dilation(Real inflation, const ForceCoefficients<T> &coefficients, T ratio, const TriangleShear<T> &shear) {
	const T size = (ratio + (shear.u * shear.u + shear.v * shear.v) * T(Real(0.5))) * T(1 / PLAIN_SIZE);
	const auto is_large = size > T(1);
	const T per_n = select(is_large, T(1) / sqrt(size), T(1));
	TriangleDilation<T> dilation;
	dilation.strain = (ratio - T(inflation)) * per_n;
	const T most = T(MOST_PRESSURE) * coefficients.shear_modulus / coefficients.area_stiffness;
	dilation.slope = greater(lesser(dilation.strain, most), -most);
	const T softening = dilation.slope * dilation.strain * per_n * per_n * (coefficients.area_stiffness / T(2 * PLAIN_SIZE));
	dilation.softening = select(is_large, softening, T(0));
	dilation.pressure = dilation.slope * per_n * coefficients.area_stiffness - dilation.softening;
	return dilation;
}

/// K h(C), per rest area [force/length].
template <class T>
T dilation_energy(Real bulk_modulus, const TriangleDilation<T> &dilation) {
	return dilation.slope * (dilation.strain - dilation.slope * T(Real(0.5))) * T(bulk_modulus);
}

/// Net force [force] and torque about a place [force·length] of forces on points.
template <class T>
struct NetForce {
	BasicVec2<T> push;
	T torque = T(0);
};

template <class T>
NetForce<T> net_force(std::span<const BasicVec2<T>> positions, BasicVec2<T> center, std::span<const BasicVec2<T>> forces) {
	NetForce<T> net;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		net.push += forces[i];
		net.torque += cross(positions[i] - center, forces[i]);
	}
	return net;
}

/// Adds the forces of the triangles, the negative derivatives of their energies. J is compared with the settings'
/// inflation instead of 1. Damping counts β times the rate of shear as shear (Kelvin and Voigt), of the motion relative
/// to the rigid one; a rigid acceleration cancels its net force and torque. Changes of area are not damped, as that
/// would take most of the substeps. Precondition: the shape has triangles. O(points + triangles).
template <class T>
void add_triangle_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces) {
	const SoftBodyShape &shape = body.shape;
	const ForceCoefficients<T> &coefficients = body.coefficients;
	const T damping = coefficients.shear_modulus * coefficients.elastic_damping_time;
	const BasicBodyFrame<T> frame = measure_frame<T>(shape, body.rotation_memory, positions, velocities);
	const NetForce<T> before = net_force<T>(positions, frame.center, forces);
	for (const ElasticTriangle &triangle : shape.triangles()->triangles) {
		const auto [a, b, c] = triangle.corners;
		const BasicVec2<T> e1 = positions[b] - positions[a];
		const BasicVec2<T> e2 = positions[c] - positions[a];
		const BasicVec2<T> drift1 = velocities[b] - velocities[a] - perpendicular(e1) * frame.angular_velocity;
		const BasicVec2<T> drift2 = velocities[c] - velocities[a] - perpendicular(e2) * frame.angular_velocity;
		const TriangleShear<T> shear = triangle_shear<T>(triangle, e1, e2);
		const TriangleShear<T> rate = triangle_shear<T>(triangle, drift1, drift2);
		const T ratio = cross(e1, e2) * T(Real(0.5) / triangle.area);
		const TriangleDilation<T> dilation = triangle_dilation<T>(body.settings.inflation, coefficients, ratio, shear);
		const T elastic = (coefficients.shear_modulus - dilation.softening) * T(triangle.area);
		const T viscous = damping * T(triangle.area);
		const TriangleShear<T> stress = { shear.u * elastic + rate.u * viscous, shear.v * elastic + rate.v * viscous };
		// The derivative of the area by a corner is half of the opposite edge, turned.
		const T half_pressure = dilation.pressure * T(Real(0.5));
		const BasicVec2<T> on_b = shear_derivative<T>(stress, triangle.gradients[0]) - perpendicular(e2) * half_pressure;
		const BasicVec2<T> on_c = shear_derivative<T>(stress, triangle.gradients[1]) + perpendicular(e1) * half_pressure;
		forces[a] += on_b + on_c;
		forces[b] -= on_b;
		forces[c] -= on_c;
	}
	// Net force and torque of the elastic part are rounding, which would turn with the body and drive it.
	const NetForce<T> after = net_force<T>(positions, frame.center, forces);
	const BasicVec2<T> push = (after.push - before.push) * T(1 / shape.total_mass());
	const T least(DEGENERATE_LENGTH * shape.rest_inertia());
	const T spin = select(frame.inertia > least, (after.torque - before.torque) / frame.inertia, T(0));
	for (std::size_t i = 0; i < positions.size(); ++i) {
		forces[i] -= (push + perpendicular(positions[i] - frame.center) * spin) * T(shape.masses()[i]);
	}
}

} // namespace softbody
