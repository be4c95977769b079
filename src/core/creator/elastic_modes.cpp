// SPDX-License-Identifier: MIT
// Finds the elastic modes of an outline, and the masses with which they swing as the solid does.
#include "core/creator/elastic_modes.h"

#include "core/creator/balanced_masses.h"
#include "core/creator/lattice_solid.h"
#include "core/creator/point_loads.h"
#include "core/creator/ritz.h"
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

// Bounds of the hull's share of the mass [1]. The first search has all of it there; a disk has about 0.6.
constexpr double LEAST_HULL_SHARE = 0.12;
constexpr double MOST_HULL_SHARE = 0.95;
constexpr int MASS_ITERATIONS = 3;
// Of a body with holes, before its masses are given the solid's moment of inertia.
constexpr double HOLED_HULL_SHARE = 0.9;
// Stiffest mode of a solid with holes, over the softest. Smaller: a ring dents where it is pressed. Larger: substeps. A disk's are 3 apart, those of
// a ring with a wall of a tenth of its radius a thousand.
constexpr Real HOLED_STIFFNESS_RANGE = 20;

// Translations and the rotation of places about which `arms` are known, orthonormal by mass.
std::vector<PointVector> rigid_motions(const PointVector &arms, std::span<const double> masses) {
	std::vector<PointVector> motions = { PointVector(arms.size(), { 1, 0 }), PointVector(arms.size(), { 0, 1 }), arms };
	for (Vec2d &each : motions[2]) {
		each = perpendicular(each);
	}
	return orthonormal_by(std::move(motions), masses);
}

// The solid as its points see it: loads on them in, displacements of them out.
class Reduction {
public:
	Reduction(std::span<const Vec2> points, std::size_t hull_count, bool is_balanced, const Holes &holes);

	/// Share of the mass on the hull. Updates everything that depends on masses.
	void set_hull_share(double share);
	void find_modes();
	/// Lowest frequency of the solid itself, squared, times its mass over its shear modulus. Starts from the modes.
	double lowest_frequency_squared();
	/// Lowest frequency of the points in their modes, squared, times mass over shear modulus.
	double reduced_frequency_squared() const { return 1 / compliances_[0]; }
	bool has_inner_points() const { return hull_count_ < points_.size(); }
	bool has_holes() const { return !holes_.empty(); }
	ElasticReduction result();

private:
	std::vector<PointVector> solve(const std::vector<PointVector> &loads) const;
	void solve_dilation();
	std::vector<PointVector> apply_compliance(std::vector<PointVector> displacements) const;

	std::vector<Vec2> points_;
	std::size_t hull_count_;
	bool is_balanced_;
	Holes holes_;
	LatticeSolid solid_;
	PointLoads loads_;
	std::vector<double> masses_;
	Vec2 center_;
	std::vector<PointVector> rigid_; ///< orthonormal by mass
	PointVector area_gradient_; ///< at rest [length]
	PointVector dilation_; ///< displacement under a pressure inside
	double dilation_work_ = 0; ///< growth of the area under a pressure of 1
	std::vector<PointVector> modes_; ///< orthonormal by mass
	std::vector<double> compliances_; ///< descending
};

Reduction::Reduction(std::span<const Vec2> points, std::size_t hull_count, bool is_balanced, const Holes &holes) :
		points_(points.begin(), points.end()), hull_count_(hull_count), is_balanced_(is_balanced), holes_(holes), solid_(points.first(hull_count), LATTICE_CELLS, holes),
		loads_(solid_, points, hull_count) {
	const std::span<const Vec2> hull = points.first(hull_count);
	area_gradient_.assign(points.size(), {});
	for (std::size_t i = 0; i < hull_count; ++i) {
		const Vec2 last = hull[i == 0 ? hull_count - 1 : i - 1];
		const Vec2 next = hull[i + 1 == hull_count ? 0 : i + 1];
		area_gradient_[i] = { (double(next.y) - last.y) / 2, (double(last.x) - next.x) / 2 };
	}
	solid_.factor(MODE_POISSON_RATIOS[REFERENCE_RATIO]);
}

