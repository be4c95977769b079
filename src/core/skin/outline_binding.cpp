// SPDX-License-Identifier: MIT
// Carries a drawn outline of many points along with a simulated hull of few.
#include "core/skin/outline_binding.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace softbody {

namespace {

// Distance along the hull within which points decide how the place around a drawn point is stretched and turned, in mean edges,
// and the share that all other points have. Larger: details turn with the whole body, not with their limb. Smaller: what little bulge
// a straight stretch of the hull has decides.
constexpr double REACH_IN_EDGES = 1.5;
constexpr double LEAST_SHARE = 0.01;

// Place along the hull: t of the way from the point of that index to the next.
struct HullPlace {
	std::size_t edge = 0;
	double t = 0;
};

double distance_between(Vec2d a, Vec2d b) {
	return std::sqrt(dot(b - a, b - a));
}

class Binder {
public:
	Binder(std::span<const Vec2> p_hull) : count_(p_hull.size()) {
		for (std::size_t i = 0; i < count_; ++i) {
			hull_.push_back(Vec2d(p_hull[i]));
		}
		double way = 0;
		for (std::size_t i = 0; i < count_; ++i) {
			ways_.push_back(way);
			lengths_.push_back(distance_between(hull_[i], hull_[next(i)]));
			way += lengths_.back();
		}
		perimeter_ = way;
	}

	double edge_length(std::size_t edge) const { return lengths_[edge]; }

	// Weights of a cubic curve through the hull's points in the length along the hull at rest, continuously differentiable and
	// exact on straight lines however the points are spaced (Catmull and Rom 1974). Its tangents are the chords between the
	// neighbors: those of parabolas would let a short edge that turns swing the long one beside it.
	void add_curve(HullPlace at, std::vector<double> &r_weights) const {
		const std::size_t i = at.edge;
		const std::size_t j = next(i);
		const double t = at.t;
		const double rise = t * t * (3 - 2 * t);
		r_weights[i] += 1 - rise;
		r_weights[j] += rise;
		add_tangent(i, lengths_[i] * t * (1 - t) * (1 - t), r_weights);
		add_tangent(j, -lengths_[i] * t * t * (1 - t), r_weights);
	}

	// Adds weights of sum zero that move a place by `arm`, and by the image of `arm` under any affine map of the hull.
	// The map is the one that fits the points around best: x -> (sum w x X^T)(sum w X X^T)^-1, with X and x from their mean.
	void add_arm(HullPlace at, Vec2d arm, std::vector<double> &r_weights) const {
		const double way = ways_[at.edge] + at.t * lengths_[at.edge];
		const double reach = REACH_IN_EDGES * perimeter_ / double(count_);
		std::vector<double> shares(count_);
		double sum = 0;
		Vec2d mean;
		for (std::size_t i = 0; i < count_; ++i) {
			double distance = std::abs(ways_[i] - way);
			distance = std::min(distance, perimeter_ - distance) / reach;
			const double fall = 1 / (1 + distance * distance);
			shares[i] = fall * fall + LEAST_SHARE;
			sum += shares[i];
			mean += hull_[i] * shares[i];
		}
		mean = mean * (1 / sum);
		double xx = 0, xy = 0, yy = 0;
		for (std::size_t i = 0; i < count_; ++i) {
			const Vec2d from_mean = hull_[i] - mean;
			xx += shares[i] * from_mean.x * from_mean.x;
			xy += shares[i] * from_mean.x * from_mean.y;
			yy += shares[i] * from_mean.y * from_mean.y;
		}
		const double determinant = xx * yy - xy * xy; // > 0, as a hull of an area has points off any line
		const Vec2d solved{ (yy * arm.x - xy * arm.y) / determinant, (xx * arm.y - xy * arm.x) / determinant };
		for (std::size_t i = 0; i < count_; ++i) {
			r_weights[i] += shares[i] * dot(solved, hull_[i] - mean);
		}
	}

	Vec2d sum_of(const std::vector<double> &p_weights) const {
		Vec2d sum;
		for (std::size_t i = 0; i < count_; ++i) {
			sum += hull_[i] * p_weights[i];
		}
		return sum;
	}

private:
	std::size_t next(std::size_t i) const { return i + 1 < count_ ? i + 1 : 0; }

	void add_tangent(std::size_t i, double factor, std::vector<double> &r_weights) const {
		const std::size_t before = i > 0 ? i - 1 : count_ - 1;
		const double slope = factor / (lengths_[before] + lengths_[i]);
		r_weights[before] -= slope;
		r_weights[next(i)] += slope;
	}

