// SPDX-License-Identifier: MIT
// Eigenvectors of symmetric operators from small blocks of vectors.
#include "core/creator/ritz.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

// Eigenvalues, descending, and eigenvectors (columns) of a symmetric matrix, by Jacobi's rotations.
void diagonalize(std::vector<PointVector> &matrix, std::vector<PointVector> &vectors, PointVector &values) {
	const std::size_t n = matrix.size();
	vectors.assign(n, PointVector(n, 0));
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
				for (std::size_t k = 0; k < n; ++k) {
					const double a = matrix[k][p];
					const double b = matrix[k][q];
					matrix[k][p] = c * a - s * b;
					matrix[k][q] = s * a + c * b;
				}
				for (std::size_t k = 0; k < n; ++k) {
					const double a = matrix[p][k];
					const double b = matrix[q][k];
					matrix[p][k] = c * a - s * b;
					matrix[q][k] = s * a + c * b;
				}
				for (std::size_t k = 0; k < n; ++k) {
					const double a = vectors[k][p];
					const double b = vectors[k][q];
					vectors[k][p] = c * a - s * b;
					vectors[k][q] = s * a + c * b;
				}
			}
		}
	}
	std::vector<std::size_t> order(n);
	std::iota(order.begin(), order.end(), std::size_t(0));
	std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return matrix[i][i]; });
	std::vector<PointVector> sorted(n, PointVector(n));
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

double weighted_dot(const PointVector &a, const PointVector &b, const PointVector &weights) {
	double sum = 0;
	for (std::size_t k = 0; k < a.size(); ++k) {
		sum += weights[k] * a[k] * b[k];
	}
	return sum;
}

void add(PointVector &to, const PointVector &from, double factor) {
	for (std::size_t k = 0; k < to.size(); ++k) {
		to[k] += factor * from[k];
	}
}

void scale(PointVector &vector, double factor) {
	for (double &value : vector) {
		value *= factor;
	}
}

std::vector<PointVector> orthonormal_by(std::vector<PointVector> vectors, const PointVector &weights) {
	std::vector<PointVector> result;
	for (PointVector &vector : vectors) {
		const double first = weighted_dot(vector, vector, weights);
		for (int pass = 0; pass < 2; ++pass) {
			for (const PointVector &earlier : result) {
				add(vector, earlier, -weighted_dot(vector, earlier, weights));
			}
		}
		const double rest = weighted_dot(vector, vector, weights);
		if (rest > 1e-10 * first) {
			scale(vector, 1 / std::sqrt(rest));
			result.push_back(std::move(vector));
		}
	}
	return result;
}

std::vector<PointVector> ritz_combinations(const std::vector<PointVector> &block, const std::vector<PointVector> &images, const PointVector &weights,
		PointVector &values) {
	std::vector<PointVector> matrix(block.size(), PointVector(block.size()));
	for (std::size_t a = 0; a < block.size(); ++a) {
		for (std::size_t b = 0; b <= a; ++b) {
			matrix[a][b] = matrix[b][a] = (weighted_dot(block[a], images[b], weights) + weighted_dot(block[b], images[a], weights)) / 2;
		}
	}
	std::vector<PointVector> combinations;
	diagonalize(matrix, combinations, values);
	return combinations;
}

} // namespace softbody
