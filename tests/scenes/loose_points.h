// SPDX-License-Identifier: MIT
// Bodies that are hardly bodies: points without springs, or with a single one, whose motion has a formula.
#pragma once

#include "core/model/soft_body_data.h"

#include <vector>

namespace softbody::testing {

/// `count` hull points on a unit circle at rest, each of the given mass, joined by nothing but the
/// given springs. Without springs every point is a particle of its own; place them with `set_point`.
inline SoftBodyData loose_points(std::size_t count, Real mass, std::vector<Spring2D> springs = {}, const BodySettings &settings = {}) {
	SoftBodyShape::Description description;
	for (std::size_t i = 0; i < count; ++i) {
		const Rotation turn = Rotation::from_angle(Real(6.283185307179586 * double(i) / double(count)));
		description.points.push_back({ turn.c, turn.s });
	}
	description.masses.assign(count, mass);
	description.hull_count = count;
	description.springs = std::move(springs);
	return SoftBodyData::create(SoftBodyShape::create(std::move(description)).value(), settings).value();
}

/// Two points of equal mass joined by one spring along x, at rest at (0, 0) and (rest_length, 0). The
/// third point that a hull needs is free, far away and joined to nothing.
inline SoftBodyData two_masses(Real mass, Real rest_length, Real stiffness, Real damping, const BodySettings &settings = {}) {
	SoftBodyData body = loose_points(3, mass, { { 0, 1, rest_length, stiffness, damping } }, settings);
	body.set_point(0, { 0, 0 }, {});
	body.set_point(1, { rest_length, 0 }, {});
	body.set_point(2, { 0, 50 * rest_length }, {});
	return body;
}

/// How much longer the spring of `two_masses` is than at rest [length].
inline double stretch(const SoftBodyData &body) {
	const Vec2 d = body.positions()[1] - body.positions()[0];
	return double(length(d)) - double(body.shape().springs()[0].rest_length);
}

} // namespace softbody::testing
