// SPDX-License-Identifier: MIT
// Eigenvectors of symmetric operators from small blocks of vectors.
#include "core/creator/ritz.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

using Matrix = std::vector<std::vector<double>>;

// Eigenvalues, descending, and eigenvectors (columns) of a symmetric matrix, by Jacobi's rotations.
void diagonalize(Matrix &matrix, Matrix &vectors, std::vector<double> &values) {
	const std::size_t n = matrix.size();
	vectors.assign(n, std::vector<double>(n, 0));
	for (std::size_t i = 0; i < n; ++i) {
		vectors[i][i] = 1;
	}
	for (int sweep = 0; sweep < 30; ++sweep) {
		double off = 0;
		double diagonal = 0;
		for (std::size_t i = 0; i < n; ++i) {
			diagonal += matrix[i][i] * matrix[i][i];
			for (std::size_t j = i + 1; j < n; ++j) {
				off += matrix[i][j] * matrix[i][j];
			}
		}
		if (off <= 1e-22 * diagonal) {
			break;
		}
		for (std::size_t p = 0; p < n; ++p) {
			for (std::size_t q = p + 1; q < n; ++q) {
				if (matrix[p][q] == 0) {
					continue;
				}
				const double theta = (matrix[q][q] - matrix[p][p]) / (2 * matrix[p][q]);
				const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
				const double c = 1 / std::sqrt(t * t + 1);
				const double s = t * c;
				const auto rotate = [c, s](double &x, double &y) {
					const double a = x;
					x = c * a - s * y;
					y = s * a + c * y;
				};
				for (std::size_t k = 0; k < n; ++k) {
					rotate(matrix[k][p], matrix[k][q]);
					rotate(vectors[k][p], vectors[k][q]);
				}
				for (std::size_t k = 0; k < n; ++k) {
					rotate(matrix[p][k], matrix[q][k]);
				}
			}
		}
	}
	std::vector<std::size_t> order(n);
	std::iota(order.begin(), order.end(), std::size_t(0));
	std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return matrix[i][i]; });
	Matrix sorted(n, std::vector<double>(n));
	values.resize(n);
	for (std::size_t j = 0; j < n; ++j) {
		values[j] = matrix[order[j]][order[j]];
		for (std::size_t k = 0; k < n; ++k) {
			sorted[k][j] = vectors[k][order[j]];
		}
	}
	vectors = std::move(sorted);
}

} // namespace

// The order of this sum decides about the last digits of all modes.
double weighted_dot(const PointVector &a, const PointVector &b, std::span<const double> weights) {
	double sum = 0;
	for (std::size_t i = 0; i < a.size(); ++i) {
		sum += weights[i] * a[i].x * b[i].x;
		sum += weights[i] * a[i].y * b[i].y;
	}
	return sum;
}

void add(PointVector &to, const PointVector &from, double factor) {
	for (std::size_t i = 0; i < to.size(); ++i) {
		to[i] += from[i] * factor;
	}
}

PointVector weighted(PointVector vectors, std::span<const double> weights) {
	for (std::size_t i = 0; i < vectors.size(); ++i) {
		vectors[i] *= weights[i];
	}
	return vectors;
}

void remove_parts(PointVector &vector, const std::vector<PointVector> &others, std::span<const double> weights) {
	for (const PointVector &other : others) {
		add(vector, other, -weighted_dot(vector, other, weights));
	}
}

std::vector<PointVector> orthonormal_by(std::vector<PointVector> vectors, std::span<const double> weights) {
	std::vector<PointVector> result;
	for (PointVector &vector : vectors) {
		const double first = weighted_dot(vector, vector, weights);
		remove_parts(vector, result, weights);
		remove_parts(vector, result, weights);
		const double rest = weighted_dot(vector, vector, weights);
		if (rest > 1e-10 * first) {
			const double factor = 1 / std::sqrt(rest);
			for (Vec2d &each : vector) {
				each *= factor;
			}
			result.push_back(std::move(vector));
		}
	}
	return result;
}

std::vector<std::vector<double>> ritz_combinations(const std::vector<PointVector> &block, const std::vector<PointVector> &images,
		std::span<const double> weights, std::vector<double> &values) {
	Matrix matrix(block.size(), std::vector<double>(block.size()));
	for (std::size_t a = 0; a < block.size(); ++a) {
		for (std::size_t b = 0; b <= a; ++b) {
			matrix[a][b] = matrix[b][a] = (weighted_dot(block[a], images[b], weights) + weighted_dot(block[b], images[a], weights)) / 2;
		}
	}
	Matrix combinations;
	diagonalize(matrix, combinations, values);
	return combinations;
}

} // namespace softbody
