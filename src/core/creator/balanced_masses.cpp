// SPDX-License-Identifier: MIT
// Puts the center of several masses where it belongs.
#include "core/creator/balanced_masses.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace softbody {

namespace {

constexpr double LEAST_FACTOR = 0.25;

// Solves a symmetric positive definite system by elimination; false where it is singular.
template <std::size_t N>
bool solve(std::array<std::array<double, N>, N> matrix, std::array<double, N> right, std::array<double, N> &r_result) {
	for (std::size_t k = 0; k < N; ++k) {
		if (!(matrix[k][k] > 1e-9)) { // the functions are scaled to about 1
			return false;
		}
		for (std::size_t row = k + 1; row < N; ++row) {
			const double factor = matrix[row][k] / matrix[k][k];
			for (std::size_t column = k; column < N; ++column) {
				matrix[row][column] -= factor * matrix[k][column];
			}
			right[row] -= factor * right[k];
		}
	}
	for (std::size_t k = N; k-- > 0;) {
		double sum = right[k];
		for (std::size_t column = k + 1; column < N; ++column) {
			sum -= matrix[k][column] * r_result[column];
		}
		r_result[k] = sum / matrix[k][k];
	}
	return true;
}

// Least share of the mass that the hull, or the inner points, may be left with [1].
constexpr double LEAST_SHARE = 0.05;

// Scales the masses of the hull and those of the inner points, so that their sum stays and the radius of gyration is `size`, as far as that
// goes. Returns the sum.
double share_by_inertia(std::span<const Vec2> points, std::size_t hull_count, Vec2d center, double size, std::span<double> masses) {
	std::array<double, 2> sums{}; // hull, inner points
	std::array<double, 2> squares{};
	for (std::size_t i = 0; i < points.size(); ++i) {
		const Vec2d arm = Vec2d(points[i]) - center;
		sums[i < hull_count ? 0 : 1] += masses[i];
		squares[i < hull_count ? 0 : 1] += masses[i] * dot(arm, arm);
	}
	const double mass = sums[0] + sums[1];
	if (!(sums[0] > 0 && sums[1] > 0) || squares[0] / sums[0] == squares[1] / sums[1]) {
		return mass;
	}
	const double of_inner = squares[1] / sums[1];
	const double share = std::clamp((size * size - of_inner) / (squares[0] / sums[0] - of_inner), LEAST_SHARE, 1 - LEAST_SHARE);
	for (std::size_t i = 0; i < points.size(); ++i) {
		masses[i] *= i < hull_count ? share * mass / sums[0] : (1 - share) * mass / sums[1];
	}
	return mass;
}

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

// As above with one more condition: factors are sums of the functions 1, x, y and r², whose moments with the new masses are known. The
// factors' squares are least where the functions are those of the conditions.
bool give_moments(std::span<const Vec2> points, std::size_t hull_count, const AreaMoments &moments, std::span<double> masses) {
	assert(points.size() == masses.size());
	const double size = std::sqrt(moments.inertia / moments.area); // radius of gyration
	const std::vector<double> given(masses.begin(), masses.end());
	const double mass = share_by_inertia(points, hull_count, moments.centroid, size, masses);
	std::vector<std::array<double, 4>> functions;
	std::array<std::array<double, 4>, 4> matrix{};
	for (std::size_t i = 0; i < points.size(); ++i) {
		const Vec2d arm = (Vec2d(points[i]) - moments.centroid) * (1 / size);
		functions.push_back({ 1, arm.x, arm.y, dot(arm, arm) });
		for (std::size_t row = 0; row < 4; ++row) {
			for (std::size_t column = 0; column < 4; ++column) {
				matrix[row][column] += masses[i] / mass * functions[i][row] * functions[i][column];
			}
		}
	}
	std::array<double, 4> factors{};
	bool is_solved = solve<4>(matrix, { 1, 0, 0, 1 }, factors);
	std::vector<double> changed;
	for (std::size_t i = 0; i < points.size() && is_solved; ++i) {
		double factor = 0;
		for (std::size_t k = 0; k < 4; ++k) {
			factor += factors[k] * functions[i][k];
		}
		is_solved = factor >= LEAST_FACTOR;
		changed.push_back(masses[i] * factor);
	}
	if (!is_solved) {
		std::ranges::copy(given, masses.begin());
		return balance_masses(points, moments.centroid, masses);
	}
	for (std::size_t i = 0; i < points.size(); ++i) {
		masses[i] = changed[i];
	}
	return true;
}

} // namespace softbody