void Reduction::set_hull_share(double share) {
	const std::size_t inner = points_.size() - hull_count_;
	masses_.clear();
	for (std::size_t i = 0; i < points_.size(); ++i) {
		masses_.push_back(i < hull_count_ ? share * loads_.hull_shares()[i] : (1 - share) / double(inner));
	}
	if (has_holes()) {
		give_moments(points_, hull_count_, area_moments(std::span(points_).first(hull_count_), holes_), masses_);
	} else if (is_balanced_) {
		balance_masses(points_, Vec2d(area_centroid(std::span(points_).first(hull_count_))), masses_);
	}
	Vec2d center;
	for (std::size_t i = 0; i < points_.size(); ++i) {
		center += Vec2d(points_[i]) * masses_[i];
	}
	center_ = Vec2(center);
	PointVector arms;
	for (const Vec2 p : points_) {
		arms.push_back(Vec2d(p) - center);
	}
	rigid_ = rigid_motions(arms, masses_);
	solve_dilation();
}

// Displacements of the points by balanced loads on them, without rigid motion.
std::vector<PointVector> Reduction::solve(const std::vector<PointVector> &loads) const {
	std::vector<PointVector> nodes;
	for (const PointVector &load : loads) {
		nodes.push_back(loads_.to_nodes(load));
	}
	solid_.solve(nodes);
	std::vector<PointVector> results;
	for (const PointVector &moved : nodes) {
		results.push_back(loads_.from_nodes(moved));
		remove_parts(results.back(), rigid_, masses_);
	}
	return results;
}

void Reduction::solve_dilation() {
	dilation_ = solve({ area_gradient_ })[0];
	const double work = weighted_dot(area_gradient_, dilation_, std::vector<double>(masses_.size(), 1));
	dilation_work_ = work;
	if (work > 0) {
		for (Vec2d &each : dilation_) {
			each *= 1 / work; // now of unit area
		}
	}
}

// Displacement of the solid under forces in proportion to mass and displacement, while its area is held. This splits
// the solid exactly: a uniform pressure causes a uniform dilation, which costs no energy together with anything that
// keeps the area.
std::vector<PointVector> Reduction::apply_compliance(std::vector<PointVector> displacements) const {
	for (PointVector &loads : displacements) {
		loads = weighted(std::move(loads), masses_);
	}
	std::vector<PointVector> results = solve(displacements);
	const std::vector<double> ones(masses_.size(), 1);
	for (PointVector &result : results) {
		add(result, dilation_, -weighted_dot(area_gradient_, result, ones));
	}
	return results;
}