	std::size_t count_;
	std::vector<Vec2d> hull_;
	std::vector<double> lengths_; ///< of the edge after each point
	std::vector<double> ways_; ///< along the hull to each point
	double perimeter_ = 0;
};

// The place of the hull for every point of the outline. Lengths along the outline are carried to lengths along the hull by a
// monotone cubic through the places that hull points stand for (Fritsch and Butland 1984: the slope at a place is the harmonic mean of
// those beside it). So no place of the hull is skipped or passed twice, and there is no jump in how fast the places follow one another.
std::vector<HullPlace> places_on_hull(std::span<const Vec2> outline, std::span<const double> places, const Binder &binder) {
	const std::size_t count = places.size();
	const std::size_t drawn = outline.size();
	std::vector<double> ways{ 0 }; // along the outline to each point
	for (std::size_t i = 0; i < drawn; ++i) {
		ways.push_back(ways.back() + distance_between(Vec2d(outline[i]), Vec2d(outline[(i + 1) % drawn])));
	}
	const auto way_to = [&](double place) {
		const std::size_t i = std::size_t(place);
		return ways[i] + (ways[i + 1] - ways[i]) * (place - double(i));
	};
	std::vector<double> starts; // along the outline to the place of each hull point, rising
	for (std::size_t i = 0; i <= count; ++i) {
		const double way = i < count ? way_to(places[i]) : starts[0] + ways.back();
		starts.push_back(i > 0 && way < starts.back() ? way + ways.back() : way);
	}
	const auto slope = [&](std::size_t edge) { // of the hull's length over the outline's
		return binder.edge_length(edge) / std::max(starts[edge + 1] - starts[edge], 1e-12 * ways.back());
	};
	std::vector<HullPlace> on_hull(drawn);
	for (std::size_t edge = 0; edge < count; ++edge) {
		const double own = slope(edge);
		const double before = slope(edge > 0 ? edge - 1 : count - 1);
		const double after = slope(edge + 1 < count ? edge + 1 : 0);
		// Slopes at the ends over the own one.
		const double first = 2 * before / (before + own);
		const double last = 2 * after / (after + own);
		const double end = edge + 1 < count ? places[edge + 1] : places[0];
		const double next = end > places[edge] ? end : end + double(drawn);
		for (double k = std::ceil(places[edge]); k < next; k += 1) {
			const std::size_t index = std::size_t(k) % drawn;
			const double way = ways[index] < starts[edge] ? ways[index] + ways.back() : ways[index];
			const double x = std::clamp((way - starts[edge]) / (starts[edge + 1] - starts[edge]), 0.0, 1.0);
			const double t = x * x * (3 - 2 * x) + first * x * (1 - x) * (1 - x) - last * x * x * (1 - x);
			on_hull[index] = { edge, std::clamp(t, 0.0, 1.0) };
		}
	}
	return on_hull;
}

} // namespace

OutlineBinding::OutlineBinding(std::span<const Vec2> outline, std::span<const Vec2> hull, std::span<const double> places) :
		outline_(outline.begin(), outline.end()), hull_(hull.begin(), hull.end()), places_(places.begin(), places.end()) {
	assert(hull.size() >= 3 && places.size() == hull.size());
	const Binder binder(hull);
	const std::vector<HullPlace> on_hull = places_on_hull(outline, places, binder);
	weights_.reserve(outline.size() * hull.size());
	std::vector<double> weights;
	for (std::size_t i = 0; i < outline.size(); ++i) {
		weights.assign(hull.size(), 0.0);
		binder.add_curve(on_hull[i], weights);
		binder.add_arm(on_hull[i], Vec2d(outline[i]) - binder.sum_of(weights), weights);
		for (const double weight : weights) {
			weights_.push_back(Real(weight));
		}
	}
}

bool OutlineBinding::is_made_of(std::span<const Vec2> outline, std::span<const Vec2> hull, std::span<const double> places) const {
	return std::ranges::equal(outline, outline_) && std::ranges::equal(hull, hull_) && std::ranges::equal(places, places_);
}

void OutlineBinding::place(std::span<const Vec2> hull, std::span<Vec2> outline) const {
	assert(hull.size() >= hull_.size() && outline.size() >= outline_.size());
	const Real *weight = weights_.data();
	for (std::size_t i = 0; i < outline_.size(); ++i) {
		Vec2 sum;
		for (std::size_t j = 0; j < hull_.size(); ++j) {
			sum += hull[j] * *weight++;
		}
		outline[i] = sum;
	}
}

// The normal equations W^T W x = W^T d, by Cholesky's factors. Weights sum to 1 and each hull point has most of the weight of the
// drawn points beside it, so the matrix is positive definite, and well conditioned; the little that is added to its diagonal
// decides only for a hull point that no drawn point follows.
void OutlineBinding::fit(std::span<const Vec2> outline, std::span<Vec2> hull) const {
	constexpr double LEAST_WEIGHT = 1e-9;
	const std::size_t count = hull_.size();
	std::vector<double> matrix(count * count, 0.0);
	std::vector<Vec2d> right(count);
	const auto at = [&](std::size_t row, std::size_t column) -> double & { return matrix[row * count + column]; };
	for (std::size_t k = 0; k < outline_.size(); ++k) {
		const std::span<const Real> weights = weights_of(k);
		for (std::size_t i = 0; i < count; ++i) {
			right[i] += Vec2d(outline[k]) * double(weights[i]);
			for (std::size_t j = 0; j <= i; ++j) {
				at(i, j) += double(weights[i]) * double(weights[j]);
			}
		}
	}
	for (std::size_t i = 0; i < count; ++i) {
		at(i, i) += LEAST_WEIGHT;
		right[i] += Vec2d(hull_[i]) * LEAST_WEIGHT;
		for (std::size_t j = 0; j <= i; ++j) {
			double sum = at(i, j);
			for (std::size_t k = 0; k < j; ++k) {
				sum -= at(i, k) * at(j, k);
			}
			at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
		}
	}
	for (std::size_t i = 0; i < count; ++i) {
		for (std::size_t k = 0; k < i; ++k) {
			right[i] -= right[k] * at(i, k);
		}
		right[i] *= 1 / at(i, i);
	}
	for (std::size_t i = count; i-- > 0;) {
		for (std::size_t k = i + 1; k < count; ++k) {
			right[i] -= right[k] * at(k, i);
		}
		right[i] *= 1 / at(i, i);
		hull[i] = Vec2(right[i]);
	}
}

} // namespace softbody
