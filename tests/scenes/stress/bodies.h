// SPDX-License-Identifier: MIT
// Bodies and measures that stress scenes share, in pixels with y down.
#pragma once

#include "core/collision/environment_contact_solver.h"
#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/energy.h"
#include "core/geometry/polygon.h"
#include "thesis/polygon_overlap.h"
#include "core/model/body_frame.h"
#include "core/model/material.h"
#include "scenes/deformations.h"
#include "scenes/jelly.h"
#include "scenes/stress/stress.h"
#include "thesis/damping_ratio.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace softbody::testing {

/// What a body of a stress scene is made of.
struct Stuff {
	Real mass = 1;
	Real stiffness = 100; ///< k of every spring [N/m]
	Real matching = DEFAULT_SHAPE_MATCHING; ///< over k
	Real damping_ratio = Real(0.1);
	bool center_point = true;
};

/// k that carries `load` [kg] under Godot's gravity by the sizing rule of the README, k n R / (8 m g) = 4: about a
/// twentieth of its area is lost.
inline Real carrying_stiffness(Real load, std::size_t hull_points, Real radius) {
	return 4 * 8 * load * PIXEL_GRAVITY / (Real(hull_points) * radius);
}

inline BodySettings stress_settings(const StressSetup &setup, const Stuff &stuff, std::size_t point_count) {
	BodySettings settings;
	settings.integrator = setup.integrator;
	settings.shape_stiffness = stuff.matching * stuff.stiffness;
	settings.shape_damping = 2 * Real(0.25) * std::sqrt(settings.shape_stiffness * stuff.mass / Real(point_count));
	settings.rolling_resistance = Real(0.03);
	set_default_limits(settings); // as in a game
	return settings;
}

inline SoftBodyData stress_body(const std::vector<Vec2> &hull, Vec2 place, const StressSetup &setup, const Stuff &stuff = {},
		Real angle = 0) {
	const std::size_t points = hull.size() + stuff.center_point;
	const Real damping = damping_for_ratio(stuff.damping_ratio, stuff.stiffness, stuff.mass, points);
	StructureOptions options{ stuff.mass, stuff.stiffness, damping, stuff.center_point };
	options.elastic = setup.elastic;
	const auto shape = SoftBodyCreator::create_polygon(hull, options).value();
	BodySettings settings = stress_settings(setup, stuff, points);
	if (setup.elastic) {
		// A wheel of springs of 100 N/m is about as firm as the default material.
		Material material;
		material.youngs_modulus *= stuff.stiffness / 100;
		apply_material(material, ElasticModel::MODES, *shape, settings);
		settings.self_collision = has_deep_dents(hull); // as a node chooses
	}
	return SoftBodyData::create(shape, settings, { place, Rotation::from_angle(angle) }).value();
}

inline SoftBodyData stress_ball(Vec2 place, const StressSetup &setup, const Stuff &stuff = {}, Real radius = JELLY_RADIUS,
		int hull_points = JELLY_HULL_POINTS) {
	return stress_body(circle_hull(radius, hull_points).value(), place, setup, stuff, Real(0.1));
}

inline void set_velocity(SoftBodyData &body, Vec2 velocity) {
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], velocity);
	}
}

inline WorldData weightless_world() {
	WorldData world = pixel_world();
	world.set_gravity({ 0, 0 });
	return world;
}

/// Over the rest area, signed: negative when turned inside out.
inline double area_share(const SoftBodyData &body) {
	return double(signed_area(body.hull())) / double(body.shape().rest_area());
}

inline double least_area_share(const WorldData &world) {
	double least = 1e30;
	for (const SoftBodyData &body : world.soft_bodies()) {
		least = std::min(least, area_share(body));
	}
	return least;
}

/// Of the worst point of the worst body, over its radius.
inline double worst_deviation(const WorldData &world) {
	double worst = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		worst = std::max(worst, deviation_from_rest(body) / double(body.shape().radius()));
	}
	return worst;
}

/// Of the deepest pair, over the smaller radius.
inline double worst_overlap(const WorldData &world) {
	double worst = 0;
	const auto bodies = world.soft_bodies();
	for (std::size_t i = 0; i < bodies.size(); ++i) {
		const Aabb box = bounding_box(bodies[i].hull());
		for (std::size_t j = 0; j < i; ++j) {
			if (box.overlaps(bounding_box(bodies[j].hull()))) {
				const double radius = std::min(bodies[i].shape().radius(), bodies[j].shape().radius());
				worst = std::max(worst, penetration_depth(bodies[i].hull(), bodies[j].hull()) / radius);
			}
		}
	}
	return worst;
}

/// In the surroundings as they are now, over the body's radius.
inline double worst_penetration(const WorldData &world) {
	double worst = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		worst = std::max(worst, double(measure_penetration(world, body)) / double(body.shape().radius()));
	}
	return worst;
}

/// Of the mean motion [px/s].
inline double worst_speed(const WorldData &world) {
	double worst = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		worst = std::max(worst, double(length(measure_frame(body).velocity)));
	}
	return worst;
}

/// The same without what bodies do sideways, as when they roll on a floor.
inline double worst_vertical_speed(const WorldData &world) {
	double worst = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		worst = std::max(worst, std::abs(double(measure_frame(body).velocity.y)));
	}
	return worst;
}

/// A twentieth of R: what one begins to see.
inline constexpr double VISIBLE = 0.05;

/// A closed box of borders around [-half.x, half.x] × [-half.y, half.y].
inline void add_box_borders(WorldData &world, Vec2 half) {
	world.add_border({ { { 0, half.y }, { 0, -1 } }, {} });
	world.add_border({ { { 0, -half.y }, { 0, 1 } }, {} });
	world.add_border({ { { -half.x, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { half.x, 0 }, { -1, 0 } }, {} });
}

} // namespace softbody::testing
