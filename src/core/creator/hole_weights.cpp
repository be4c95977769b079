// SPDX-License-Identifier: MIT
// How the holes of an elastic solid move when its outline does.
#include "core/creator/hole_weights.h"

#include "core/creator/lattice_solid.h"
#include "core/creator/point_loads.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

constexpr std::size_t CELLS = 300;
constexpr double POISSON_RATIO = 0.45;
// Compliance added to that of every hull point, over the inverse shear modulus. Without any, displacements of hull points that lie closer than
// the solid's cells would not be known from each other.
constexpr double SOFTENING = 0.003;

// Of the best affine map: hull points as far as the nearest place of the hull, and so many mean edges more, have half of its share.
constexpr double REACH_IN_EDGES = 0.75;
// Share that all hull points have, however far: where those around lie on a line, it decides what happens across that line.
constexpr double LEAST_SHARE = 0.004;

// Weights of x -> mean + (sum w x X^T)(sum w X X^T)^-1 (p - MEAN), in which X are the hull's points at rest and x those of now, from
// their means: they sum to 1, and give p itself where x = X.
void add_affine_weights(Vec2d p, std::span<const Vec2> hull, double reach, std::vector<WeightMatrix> &r_weights) {
	std::vector<double> shares;
	double sum = 0;
	Vec2d mean;
	for (const Vec2 point : hull) {
		const Vec2d arm = Vec2d(point) - p;
		const double fall = 1 / (1 + dot(arm, arm) / (reach * reach));
		shares.push_back(fall * fall * fall + LEAST_SHARE);
		sum += shares.back();
		mean += Vec2d(point) * shares.back();
	}
	mean *= 1 / sum;
	double xx = 0, xy = 0, yy = 0;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Vec2d from_mean = Vec2d(hull[i]) - mean;
		xx += shares[i] * from_mean.x * from_mean.x;
		xy += shares[i] * from_mean.x * from_mean.y;
		yy += shares[i] * from_mean.y * from_mean.y;
	}
	const double determinant = xx * yy - xy * xy; // > 0, as a hull of an area has points off any line
	const Vec2d arm = p - mean;
	const Vec2d solved{ (yy * arm.x - xy * arm.y) / determinant, (xx * arm.y - xy * arm.x) / determinant };
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Real weight = Real(shares[i] / sum + shares[i] * dot(solved, Vec2d(hull[i]) - mean));
		r_weights.push_back({ weight, 0, 0, weight });
	}
}

std::vector<WeightMatrix> affine_weights(std::span<const Vec2> hull, const Holes &holes) {
	const double edge = double(perimeter(hull)) / double(hull.size());
	std::vector<WeightMatrix> weights;
	for (const std::vector<Vec2> &hole : holes) {
		for (const Vec2 p : hole) {
			const double depth = std::sqrt(double(nearest_place(hull, p).distance_squared));
			add_affine_weights(Vec2d(p), hull, depth + REACH_IN_EDGES * edge, weights);
		}
	}
	return weights;
}

// A symmetric positive definite matrix, row by row.
class Dense {
public:
	explicit Dense(std::size_t size) : size_(size), entries_(size * size, 0.0) {}
	double &at(std::size_t row, std::size_t column) { return entries_[row * size_ + column]; }

	/// Cholesky's factor in place of the matrix.
	void factor() {
		for (std::size_t i = 0; i < size_; ++i) {
			for (std::size_t j = 0; j <= i; ++j) {
				double sum = at(i, j);
				for (std::size_t k = 0; k < j; ++k) {
					sum -= at(i, k) * at(j, k);
				}
				at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
			}
		}
	}
	void solve(std::vector<double> &r_right) {
		for (std::size_t i = 0; i < size_; ++i) {
			for (std::size_t k = 0; k < i; ++k) {
				r_right[i] -= at(i, k) * r_right[k];
			}
			r_right[i] /= at(i, i);
		}
		for (std::size_t i = size_; i-- > 0;) {
			for (std::size_t k = i + 1; k < size_; ++k) {
				r_right[i] -= at(k, i) * r_right[k];
			}
			r_right[i] /= at(i, i);
		}
	}

private:
	std::size_t size_;
	std::vector<double> entries_;
};

// With S the compliance of the solid's nodes, P what the hull's points have of nodes' displacements and E what the holes' points have of
// them: loads f on the hull move it by P S P^T f, and the holes by E S P^T f. So the map is E S P^T (P S P^T)^-1. The faint spring to the ground
// makes rigid motion by far the largest compliance, so that it is followed to rounding.
std::vector<WeightMatrix> condensed_weights(std::span<const Vec2> hull, const Holes &holes) {
	const std::size_t count = hull.size();
	LatticeSolid solid(hull, CELLS, holes);
	solid.factor(POISSON_RATIO);
	const PointLoads loads(solid, hull, count);
	std::vector<PointVector> moved;
	for (std::size_t i = 0; i < 2 * count; ++i) {
		PointVector load(count);
		(i % 2 == 0 ? load[i / 2].x : load[i / 2].y) = 1;
		moved.push_back(loads.to_nodes(load));
	}
	solid.solve(moved);
	Dense compliance(2 * count);
	for (std::size_t i = 0; i < 2 * count; ++i) {
		const PointVector of_hull = loads.from_nodes(moved[i]);
		for (std::size_t j = 0; j < count; ++j) {
			compliance.at(2 * j, i) = of_hull[j].x;
			compliance.at(2 * j + 1, i) = of_hull[j].y;
		}
		compliance.at(i, i) += SOFTENING;
	}
	compliance.factor();
	std::vector<WeightMatrix> weights;
	for (const std::vector<Vec2> &hole : holes) {
		for (const Vec2 p : hole) {
			const LatticeSolid::Embedding place = solid.embed(p);
			std::array<std::vector<double>, 2> rows{ std::vector<double>(2 * count), std::vector<double>(2 * count) };
			for (std::size_t i = 0; i < 2 * count; ++i) {
				Vec2d sum;
				for (std::size_t c = 0; c < 4; ++c) {
					sum += moved[i][place.nodes[c]] * place.weights[c];
				}
				rows[0][i] = sum.x;
				rows[1][i] = sum.y;
			}
			compliance.solve(rows[0]);
			compliance.solve(rows[1]);
			for (std::size_t j = 0; j < count; ++j) {
				weights.push_back({ Real(rows[0][2 * j]), Real(rows[0][2 * j + 1]), Real(rows[1][2 * j]), Real(rows[1][2 * j + 1]) });
			}
		}
	}
	return weights;
}

} // namespace

std::vector<WeightMatrix> hole_weights(std::span<const Vec2> hull, const Holes &holes) {
	if (hull.size() > MOST_CONDENSED_POINTS) {
		return affine_weights(hull, holes);
	}
	if (signed_area(hull) > 0) {
		return condensed_weights(hull, holes);
	}
	const std::vector<Vec2> turned(hull.rbegin(), hull.rend());
	std::vector<WeightMatrix> weights = condensed_weights(turned, holes);
	for (std::size_t start = 0; start < weights.size(); start += hull.size()) {
		std::reverse(weights.begin() + std::ptrdiff_t(start), weights.begin() + std::ptrdiff_t(start + hull.size()));
	}
	return weights;
}

} // namespace softbody
