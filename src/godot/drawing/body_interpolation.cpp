// SPDX-License-Identifier: MIT
// Places a body between two physics ticks.
#include "godot/drawing/body_interpolation.h"

#include "godot/convert.h"

using namespace godot;

namespace softbody {

namespace {

// Global to local, weighted. The origin is subtracted before any multiplication: far from the world's origin the
// translation of an inverse would lose significant digits.
struct WeightedInverse {
	Vec2 origin;
	Vec2 x_row;
	Vec2 y_row;

	WeightedInverse(const Transform2D &p_transform, double p_weight) : origin(to_core(p_transform.get_origin())) {
		const Transform2D inverse = p_transform.affine_inverse();
		const Real weight = Real(p_weight);
		x_row = Vec2{ Real(inverse.columns[0].x), Real(inverse.columns[1].x) } * weight;
		y_row = Vec2{ Real(inverse.columns[0].y), Real(inverse.columns[1].y) } * weight;
	}
	Vec2 apply(Vec2 p_point) const {
		const Vec2 arm = p_point - origin;
		return { dot(x_row, arm), dot(y_row, arm) };
	}
};

} // namespace

void BodyInterpolation::begin(const Transform2D &before) {
	is_moving_ = true;
	start_ = before;
	points_start_ = before;
}

void BodyInterpolation::carry(const Transform2D &from, const Transform2D &to, bool is_engines) {
	const Transform2D way = to * from.affine_inverse();
	points_start_ = way * points_start_;
	if (!is_engines) {
		start_ = way * start_;
	}
}

Transform2D BodyInterpolation::frame(const Transform2D &now, double fraction) const {
	if (!is_moving_ || fraction >= 1) {
		return now;
	}
	return fraction <= 0 ? start_ : start_.interpolate_with(now, real_t(fraction));
}

void BodyInterpolation::local_points(const Transform2D &now, double fraction, std::span<const Vec2> before,
		std::span<const Vec2> after, std::span<Vec2> local) const {
	const WeightedInverse end(now, is_moving_ ? fraction : 1);
	if (!is_moving_ || fraction >= 1) {
		for (std::size_t i = 0; i < after.size(); ++i) {
			local[i] = end.apply(after[i]);
		}
		return;
	}
	const WeightedInverse start(points_start_, 1 - fraction);
	for (std::size_t i = 0; i < after.size(); ++i) {
		local[i] = start.apply(before[i]) + end.apply(after[i]);
	}
}

} // namespace softbody
