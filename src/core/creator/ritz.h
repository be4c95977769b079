// SPDX-License-Identifier: MIT
// Eigenvectors of symmetric operators from small blocks of vectors (Rayleigh and Ritz).
#pragma once

#include "core/base/vec2.h"

#include <span>
#include <vector>

namespace softbody {

/// One vector for each of several points.
using PointVector = std::vector<Vec2d>;

/// Sum of weights[i] dot(a[i], b[i]).
double weighted_dot(const PointVector &a, const PointVector &b, std::span<const double> weights);
/// Adds `factor` times `from`.
void add(PointVector &to, const PointVector &from, double factor);
/// Each vector times its weight.
PointVector weighted(PointVector vectors, std::span<const double> weights);

/// Takes from `vector` what lies in the span of the others, which are orthonormal by the weighted product.
void remove_parts(PointVector &vector, const std::vector<PointVector> &others, std::span<const double> weights);
/// Orthonormal vectors that span the given ones, by the weighted product (Gram and Schmidt, twice). A vector that depends on
/// those before it is left out.
std::vector<PointVector> orthonormal_by(std::vector<PointVector> vectors, std::span<const double> weights);

/// Combinations (columns) of an orthonormal block that are its best eigenvectors of an operator, with their eigenvalues in
/// `values`, descending. `images` is the operator applied to the block.
std::vector<std::vector<double>> ritz_combinations(const std::vector<PointVector> &block, const std::vector<PointVector> &images,
		std::span<const double> weights, std::vector<double> &values);

} // namespace softbody
