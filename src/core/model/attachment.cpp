// SPDX-License-Identifier: MIT
// Carries a place in or near a body along with its points.
#include "core/model/attachment.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// At a point its weight 1/d⁴ is infinite, and the other points no longer count. In double: it overflows float.
std::vector<double> weights_at(std::span<const Vec2> points, Vec2 place) {
	double farthest = 0;
	for (const Vec2 point : points) {
		farthest = std::max(farthest, double(length_squared(point - place)));
	}
	const double least = std::max(farthest * 1e-12, 1e-100);
	std::vector<double> weights;
	double sum = 0;
	for (const Vec2 point : points) {
		const double distance_squared = std::max(least, double(length_squared(point - place)));
		weights.push_back(1 / (distance_squared * distance_squared));
		sum += weights.back();
	}
	for (double &weight : weights) {
		weight /= sum;
	}
	return weights;
}

} // namespace

Result<Attachment> Attachment::create(std::span<const Vec2> rest_positions, Vec2 place) {
	if (rest_positions.empty()) {
		return Error{ "rest_positions", "0 points", "must be at least 1", "attach to a body that has points" };
	}
	if (Status status = first_error({ check_all_finite("rest_positions", rest_positions), check_finite("place", place) })) {
		return *status;
	}
	const std::vector<double> weights = weights_at(rest_positions, place);
	BasicVec2<double> center;
	for (std::size_t i = 0; i < weights.size(); ++i) {
		center.x += weights[i] * double(rest_positions[i].x);
		center.y += weights[i] * double(rest_positions[i].y);
	}
	Attachment attachment;
	for (std::size_t i = 0; i < weights.size(); ++i) {
		attachment.weights_.push_back(Real(weights[i]));
		attachment.arms_.push_back({ Real(weights[i] * (double(rest_positions[i].x) - center.x)),
			Real(weights[i] * (double(rest_positions[i].y) - center.y)) });
	}
	attachment.arm_ = { Real(double(place.x) - center.x), Real(double(place.y) - center.y) };
	return attachment;
}

Pose Attachment::follow(std::span<const Vec2> positions, Rotation otherwise) const {
	// Relative to one of the points: far from the origin the sums would lose digits.
	const Vec2 origin = positions[0];
	Vec2 center;
	for (std::size_t i = 0; i < weights_.size(); ++i) {
		center += (positions[i] - origin) * weights_[i];
	}
	Real along = 0;
	Real across = 0;
	for (std::size_t i = 0; i < weights_.size(); ++i) {
		const Vec2 arm = positions[i] - origin - center;
		along += dot(arms_[i], arm);
		across += cross(arms_[i], arm);
	}
	const Real size = std::sqrt(along * along + across * across);
	const Rotation rotation = size > 0 && std::isfinite(size) ? Rotation{ along / size, across / size } : otherwise;
	return { origin + center + rotation.apply(arm_), rotation };
}

} // namespace softbody
