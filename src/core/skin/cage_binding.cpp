// SPDX-License-Identifier: MIT
// Carries points in and around an outline along with it.
#include "core/skin/cage_binding.h"

#include <cmath>

namespace softbody {

namespace {

// Of a place that is nearer to an edge than this part of the distances to its ends, the weights are those of the edge.
constexpr double ON_EDGE = 1e-9;

struct Arm {
	double x;
	double y;
	double length;
};

// The weights of one place. A weight is (tan(a/2) + tan(b/2)) / r, with r the distance to its point and a, b the angles to the points before
// and after; tan(a/2) = (r r' - s · s') / (s × s') needs no function of angles.
void find_weights(std::span<const Vec2> outline, Vec2 place, std::vector<Arm> &arms, std::vector<double> &weights) {
	const std::size_t count = outline.size();
	weights.assign(count, 0);
	for (std::size_t i = 0; i < count; ++i) {
		const double x = double(outline[i].x) - double(place.x);
		const double y = double(outline[i].y) - double(place.y);
		arms[i] = { x, y, std::sqrt(x * x + y * y) };
		if (arms[i].length == 0) {
			weights[i] = 1;
			return;
		}
	}
	double sum = 0;
	for (std::size_t i = 0; i < count; ++i) {
		const std::size_t next = (i + 1) % count;
		const Arm &a = arms[i];
		const Arm &b = arms[next];
		const double area = a.x * b.y - a.y * b.x;
		const double along = a.x * b.x + a.y * b.y;
		const double size = a.length * b.length;
		if (std::abs(area) <= ON_EDGE * size) {
			if (along < 0) { // between both ends
				weights.assign(count, 0);
				weights[i] = b.length / (a.length + b.length);
				weights[next] = a.length / (a.length + b.length);
				return;
			}
			continue; // in line with the edge: no angle
		}
		const double tangent = along > 0 ? area / (size + along) : (size - along) / area; // the same, without a difference of like numbers
		weights[i] += tangent / a.length;
		weights[next] += tangent / b.length;
		sum += tangent / a.length + tangent / b.length;
	}
	for (double &weight : weights) {
		weight /= sum;
	}
}

} // namespace

CageBinding::CageBinding(std::span<const Vec2> outline, std::span<const Vec2> points) : outline_count_(outline.size()) {
	std::vector<Arm> arms(outline.size());
	std::vector<double> weights;
	weights_.reserve(points.size() * outline.size());
	for (const Vec2 place : points) {
		find_weights(outline, place, arms, weights);
		for (const double weight : weights) {
			weights_.push_back(Real(weight));
		}
	}
}

void CageBinding::place(std::span<const Vec2> outline, std::span<Vec2> points) const {
	for (std::size_t i = 0; i < points.size(); ++i) {
		const std::span<const Real> weights = weights_of(i);
		double x = 0;
		double y = 0;
		for (std::size_t k = 0; k < weights.size(); ++k) {
			x += double(weights[k]) * double(outline[k].x);
			y += double(weights[k]) * double(outline[k].y);
		}
		points[i] = { Real(x), Real(y) };
	}
}

} // namespace softbody