void Reduction::find_modes() {
	std::vector<PointVector> block;
	if (modes_.empty()) {
		double reach = 0;
		for (const Vec2 p : points_) {
			reach = std::max({ reach, double(std::abs(p.x - center_.x)), double(std::abs(p.y - center_.y)) });
		}
		for (int degree = 1; degree <= START_DEGREE; ++degree) {
			for (int power = 0; power <= degree; ++power) {
				for (const Vec2d axis : { Vec2d{ 1, 0 }, Vec2d{ 0, 1 } }) {
					PointVector start;
					for (const Vec2 p : points_) {
						double value = 1;
						for (int k = 0; k < degree; ++k) {
							value *= double(k < power ? p.x - center_.x : p.y - center_.y) / reach;
						}
						start.push_back(axis * value);
					}
					block.push_back(std::move(start));
				}
			}
		}
	} else {
		block = modes_; // modes for other masses
	}
	for (PointVector &vector : block) {
		remove_parts(vector, rigid_, masses_);
	}
	// The first search starts from afar; later the masses have changed a little.
	const int iterations = modes_.empty() ? ITERATIONS : LATER_ITERATIONS;
	for (int iteration = 0; iteration < iterations; ++iteration) {
		block = orthonormal_by(std::move(block), masses_);
		const std::vector<PointVector> images = apply_compliance(block);
		// Rayleigh and Ritz: the best combinations of the block.
		const std::vector<std::vector<double>> combinations = ritz_combinations(block, images, masses_, compliances_);
		const bool is_last = iteration + 1 == iterations;
		const std::size_t kept = std::min(block.size(), is_last ? KEPT_MODES : block.size());
		std::vector<PointVector> next(kept, PointVector(masses_.size()));
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
	const std::span<const double> weights = solid_.node_masses();
	PointVector arms;
	for (std::size_t node = 0; node < weights.size(); ++node) {
		arms.push_back(Vec2d(solid_.node_position(node) - center_));
	}
	const std::vector<PointVector> rigid = rigid_motions(arms, weights);
	std::vector<PointVector> block;
	std::vector<PointVector> images;
	for (std::size_t j = 0; j < std::min(FREQUENCY_BLOCK, modes_.size()); ++j) {
		images.push_back(loads_.to_nodes(weighted(modes_[j], masses_)));
	}
	const std::size_t count = images.size();
	double frequency_squared = 0;
	for (int iteration = 0; iteration <= FREQUENCY_ITERATIONS; ++iteration) {
		solid_.solve(images);
		for (PointVector &image : images) {
			remove_parts(image, rigid, weights);
		}
		if (iteration > 0) {
			std::vector<double> compliances;
			ritz_combinations(block, images, weights, compliances);
			frequency_squared = 1 / compliances[0];
		}
		block = orthonormal_by(std::move(images), weights);
		if (block.size() < count) {
			break; // as close as rounding allows
		}
		images.clear();
		for (const PointVector &each : block) {
			images.push_back(weighted(each, weights));
		}
	}
	return frequency_squared;
}

ElasticReduction Reduction::result() {
	ElasticReduction reduction;
	reduction.mass_shares.assign(masses_.begin(), masses_.end());
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
			const Vec2d moved = modes_[j][i] * masses_[i];
			modes->shapes[i * count + j] = Vec2(moved);
			overlap += dot(moved, difference(points_[i], center_));
		}
		modes->dilation_overlap[j] = Real(overlap);
	}
	std::array<Real, 3> hull_compliance{};
	for (std::size_t ratio = 0; ratio < MODE_POISSON_RATIOS.size(); ++ratio) {
		solid_.factor(MODE_POISSON_RATIOS[ratio]);
		solve_dilation();
		hull_compliance[ratio] = Real(dilation_work_ / double(signed_area(std::span(points_).first(hull_count_))));
		const std::vector<PointVector> kept(modes_.begin(), modes_.begin() + std::ptrdiff_t(count));
		const std::vector<PointVector> images = apply_compliance(kept);
		for (std::size_t j = 0; j < count; ++j) {
			modes->stiffness[j][ratio] = Real(1 / weighted_dot(kept[j], images[j], masses_));
		}
	}
	const double twice_area = 2 * double(signed_area(std::span(points_).first(hull_count_)));
	if (has_holes()) {
		modes->hull_compliance = hull_compliance;
		for (std::size_t j = count; j-- > 0;) {
			for (std::size_t ratio = 0; ratio < MODE_POISSON_RATIOS.size(); ++ratio) {
				modes->stiffness[j][ratio] = std::min(modes->stiffness[j][ratio], HOLED_STIFFNESS_RANGE * modes->stiffness[0][ratio]);
			}
		}
	}
	double gradient_norm = 0;
	double position_norm = 0;
	for (std::size_t i = 0; i < points_.size(); ++i) {
		if (i < hull_count_) {
			modes->dilation.push_back({ Real(area_gradient_[i].x / twice_area), Real(area_gradient_[i].y / twice_area) });
			gradient_norm += double(length_squared(modes->dilation.back())) / masses_[i];
		}
		position_norm += masses_[i] * double(length_squared(points_[i] - center_));
	}
	// The norm of the oblique projection that removes dilation, squared.
	modes->projection_bound = Real(std::max(1.0, gradient_norm * position_norm));
	reduction.modes = std::move(modes);
	return reduction;
}

} // namespace

ElasticReduction reduce_solid(std::span<const Vec2> points, std::size_t hull_count, bool is_balanced, const Holes &holes) {
	Reduction reduction(points, hull_count, is_balanced, holes);
	if (reduction.has_holes()) { // masses by inertia, not by frequency
		reduction.set_hull_share(reduction.has_inner_points() ? HOLED_HULL_SHARE : 1);
		reduction.find_modes();
		return reduction.result();
	}
	double wanted = 0;
	double share = 1;
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
