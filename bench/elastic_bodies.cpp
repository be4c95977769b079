// SPDX-License-Identifier: MIT
// Bodies of an elastic material under every model that can stand for it.
#include "elastic_bodies.h"

#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/geometry/polygon.h"
#include "scenes/jelly.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bench {

namespace {

using softbody::ElasticModel;
using softbody::Real;
using softbody::Vec2;

// The node's default before there were materials, per spring.
constexpr double OLD_STIFFNESS = 100; // N/m
constexpr double OLD_DAMPING = 0.12; // N s/m
constexpr double OLD_SHAPE_MATCHING = 0.4; // of the springs' stiffness
constexpr double OLD_SHAPE_DAMPING_RATIO = 0.25;
constexpr double LITTLE_DAMPING = 0.02; // a material's ratio up to which the old network has none at all

const ModelChoice CHOICES[] = {
	{ "springs", ElasticModel::SPRINGS },
	{ "springs_and_shape", ElasticModel::SPRINGS_AND_SHAPE },
	{ "springs_shape_and_area", ElasticModel::SPRINGS_SHAPE_AND_AREA },
	{ "modes", ElasticModel::MODES },
	{ "triangles", ElasticModel::TRIANGLES, 1.5 },
	{ "triangles, dense", ElasticModel::TRIANGLES, 4 },
	{ "network (old default)", ElasticModel::SPRINGS_AND_SHAPE, 0, true },
};

ElasticBody old_network(const Points &hull, double mass, bool damped) {
	softbody::StructureOptions options;
	options.mass = Real(mass);
	options.stiffness = Real(OLD_STIFFNESS);
	options.damping = damped ? Real(OLD_DAMPING) : Real(0);
	ElasticBody body{ take(softbody::SoftBodyCreator::create_polygon(hull, options)), {} };
	const double stiffness = OLD_SHAPE_MATCHING * OLD_STIFFNESS;
	body.settings.shape_stiffness = Real(stiffness);
	const double point_mass = mass / double(body.shape->point_count());
	body.settings.shape_damping = damped ? Real(2 * OLD_SHAPE_DAMPING_RATIO * std::sqrt(stiffness * point_mass)) : Real(0);
	return body;
}

ElasticBody of_material(const ModelChoice &choice, const Points &hull, double mass, const softbody::Material &material, bool balanced) {
	const ElasticModel model = choice.model;
	softbody::StructureOptions options;
	options.mass = Real(mass);
	options.stiffness = 1; // the material says how much of each the body has
	options.damping = 1;
	options.balanced_mass = balanced;
	options.elastic = model != ElasticModel::TRIANGLES;
	options.elastic_triangles = model == ElasticModel::TRIANGLES;
	options.triangle_points = int(choice.inner_points * double(hull.size()));
	ElasticBody body{ take(softbody::SoftBodyCreator::create_polygon(hull, options)), {} };
	check(apply_material(material, model, *body.shape, body.settings));
	return body;
}

} // namespace

std::span<const ModelChoice> elastic_models() {
	return CHOICES;
}

const ModelChoice &default_model() {
	return *std::find_if(std::begin(CHOICES), std::end(CHOICES), [](const ModelChoice &c) { return c.model == ElasticModel::MODES; });
}

ElasticBody elastic_body(const ModelChoice &choice, const Points &hull, double mass, const softbody::Material &material, bool balanced) {
	ElasticBody body = choice.is_old_network ? old_network(hull, mass, double(material.damping_ratio) > LITTLE_DAMPING)
											 : of_material(choice, hull, mass, material, balanced);
	softbody::testing::set_default_limits(body.settings);
	body.settings.friction = 0;
	body.settings.can_sleep = false;
	return body;
}

Points circle(double radius, int count, bool on_edge) {
	Points points = take(softbody::circle_hull(Real(radius), count));
	const auto turn = softbody::Rotation::from_angle(on_edge ? Real(std::numbers::pi / count) : Real(0));
	for (Vec2 &p : points) {
		p = turn.apply(p);
	}
	return points;
}

Points divided(const Points &corners, int count) {
	std::vector<double> lengths;
	for (std::size_t i = 0; i < corners.size(); ++i) {
		lengths.push_back(double(length(corners[(i + 1) % corners.size()] - corners[i])));
	}
	std::vector<int> pieces(corners.size(), 1);
	for (std::size_t made = corners.size(); made < std::size_t(count); ++made) {
		std::size_t longest = 0;
		for (std::size_t i = 1; i < corners.size(); ++i) {
			if (lengths[i] / pieces[i] > lengths[longest] / pieces[longest] * (1 + 1e-6)) { // ties: the first
				longest = i;
			}
		}
		++pieces[longest];
	}
	Points points;
	for (std::size_t i = 0; i < corners.size(); ++i) {
		const Vec2 side = corners[(i + 1) % corners.size()] - corners[i];
		for (int k = 0; k < pieces[i]; ++k) {
			points.push_back(corners[i] + side * (Real(k) / Real(pieces[i])));
		}
	}
	return points;
}

Points spaced(const Points &outline, int count) {
	const double piece = double(softbody::perimeter(outline)) / count;
	Points points;
	double begin = 0; // of the present side, along the outline
	for (std::size_t i = 0; i < outline.size(); ++i) {
		const Vec2 side = outline[(i + 1) % outline.size()] - outline[i];
		const double end = begin + double(length(side));
		while (int(points.size()) < count && (double(points.size()) + 0.5) * piece <= end) {
			const double along = ((double(points.size()) + 0.5) * piece - begin) / (end - begin);
			points.push_back(outline[i] + side * Real(along));
		}
		begin = end;
	}
	return points;
}

} // namespace bench
