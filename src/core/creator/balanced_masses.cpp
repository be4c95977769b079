// SPDX-License-Identifier: MIT
// Puts the center of several masses where it belongs.
#include "core/creator/balanced_masses.h"

#include <cassert>
#include <cstddef>

namespace softbody {

namespace {

constexpr double LEAST_FACTOR = 0.25;

} // namespace

// With d from the wanted center to a point, the factors that minimize the sum of m (factor - 1)² under both conditions are
// 1 + e + a.d. The sum of the masses stays where e M + a.s = 0, s being the sum of m d. The center is right where (1 + e) s + S a = 0, S
// being the sum of m d d^T. Together (S - s s^T / M) a = -s: a covariance, which is positive definite for points off any line.
bool balance_masses(std::span<const Vec2> points, Vec2d center, std::span<double> masses) {
	assert(points.size() == masses.size());
	double mass = 0;
	Vec2d moment;
	double xx = 0, xy = 0, yy = 0;
	for (std::size_t i = 0; i < points.size(); ++i) {
		const Vec2d arm = Vec2d(points[i]) - center;
		mass += masses[i];
		moment += arm * masses[i];
		xx += masses[i] * arm.x * arm.x;
		xy += masses[i] * arm.x * arm.y;
		yy += masses[i] * arm.y * arm.y;
	}
	xx -= moment.x * moment.x / mass;
	xy -= moment.x * moment.y / mass;
	yy -= moment.y * moment.y / mass;
	const double determinant = xx * yy - xy * xy;
	if (!(determinant > 1e-12 * xx * yy)) {
		return false;
	}
	const Vec2d slope{ (xy * moment.y - yy * moment.x) / determinant, (xy * moment.x - xx * moment.y) / determinant };
	const double start = 1 - dot(slope, moment) / mass;
	const auto factor_of = [&](std::size_t i) { return start + dot(slope, Vec2d(points[i]) - center); };
	for (std::size_t i = 0; i < points.size(); ++i) {
		if (factor_of(i) < LEAST_FACTOR) {
			return false;
		}
	}
	for (std::size_t i = 0; i < points.size(); ++i) {
		masses[i] *= factor_of(i);
	}
	return true;
}

} // namespace softbody
