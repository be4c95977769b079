// SPDX-License-Identifier: MIT
// The highest squared frequency of a body's springs in any configuration, from a numeric Hessian.
#pragma once

#include "core/model/soft_body_shape.h"

#include <cmath>
#include <vector>

namespace softbody::testing {

/// Gradient of sum k (|d| - l)² / 2 by central differences of that energy, coordinate by coordinate.
inline std::vector<double> spring_gradient(const SoftBodyShape &shape, std::vector<double> x) {
	const auto energy_at = [&](std::size_t point) {
		double energy = 0; // of the springs that this coordinate belongs to
		for (const Spring2D &spring : shape.springs()) {
			if (spring.a == point || spring.b == point) {
				const double length = std::hypot(x[2 * spring.b] - x[2 * spring.a], x[2 * spring.b + 1] - x[2 * spring.a + 1]);
				energy += double(spring.stiffness) * (length - spring.rest_length) * (length - spring.rest_length) / 2;
			}
		}
		return energy;
	};
	std::vector<double> gradient(x.size());
	const double step = 1e-5;
	for (std::size_t i = 0; i < x.size(); ++i) {
		const double here = x[i];
		x[i] = here + step;
		const double ahead = energy_at(i / 2);
		x[i] = here - step;
		gradient[i] = (ahead - energy_at(i / 2)) / (2 * step);
		x[i] = here;
	}
	return gradient;
}

/// Largest eigenvalue of M^(-1/2) H M^(-1/2) by power iteration. Folded springs have large negative
/// eigenvalues; the matrix is shifted by its norm, so that the iteration finds the largest and not the
/// largest in size.
inline double largest_frequency_squared(const SoftBodyShape &shape, const std::vector<Vec2> &positions) {
	const std::size_t n = 2 * positions.size();
	std::vector<double> x;
	for (const Vec2 p : positions) {
		x.push_back(p.x);
		x.push_back(p.y);
	}
	const double step = 1e-4;
	std::vector<double> matrix(n * n);
	for (std::size_t i = 0; i < n; ++i) {
		const double here = x[i];
		x[i] = here + step;
		const std::vector<double> ahead = spring_gradient(shape, x);
		x[i] = here - step;
		const std::vector<double> behind = spring_gradient(shape, x);
		x[i] = here;
		for (std::size_t j = 0; j < n; ++j) {
			const double mass = std::sqrt(double(shape.masses()[i / 2]) * shape.masses()[j / 2]);
			matrix[i * n + j] = (ahead[j] - behind[j]) / (2 * step * mass);
		}
	}
	double shift = 0;
	for (const double entry : matrix) {
		shift += entry * entry;
	}
	shift = std::sqrt(shift);
	std::vector<double> vector(n);
	for (std::size_t i = 0; i < n; ++i) {
		vector[i] = std::sin(1.0 + 3.0 * double(i)); // no symmetry that could miss a mode
	}
	double rayleigh = 0;
	for (int iteration = 0; iteration < 1000; ++iteration) {
		std::vector<double> next(n);
		double size = 0;
		double product = 0;
		double before = 0;
		for (std::size_t i = 0; i < n; ++i) {
			next[i] = shift * vector[i];
			for (std::size_t j = 0; j < n; ++j) {
				next[i] += matrix[i * n + j] * vector[j];
			}
			product += next[i] * vector[i];
			before += vector[i] * vector[i];
			size += next[i] * next[i];
		}
		rayleigh = product / before - shift;
		for (std::size_t i = 0; i < n; ++i) {
			vector[i] = next[i] / std::sqrt(size);
		}
	}
	return rayleigh;
}

} // namespace softbody::testing
