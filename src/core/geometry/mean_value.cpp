// SPDX-License-Identifier: MIT
// Carries values given at the corners of a polygon to any place inside it.
#include "core/geometry/mean_value.h"

#include <cmath>
#include <cstddef>

namespace softbody {

std::vector<double> mean_value_weights(std::span<const Vec2> polygon, Vec2 place) {
	const std::size_t count = polygon.size();
	std::vector<double> weights(count, 0.0);
	std::vector<Vec2d> arms(count);
	std::vector<double> reaches(count);
	for (std::size_t i = 0; i < count; ++i) {
		arms[i] = difference(polygon[i], place);
		reaches[i] = std::sqrt(dot(arms[i], arms[i]));
		if (reaches[i] == 0) {
			weights[i] = 1;
			return weights;
		}
	}
	// Half of the tangent of the angle at which an edge is seen is (r r' - dot) / cross.
	double sum = 0;
	for (std::size_t i = 0; i < count; ++i) {
		const std::size_t j = i + 1 < count ? i + 1 : 0;
		const double twice_area = cross(arms[i], arms[j]);
		const double along = dot(arms[i], arms[j]);
		if (std::abs(twice_area) <= 1e-12 * reaches[i] * reaches[j]) {
			if (along < 0) { // on this edge
				weights.assign(count, 0.0);
				weights[i] = reaches[j] / (reaches[i] + reaches[j]);
				weights[j] = 1 - weights[i];
				return weights;
			}
			continue; // in line with the edge, which is seen at no angle
		}
		const double half_tangent = (reaches[i] * reaches[j] - along) / twice_area;
		weights[i] += half_tangent / reaches[i];
		weights[j] += half_tangent / reaches[j];
		sum += half_tangent / reaches[i] + half_tangent / reaches[j];
	}
	for (double &weight : weights) {
		weight /= sum;
	}
	return weights;
}

} // namespace softbody
