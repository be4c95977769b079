// SPDX-License-Identifier: MIT
// Finds the elastic modes of an outline, and the masses with which they swing as the solid does.
#include "core/creator/elastic_modes.h"

#include "core/creator/lattice_solid.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace softbody {

namespace {

constexpr std::size_t LATTICE_CELLS = 200;

// Poisson's ratio at which modes are sought. Their stiffnesses at other ratios follow from these shapes: an error of
// the shape enters such a quotient by its square only.
constexpr std::size_t REFERENCE_RATIO = 2;

// Degree of the polynomials that start the search; smooth modes differ little from them.
constexpr int START_DEGREE = 4;
constexpr int ITERATIONS = 4;
constexpr int LATER_ITERATIONS = 2;
constexpr std::size_t KEPT_MODES = MAX_ELASTIC_MODES + 4;
constexpr std::size_t FREQUENCY_BLOCK = 6;
constexpr int FREQUENCY_ITERATIONS = 5;

// Hull share of the mass [1]: first guess and bounds. A disk has about 0.6.
constexpr double FIRST_HULL_SHARE = 0.6;
constexpr double LEAST_HULL_SHARE = 0.12;
constexpr double MOST_HULL_SHARE = 0.95;
constexpr int MASS_ITERATIONS = 3;

// Least mass of a hull point, over their mean: contacts would flick lighter points about.
constexpr double LEAST_MASS = 0.3;

constexpr double SMOOTHED_CELLS = 1.5;

// Most pieces into which an edge is divided where loads are spread along it.
constexpr double MOST_PIECES = 16;

using Vector = std::vector<double>; // two entries a point

double weighted_dot(const Vector &a, const Vector &b, const Vector &weights) {
	double sum = 0;
	for (std::size_t k = 0; k < a.size(); ++k) {
		sum += weights[k] * a[k] * b[k];
	}
	return sum;
}

void add(Vector &to, const Vector &from, double factor) {
	for (std::size_t k = 0; k < to.size(); ++k) {
		to[k] += factor * from[k];
	}
}

void scale(Vector &vector, double factor) {
	for (double &value : vector) {
		value *= factor;
	}
}

// Eigenvalues, descending, and eigenvectors (columns) of a symmetric matrix, by Jacobi's rotations.
void diagonalize(std::vector<Vector> &matrix, std::vector<Vector> &vectors, Vector &values) {
	const std::size_t n = matrix.size();
	vectors.assign(n, Vector(n, 0));
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
	std::vector<Vector> sorted(n, Vector(n));
	values.resize(n);
	for (std::size_t j = 0; j < n; ++j) {
		values[j] = matrix[order[j]][order[j]];
		for (std::size_t k = 0; k < n; ++k) {
			sorted[k][j] = vectors[k][order[j]];
		}
	}
	vectors = std::move(sorted);
}

// Gram and Schmidt, twice, which is enough. A vector that depends on those before it is left out.
std::vector<Vector> orthonormal_by(std::vector<Vector> vectors, const Vector &weights) {
	std::vector<Vector> result;
	for (Vector &vector : vectors) {
		const double first = weighted_dot(vector, vector, weights);
		for (int pass = 0; pass < 2; ++pass) {
			for (const Vector &earlier : result) {
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

// The combinations (columns) of an orthonormal block that are its best eigenvectors of an operator, and their
// eigenvalues, descending. `images` is the operator applied to the block.
std::vector<Vector> ritz_combinations(const std::vector<Vector> &block, const std::vector<Vector> &images, const Vector &weights,
		Vector &values) {
	std::vector<Vector> matrix(block.size(), Vector(block.size()));
	for (std::size_t a = 0; a < block.size(); ++a) {
		for (std::size_t b = 0; b <= a; ++b) {
			matrix[a][b] = matrix[b][a] = (weighted_dot(block[a], images[b], weights) + weighted_dot(block[b], images[a], weights)) / 2;
		}
	}
	std::vector<Vector> combinations;
	diagonalize(matrix, combinations, values);
	return combinations;
}

// The solid as its points see it: loads on them in, displacements of them out.
class Reduction {
public:
	Reduction(std::span<const Vec2> points, std::size_t hull_count);

	/// Share of the mass on the hull. Updates everything that depends on masses.
	void set_hull_share(double share);
	void find_modes();
	/// Lowest frequency of the solid itself, squared, times its mass over its shear modulus. Starts from the modes.
	double lowest_frequency_squared();
	/// Lowest frequency of the points in their modes, squared, times mass over shear modulus.
	double reduced_frequency_squared() const { return 1 / compliances_[0]; }
	bool has_inner_points() const { return 2 * hull_count_ < masses_.size(); }
	ElasticReduction result();

private:
	std::vector<Vector> orthonormal(std::vector<Vector> vectors) const { return orthonormal_by(std::move(vectors), masses_); }
	void make_rigid_basis();
	void remove_rigid(Vector &displacement) const;
	void smooth_shares();
	void assign_edges();
	void assign_regions();
	Vector to_nodes(const Vector &loads) const;
	Vector from_nodes(const Vector &nodes) const;
	std::vector<Vector> solve(const std::vector<Vector> &loads) const;
	void solve_dilation();
	std::vector<Vector> apply_compliance(std::vector<Vector> displacements) const;

	/// The nodes that an inner point stands for, with their center and inertia.
	struct Region {
		std::vector<std::uint32_t> nodes;
		double mass = 0;
		double x = 0;
		double y = 0;
		double inertia = 0;
	};

	std::vector<Vec2> points_;
	std::size_t hull_count_;
	LatticeSolid solid_;
	/// For each hull point: the nodes along its two edges, by the weights with which they share its load.
	std::vector<std::vector<std::pair<std::uint32_t, double>>> edges_;
	std::vector<Region> regions_; ///< of each inner point
	Vector hull_shares_; ///< of each hull point, summing to 1
	Vector masses_; ///< each twice, for both coordinates
	Vec2 center_;
	std::vector<Vector> rigid_; ///< orthonormal by mass
	Vector area_gradient_; ///< at rest [length]
	Vector dilation_; ///< displacement under a pressure inside
	std::vector<Vector> modes_; ///< orthonormal by mass
	Vector compliances_; ///< descending
};

Reduction::Reduction(std::span<const Vec2> points, std::size_t hull_count) :
		points_(points.begin(), points.end()), hull_count_(hull_count), solid_(points.first(hull_count), LATTICE_CELLS) {
	const std::span<const Vec2> hull = points.first(hull_count);
	area_gradient_.assign(2 * points.size(), 0);
	for (std::size_t i = 0; i < hull_count; ++i) {
		const Vec2 last = hull[i == 0 ? hull_count - 1 : i - 1];
		const Vec2 next = hull[i + 1 == hull_count ? 0 : i + 1];
		area_gradient_[2 * i] = (double(next.y) - last.y) / 2;
		area_gradient_[2 * i + 1] = (double(last.x) - next.x) / 2;
	}
	// Each hull point stands for the part of the solid that is nearest to it: the tip of a star is light.
	hull_shares_.assign(hull_count, 0);
	for (std::uint32_t node = 0; node < solid_.node_masses().size(); ++node) {
		const Vec2 place = solid_.node_position(node);
		double least = length_squared(hull[0] - place);
		for (const Vec2 p : hull) {
			least = std::min(least, double(length_squared(p - place)));
		}
		std::vector<std::size_t> nearest; // several on a line of symmetry
		for (std::size_t i = 0; i < hull_count; ++i) {
			if (length_squared(hull[i] - place) <= least * (1 + 1e-4)) {
				nearest.push_back(i);
			}
		}
		for (const std::size_t i : nearest) {
			hull_shares_[i] += solid_.node_masses()[node] / double(nearest.size());
		}
	}
	smooth_shares();
	double sum = 0;
	for (double &share : hull_shares_) {
		share = std::max(share, LEAST_MASS / double(hull_count));
		sum += share;
	}
	scale(hull_shares_, 1 / sum);
	assign_edges();
	assign_regions();
	solid_.factor(MODE_POISSON_RATIOS[REFERENCE_RATIO]);
}

// Hull points closer together than the lattice's nodes share the sum within a cell's length equally.
void Reduction::smooth_shares() {
	const auto edge = [&](std::size_t i) { return double(length(points_[(i + 1) % hull_count_] - points_[i])); };
	const auto tributary = [&](std::size_t i) { return (edge((i + hull_count_ - 1) % hull_count_) + edge(i)) / 2; };
	const double reach = SMOOTHED_CELLS * solid_.cell_size();
	Vector smooth(hull_count_);
	for (std::size_t i = 0; i < hull_count_; ++i) {
		double share = hull_shares_[i];
		double length = tributary(i);
		double ahead = edge(i);
		double behind = edge((i + hull_count_ - 1) % hull_count_);
		for (std::size_t k = 1; 2 * k < hull_count_ && (ahead < reach || behind < reach); ++k) {
			const std::size_t next = (i + k) % hull_count_;
			const std::size_t last = (i + hull_count_ - k) % hull_count_;
			if (ahead < reach) {
				share += hull_shares_[next];
				length += tributary(next);
			}
			if (behind < reach) {
				share += hull_shares_[last];
				length += tributary(last);
			}
			ahead += edge(next);
			behind += edge((last + hull_count_ - 1) % hull_count_);
		}
		smooth[i] = share / length * tributary(i);
	}
	hull_shares_ = std::move(smooth);
}

void Reduction::set_hull_share(double share) {
	const std::size_t inner = points_.size() - hull_count_;
	masses_.clear();
	for (std::size_t i = 0; i < points_.size(); ++i) {
		const double mass = i < hull_count_ ? share * hull_shares_[i] : (1 - share) / double(inner);
		masses_.insert(masses_.end(), 2, mass);
	}
	make_rigid_basis();
	solve_dilation();
}

void Reduction::make_rigid_basis() {
	double x = 0;
	double y = 0;
	for (std::size_t i = 0; i < points_.size(); ++i) {
		x += masses_[2 * i] * points_[i].x;
		y += masses_[2 * i] * points_[i].y;
	}
	center_ = { Real(x), Real(y) };
	rigid_.assign(3, Vector(masses_.size(), 0));
	for (std::size_t i = 0; i < points_.size(); ++i) {
		rigid_[0][2 * i] = 1;
		rigid_[1][2 * i + 1] = 1;
		rigid_[2][2 * i] = y - points_[i].y;
		rigid_[2][2 * i + 1] = points_[i].x - x;
	}
	rigid_ = orthonormal(std::move(rigid_));
}

void Reduction::remove_rigid(Vector &displacement) const {
	for (const Vector &motion : rigid_) {
		add(displacement, motion, -weighted_dot(displacement, motion, masses_));
	}
}

// A load on a hull point is a load on its two edges, as a contact with the ground touches edges, not points. The
// displacement of the outline is the piecewise linear one that fits the solid's best, through a basis that is dual to
// the hat functions (Wohlmuth 2000): over an edge with s from 0 at the point to 1 at its neighbor the weight is 2 - 3
// s. Every uniform strain and rotation is reproduced exactly.
void Reduction::assign_edges() {
	const double offset = std::sqrt(1.0 / 12);
	edges_.assign(hull_count_, {});
	for (std::size_t i = 0; i < hull_count_; ++i) {
		const Vec2 here = points_[i];
		const std::array<Vec2, 2> neighbors = { points_[i == 0 ? hull_count_ - 1 : i - 1], points_[i + 1 == hull_count_ ? 0 : i + 1] };
		const double both = double(length(neighbors[0] - here)) + double(length(neighbors[1] - here));
		for (const Vec2 neighbor : neighbors) {
			const double share = 2 * double(length(neighbor - here)) / both;
			const auto pieces = std::size_t(std::clamp(std::ceil(double(length(neighbor - here)) / solid_.cell_size()), 1.0, MOST_PIECES));
			for (std::size_t piece = 0; piece < pieces; ++piece) {
				for (const double at : { 0.5 - offset, 0.5 + offset }) { // Gauss: exact for the products of two lines
					const double s = (double(piece) + at) / double(pieces);
					const LatticeSolid::Embedding place = solid_.embed(here + (neighbor - here) * Real(s));
					for (std::size_t c = 0; c < 4; ++c) {
						edges_[i].push_back({ place.nodes[c], place.weights[c] * share * (2 - 3 * s) / (2 * double(pieces)) });
					}
				}
			}
		}
	}
}

// An inner point stands for the part of the solid nearest to it: it moves as the mean rigid motion of that part, and
// its load is spread over it. A load on a single place would let it swing inside the body.
void Reduction::assign_regions() {
	const std::span<const Vec2> inner = std::span(points_).subspan(hull_count_);
	const std::span<const double> node_masses = solid_.node_masses();
	regions_.assign(inner.size(), {});
	for (std::uint32_t node = 0; node < node_masses.size() && !inner.empty(); ++node) {
		const Vec2 place = solid_.node_position(node);
		const auto nearest = std::ranges::min_element(inner, {}, [&](Vec2 p) { return length_squared(p - place); });
		regions_[std::size_t(nearest - inner.begin())].nodes.push_back(node);
	}
	for (std::size_t k = 0; k < inner.size(); ++k) {
		Region &region = regions_[k];
		if (region.nodes.empty()) { // coincident points
			const LatticeSolid::Embedding nearest = solid_.embed(inner[k]);
			region.nodes.assign(nearest.nodes.begin(), nearest.nodes.end());
		}
		for (const std::uint32_t node : region.nodes) {
			const Vec2 place = solid_.node_position(node);
			region.mass += node_masses[node];
			region.x += node_masses[node] * place.x;
			region.y += node_masses[node] * place.y;
		}
		region.x /= region.mass;
		region.y /= region.mass;
		for (const std::uint32_t node : region.nodes) {
			const Vec2 place = solid_.node_position(node);
			const double dx = place.x - region.x;
			const double dy = place.y - region.y;
			region.inertia += node_masses[node] * (dx * dx + dy * dy);
		}
	}
}

// Spreads loads on the points over the nodes.
Vector Reduction::to_nodes(const Vector &loads) const {
	Vector nodes(solid_.freedom_count(), 0);
	for (std::size_t i = 0; i < hull_count_; ++i) {
		for (const auto &[node, weight] : edges_[i]) {
			nodes[2 * node] += weight * loads[2 * i];
			nodes[2 * node + 1] += weight * loads[2 * i + 1];
		}
	}
	for (std::size_t k = 0; k < regions_.size(); ++k) {
		const Region &region = regions_[k];
		const std::size_t i = hull_count_ + k;
		const double torque = (points_[i].x - region.x) * loads[2 * i + 1] - (points_[i].y - region.y) * loads[2 * i];
		for (const std::uint32_t node : region.nodes) {
			const Vec2 place = solid_.node_position(node);
			const double mass = solid_.node_masses()[node];
			nodes[2 * node] += mass * (loads[2 * i] / region.mass - torque / region.inertia * (place.y - region.y));
			nodes[2 * node + 1] += mass * (loads[2 * i + 1] / region.mass + torque / region.inertia * (place.x - region.x));
		}
	}
	return nodes;
}

// The displacements of the points when the nodes move: the transpose of `to_nodes`.
Vector Reduction::from_nodes(const Vector &nodes) const {
	Vector result(2 * points_.size(), 0);
	for (std::size_t i = 0; i < hull_count_; ++i) {
		for (const auto &[node, weight] : edges_[i]) {
			result[2 * i] += weight * nodes[2 * node];
			result[2 * i + 1] += weight * nodes[2 * node + 1];
		}
	}
	for (std::size_t k = 0; k < regions_.size(); ++k) {
		const Region &region = regions_[k];
		const std::size_t i = hull_count_ + k;
		double x = 0;
		double y = 0;
		double turn = 0;
		for (const std::uint32_t node : region.nodes) {
			const Vec2 place = solid_.node_position(node);
			const double mass = solid_.node_masses()[node];
			x += mass * nodes[2 * node];
			y += mass * nodes[2 * node + 1];
			turn += mass * ((place.x - region.x) * nodes[2 * node + 1] - (place.y - region.y) * nodes[2 * node]);
		}
		result[2 * i] = x / region.mass - turn / region.inertia * (points_[i].y - region.y);
		result[2 * i + 1] = y / region.mass + turn / region.inertia * (points_[i].x - region.x);
	}
	return result;
}

// Displacements of the points by balanced loads on them, without rigid motion.
std::vector<Vector> Reduction::solve(const std::vector<Vector> &loads) const {
	const std::size_t count = loads.size();
	Vector all(solid_.freedom_count() * count);
	for (std::size_t c = 0; c < count; ++c) {
		const Vector nodes = to_nodes(loads[c]);
		for (std::size_t k = 0; k < nodes.size(); ++k) {
			all[k * count + c] = nodes[k];
		}
	}
	solid_.solve(all, count);
	std::vector<Vector> results;
	Vector nodes(solid_.freedom_count());
	for (std::size_t c = 0; c < count; ++c) {
		for (std::size_t k = 0; k < nodes.size(); ++k) {
			nodes[k] = all[k * count + c];
		}
		results.push_back(from_nodes(nodes));
		remove_rigid(results.back());
	}
	return results;
}

void Reduction::solve_dilation() {
	dilation_ = solve({ area_gradient_ })[0];
	const Vector ones(masses_.size(), 1);
	const double work = weighted_dot(area_gradient_, dilation_, ones);
	if (work > 0) {
		scale(dilation_, 1 / work); // now of unit area
	}
}

// Displacement of the solid under forces in proportion to mass and displacement, while its area is held. This splits
// the solid exactly: a uniform pressure causes a uniform dilation, which costs no energy together with anything that
// keeps the area.
std::vector<Vector> Reduction::apply_compliance(std::vector<Vector> displacements) const {
	for (Vector &loads : displacements) {
		for (std::size_t k = 0; k < loads.size(); ++k) {
			loads[k] *= masses_[k];
		}
	}
	std::vector<Vector> results = solve(displacements);
	for (Vector &result : results) {
		double area = 0;
		for (std::size_t k = 0; k < result.size(); ++k) {
			area += area_gradient_[k] * result[k];
		}
		add(result, dilation_, -area);
	}
	return results;
}

void Reduction::find_modes() {
	std::vector<Vector> block;
	if (modes_.empty()) {
		double reach = 0;
		for (const Vec2 p : points_) {
			reach = std::max({ reach, double(std::abs(p.x - center_.x)), double(std::abs(p.y - center_.y)) });
		}
		for (int degree = 1; degree <= START_DEGREE; ++degree) {
			for (int power = 0; power <= degree; ++power) {
				for (std::size_t axis = 0; axis < 2; ++axis) {
					Vector start(masses_.size(), 0);
					for (std::size_t i = 0; i < points_.size(); ++i) {
						double value = 1;
						for (int k = 0; k < degree; ++k) {
							value *= double(k < power ? points_[i].x - center_.x : points_[i].y - center_.y) / reach;
						}
						start[2 * i + axis] = value;
					}
					block.push_back(std::move(start));
				}
			}
		}
	} else {
		block = modes_; // modes for other masses
	}
	for (Vector &vector : block) {
		remove_rigid(vector);
	}
	// The first search starts from afar; later the masses have changed a little.
	const int iterations = modes_.empty() ? ITERATIONS : LATER_ITERATIONS;
	for (int iteration = 0; iteration < iterations; ++iteration) {
		block = orthonormal(std::move(block));
		const std::vector<Vector> images = apply_compliance(block);
		// Rayleigh and Ritz: the best combinations of the block.
		std::vector<Vector> combinations = ritz_combinations(block, images, masses_, compliances_);
		const bool is_last = iteration + 1 == iterations;
		const std::size_t kept = std::min(block.size(), is_last ? KEPT_MODES : block.size());
		std::vector<Vector> next(kept, Vector(masses_.size(), 0));
		for (std::size_t a = 0; a < kept; ++a) {
			for (std::size_t b = 0; b < block.size(); ++b) {
				add(next[a], is_last ? block[b] : images[b], combinations[b][a]);
			}
		}
		block = std::move(next);
	}
	modes_ = std::move(block);
}

// Inverse iteration of several displacements of the lattice at once, from the first modes on: the lowest mode of the
// solid may be another than that of its points.
double Reduction::lowest_frequency_squared() {
	const std::span<const double> node_masses = solid_.node_masses();
	Vector weights;
	for (const double mass : node_masses) {
		weights.insert(weights.end(), 2, mass);
	}
	std::vector<Vector> rigid(3, Vector(weights.size(), 0));
	for (std::size_t node = 0; node < node_masses.size(); ++node) {
		const Vec2 arm = solid_.node_position(node) - center_;
		rigid[0][2 * node] = 1;
		rigid[1][2 * node + 1] = 1;
		rigid[2][2 * node] = -arm.y;
		rigid[2][2 * node + 1] = arm.x;
	}
	rigid = orthonormal_by(std::move(rigid), weights);
	std::vector<Vector> block;
	for (std::size_t j = 0; j < std::min(FREQUENCY_BLOCK, modes_.size()); ++j) {
		Vector loads = modes_[j];
		for (std::size_t k = 0; k < loads.size(); ++k) {
			loads[k] *= masses_[k];
		}
		block.push_back(to_nodes(loads));
	}
	const std::size_t count = block.size();
	Vector all(weights.size() * count);
	double frequency_squared = 0;
	for (int iteration = 0; iteration <= FREQUENCY_ITERATIONS; ++iteration) {
		for (std::size_t c = 0; c < count; ++c) {
			for (std::size_t k = 0; k < weights.size(); ++k) {
				all[k * count + c] = iteration == 0 ? block[c][k] : weights[k] * block[c][k];
			}
		}
		solid_.solve(all, count);
		std::vector<Vector> images(count, Vector(weights.size()));
		for (std::size_t c = 0; c < count; ++c) {
			for (std::size_t k = 0; k < weights.size(); ++k) {
				images[c][k] = all[k * count + c];
			}
			for (const Vector &motion : rigid) {
				add(images[c], motion, -weighted_dot(images[c], motion, weights));
			}
		}
		if (iteration > 0) {
			Vector compliances;
			ritz_combinations(block, images, weights, compliances);
			frequency_squared = 1 / compliances[0];
		}
		block = orthonormal_by(std::move(images), weights);
		if (block.size() < count) {
			break; // as close as rounding allows
		}
	}
	return frequency_squared;
}

ElasticReduction Reduction::result() {
	ElasticReduction reduction;
	for (std::size_t i = 0; i < points_.size(); ++i) {
		reduction.mass_shares.push_back(Real(masses_[2 * i]));
	}
	auto modes = std::make_shared<ElasticModes>();
	// Modes are neither rigid nor dilation. Modes stiffer than rounding can resolve count as deformation in no mode.
	const std::size_t most = std::min(MAX_ELASTIC_MODES, 2 * hull_count_ - 4);
	std::size_t count = 0;
	while (count < std::min(most, modes_.size()) && compliances_[count] > 1e-6 * compliances_[0]) {
		++count;
	}
	modes->count = count;
	modes->shapes.resize(points_.size() * count);
	modes->stiffness.assign(count, {});
	modes->dilation_overlap.assign(count, 0);
	for (std::size_t j = 0; j < count; ++j) {
		double overlap = 0;
		for (std::size_t i = 0; i < points_.size(); ++i) {
			const double x = masses_[2 * i] * modes_[j][2 * i];
			const double y = masses_[2 * i] * modes_[j][2 * i + 1];
			modes->shapes[i * count + j] = { Real(x), Real(y) };
			overlap += x * (double(points_[i].x) - center_.x) + y * (double(points_[i].y) - center_.y);
		}
		modes->dilation_overlap[j] = Real(overlap);
	}
	for (std::size_t ratio = 0; ratio < MODE_POISSON_RATIOS.size(); ++ratio) {
		solid_.factor(MODE_POISSON_RATIOS[ratio]);
		solve_dilation();
		const std::vector<Vector> kept(modes_.begin(), modes_.begin() + std::ptrdiff_t(count));
		const std::vector<Vector> images = apply_compliance(kept);
		for (std::size_t j = 0; j < count; ++j) {
			modes->stiffness[j][ratio] = Real(1 / weighted_dot(kept[j], images[j], masses_));
		}
	}
	const double twice_area = 2 * double(signed_area(std::span(points_).first(hull_count_)));
	double gradient_norm = 0;
	double position_norm = 0;
	for (std::size_t i = 0; i < points_.size(); ++i) {
		if (i < hull_count_) {
			modes->dilation.push_back({ Real(area_gradient_[2 * i] / twice_area), Real(area_gradient_[2 * i + 1] / twice_area) });
			gradient_norm += double(length_squared(modes->dilation.back())) / masses_[2 * i];
		}
		position_norm += masses_[2 * i] * double(length_squared(points_[i] - center_));
	}
	// The norm of the oblique projection that removes dilation, squared.
	modes->projection_bound = Real(std::max(1.0, gradient_norm * position_norm));
	reduction.modes = std::move(modes);
	return reduction;
}

} // namespace

ElasticReduction reduce_solid(std::span<const Vec2> points, std::size_t hull_count) {
	Reduction reduction(points, hull_count);
	double wanted = 0;
	double share = reduction.has_inner_points() ? FIRST_HULL_SHARE : 1.0;
	for (int iteration = 0; iteration < MASS_ITERATIONS; ++iteration) {
		reduction.set_hull_share(share);
		reduction.find_modes();
		if (!reduction.has_inner_points() || iteration + 1 == MASS_ITERATIONS) {
			break;
		}
		// Less mass on the hull swings faster, proportionally as long as modes keep their shapes.
		if (iteration == 0) {
			wanted = reduction.lowest_frequency_squared();
		}
		share *= reduction.reduced_frequency_squared() / wanted;
		share = std::clamp(share, LEAST_HULL_SHARE, MOST_HULL_SHARE);
	}
	return reduction.result();
}

} // namespace softbody
