// SPDX-License-Identifier: MIT
// Eigenvectors of symmetric operators from small blocks of vectors (Rayleigh and Ritz).
#pragma once

#include <vector>

namespace softbody {

/// Coordinates of several points: x and y of the first, x and y of the second, ...
using PointVector = std::vector<double>;

/// Sum of weights[k] a[k] b[k].
double weighted_dot(const PointVector &a, const PointVector &b, const PointVector &weights);
/// Adds `factor` times `from`.
void add(PointVector &to, const PointVector &from, double factor);
void scale(PointVector &vector, double factor);

/// Orthonormal vectors that span the given ones, by the weighted product (Gram and Schmidt, twice). A vector that depends on
/// those before it is left out.
std::vector<PointVector> orthonormal_by(std::vector<PointVector> vectors, const PointVector &weights);

/// Combinations (columns) of an orthonormal block that are its best eigenvectors of an operator, with their eigenvalues in
/// `values`, descending. `images` is the operator applied to the block.
std::vector<PointVector> ritz_combinations(const std::vector<PointVector> &block, const std::vector<PointVector> &images, const PointVector &weights,
		PointVector &values);

} // namespace softbody
