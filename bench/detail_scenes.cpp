// SPDX-License-Identifier: MIT
// Outlines of many points and the bodies that stand for them, for the parts of the bench `detail`.
#include "detail_scenes.h"

#include "core/creator/hulls.h"
#include "core/geometry/circle.h"
#include "core/geometry/polygon.h"
#include "scenes/fine_outlines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bench {

namespace {

using softbody::Real;
using softbody::Vec2;

constexpr double MASS = 1; // kg

} // namespace

std::vector<OutlineKind> fine_outlines(bool is_quick) {
	softbody::testing::Random random(23);
	std::vector<OutlineKind> all = { { "character", softbody::testing::character_outline(200) } };
	if (!is_quick) {
		all.push_back({ "circle", softbody::circle_hull(50, 200).value() });
		all.push_back({ "blob", softbody::testing::random_blob(200, random) });
		all.push_back({ "traced blob", softbody::testing::noisy_blob(300, random) });
	}
	for (OutlineKind &kind : all) {
		const Vec2 middle = softbody::area_centroid(kind.outline);
		for (Vec2 &p : kind.outline) {
			p = p - middle;
		}
	}
	return all;
}

ElasticBody outline_body(const Points &hull, bool has_deep_dents, bool balanced) {
	ElasticBody body = elastic_body(default_model(), hull, MASS, softbody::Material(), balanced);
	body.settings.friction = Real(0.4);
	body.settings.rolling_resistance = Real(0.03);
	body.settings.linear_damp = Real(0.1);
	body.settings.angular_damp = 1;
	body.settings.collision_mask = 1;
	body.settings.self_collision = has_deep_dents;
	return body;
}

softbody::SimplifiedOutline simplified(const Points &outline, double tolerance, int most_points) {
	softbody::SimplifyOptions options;
	options.tolerance = tolerance;
	options.most_points = most_points;
	if (most_points > 0) {
		options.fewest_points = std::min(options.fewest_points, most_points);
	}
	return softbody::simplify_outline(outline, options).value();
}

double outline_distance(const Points &a, const Points &b) {
	double most = 0;
	for (const auto &[from, to] : { std::pair(&a, &b), std::pair(&b, &a) }) {
		for (std::size_t i = 0; i < from->size(); ++i) {
			const Vec2 next = (*from)[(i + 1) % from->size()];
			for (int k = 0; k < 8; ++k) {
				const Vec2 place = (*from)[i] + (next - (*from)[i]) * (Real(k) / 8);
				most = std::max(most, std::sqrt(double(softbody::nearest_place(*to, place).distance_squared)));
			}
		}
	}
	return most;
}

void place_points(softbody::SoftBodyData &body, const Points &positions, const Points &velocities) {
	for (std::size_t i = 0; i < positions.size(); ++i) {
		check(body.set_point(std::uint32_t(i), positions[i], velocities[i]));
	}
	if (body.point_count() == positions.size() + 1) {
		check(body.set_point(std::uint32_t(positions.size()), softbody::mean_of(positions), softbody::mean_of(velocities)));
	}
}

softbody::WorldData weighty_world() {
	softbody::WorldData world;
	check(world.set_length_unit(Real(PIXELS_A_METER)));
	check(world.set_gravity({ 0, Real(DETAIL_GRAVITY) }));
	return world;
}

} // namespace bench
