// SPDX-License-Identifier: MIT
// Whether points that are added where a body bends, while it bends, pay: against a body of 128 points, and against finer tolerances.
#include "bench.h"
#include "detail_scenes.h"

#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "core/skin/outline_binding.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Real;
using softbody::Vec2;

constexpr int REFERENCE_POINTS = 128;
constexpr double STAMP_WIDTH = 24; // px, of a stamp that is pressed into the middle of a body
constexpr double STAMP_SPEED = 100; // px/s
constexpr double PRESSED = 0.35; // of the body's height that the stamp goes down
constexpr double SETTLE = 1; // s before and after
constexpr int TIMED_TICKS = 120; // under the stamp
constexpr double SHARP_TURN = 0.35; // rad by which the hull turns more at a point than at rest, from which on points are added there
constexpr float FINER = 4; // times as fine there
constexpr double NEAR = 0.5; // of the radius, around such a point

struct Simulated {
	Points points;
	ElasticBody body;
	softbody::OutlineBinding binding;
	bool is_outline = false;

	Points drawn(std::span<const Vec2> values, std::size_t count) const {
		if (is_outline) {
			return Points(values.begin(), values.begin() + std::ptrdiff_t(count));
		}
		Points outline(count);
		binding.place(values.first(points.size()), outline);
		return outline;
	}
};

Simulated hull_of(const Points &outline, double tolerance, std::vector<float> weights = {}) {
	softbody::SimplifyOptions options;
	options.tolerance = tolerance;
	options.weights = std::move(weights);
	const softbody::SimplifiedOutline made = softbody::simplify_outline(outline, options).value();
	Simulated hull;
	hull.points = made.hull;
	hull.is_outline = made.is_outline;
	if (!made.is_outline) {
		hull.binding = softbody::OutlineBinding(outline, made.hull, made.places);
	}
	hull.body = outline_body(made.hull, softbody::has_deep_dents(outline), !made.is_outline);
	return hull;
}

// A body on a floor, and a stamp above it.
class Press {
public:
	Press(const Points &outline, const ElasticBody &body) : simulator_(world_) {
		softbody::Border floor;
		floor.plane = { { 0, 0 }, { 0, -1 } };
		check(world_.add_border(floor));
		Real lowest = 0;
		Real highest = 0;
		for (const Vec2 p : outline) {
			lowest = std::max(lowest, p.y);
			highest = std::min(highest, p.y);
		}
		height_ = double(lowest - highest);
		softbody::Pose pose;
		pose.position = { 0, -lowest };
		id_ = world_.add_soft_body(take(softbody::SoftBodyData::create(body.shape, body.settings, pose)));
		softbody::RigidBody stamp;
		stamp.pose.position = { 0, -Real(height_) - 5 };
		rigid_ = take(world_.add_rigid_body(stamp));
		softbody::Collider box;
		box.vertices = { { Real(-STAMP_WIDTH / 2), -300 }, { Real(STAMP_WIDTH / 2), -300 }, { Real(STAMP_WIDTH / 2), 0 }, { Real(-STAMP_WIDTH / 2), 0 } };
		box.rigid_body = rigid_;
		check(world_.add_collider(box));
	}

	// One tick of the program: rest, down, hold.
	void step() {
		const double begin = SETTLE;
		const double end = begin + (PRESSED * height_ + 5) / STAMP_SPEED;
		softbody::RigidBody stamp = world_.rigid_bodies()[rigid_];
		const double time = tick_ * TICK;
		stamp.linear_velocity = { 0, time >= begin && time < end ? Real(STAMP_SPEED) : Real(0) };
		check(world_.set_rigid_body(rigid_, stamp));
		simulator_.simulate(Real(TICK));
		++tick_;
	}
	int ticks_down() const { return int((2 * SETTLE + (PRESSED * height_ + 5) / STAMP_SPEED) / TICK); }

	softbody::SoftBodyData &body() { return *world_.find(id_); }
	void replace(softbody::SoftBodyData other) { world_.replace_soft_body(id_, std::move(other)); }

private:
	softbody::WorldData world_ = weighty_world();
	softbody::Simulator simulator_;
	softbody::BodyId id_;
	std::uint32_t rigid_ = 0;
	double height_ = 0;
	int tick_ = 0;
};

struct Pressed {
	Points drawn;
	double us = 0; // a tick under the stamp, changes of the hull included
	double switch_ms = 0; // all of them
	int switches = 0;
	std::size_t points = 0;
};

std::vector<double> turns(std::span<const Vec2> hull) {
	std::vector<double> all;
	const std::size_t count = hull.size();
	for (std::size_t i = 0; i < count; ++i) {
		const Vec2 in = hull[i] - hull[(i + count - 1) % count];
		const Vec2 out = hull[(i + 1) % count] - hull[i];
		all.push_back(std::atan2(double(cross(in, out)), double(dot(in, out))));
	}
	return all;
}

// The weights of the outline with those near sharply bent points of the hull finer; empty if there are none.
std::vector<float> weights_where_bent(const Points &outline, const Simulated &hull, std::span<const Vec2> now) {
	const std::vector<double> rest = turns(hull.points);
	const std::vector<double> bent = turns(now.first(hull.points.size()));
	const double reach = NEAR * softbody::radius_of_area(outline);
	std::vector<float> weights;
	for (std::size_t i = 0; i < rest.size(); ++i) {
		if (std::abs(bent[i] - rest[i]) < SHARP_TURN) {
			continue;
		}
		weights.resize(outline.size(), 1);
		for (std::size_t k = 0; k < outline.size(); ++k) {
			if (double(length(outline[k] - hull.points[i])) < reach) {
				weights[k] = FINER;
			}
		}
	}
	return weights;
}

Pressed press(const Points &outline, Simulated hull, bool refines) {
	Press scene(outline, hull.body);
	Pressed result;
	const int down = scene.ticks_down();
	std::vector<float> weights;
	double seconds = 0;
	for (int tick = 0; tick < down + TIMED_TICKS; ++tick) {
		const Stopwatch watch;
		scene.step();
		if (refines && tick % 6 == 0) { // a body that bends more and more would change in every tick
			const std::vector<float> wanted = weights_where_bent(outline, hull, scene.body().hull());
			if (!wanted.empty() && wanted != weights && weights.empty()) {
				const Stopwatch switching;
				const softbody::SoftBodyData &old = scene.body();
				Simulated finer = hull_of(outline, DETAIL_TOLERANCE, wanted);
				const Points places = hull.drawn(old.positions(), outline.size());
				const Points speeds = hull.drawn(old.velocities(), outline.size());
				Points fitted(finer.points.size());
				Points fitted_speeds(finer.points.size());
				finer.binding.fit(places, fitted);
				finer.binding.fit(speeds, fitted_speeds);
				softbody::SoftBodyData body = take(softbody::SoftBodyData::create(finer.body.shape, finer.body.settings));
				place_points(body, fitted, fitted_speeds);
				scene.replace(std::move(body));
				hull = std::move(finer);
				weights = wanted;
				++result.switches;
				result.switch_ms += switching.elapsed().cpu * 1e3;
			}
		}
		seconds += tick >= down ? watch.elapsed().cpu : 0;
	}
	result.us = seconds * 1e6 / TIMED_TICKS;
	result.points = hull.points.size();
	result.drawn = hull.drawn(scene.body().positions(), outline.size());
	return result;
}

double error_against(const Points &reference, Points drawn, double radius) {
	const Vec2 shift = softbody::area_centroid(reference) - softbody::area_centroid(drawn);
	for (Vec2 &p : drawn) {
		p = p + Vec2{ shift.x, 0 };
	}
	return 100 * outline_distance(reference, drawn) / radius;
}

} // namespace

json detail_refinement(const Options &options) {
	json rows = json::array();
	for (const OutlineKind &kind : fine_outlines(options.quick)) {
		const double radius = softbody::radius_of_area(kind.outline);
		Simulated reference;
		reference.points = spaced(kind.outline, REFERENCE_POINTS);
		reference.is_outline = true;
		reference.body = outline_body(reference.points, softbody::has_deep_dents(kind.outline));
		Press scene(kind.outline, reference.body);
		double seconds = 0;
		for (int tick = 0; tick < scene.ticks_down() + TIMED_TICKS; ++tick) {
			const Stopwatch watch;
			scene.step();
			seconds += tick >= scene.ticks_down() ? watch.elapsed().cpu : 0;
		}
		const Points full(scene.body().hull().begin(), scene.body().hull().end());
		rows.push_back({ { "outline", kind.name }, { "way", "128 points" }, { "points", REFERENCE_POINTS }, { "error_percent", 0.0 },
				{ "us", seconds * 1e6 / TIMED_TICKS }, { "switches", 0 }, { "switch_ms", 0.0 } });
		const auto add = [&](const char *way, double tolerance, bool refines) {
			const Pressed made = press(kind.outline, hull_of(kind.outline, tolerance), refines);
			rows.push_back({ { "outline", kind.name }, { "way", way }, { "points", made.points }, { "error_percent", error_against(full, made.drawn, radius) },
					{ "us", made.us }, { "switches", made.switches }, { "switch_ms", made.switch_ms } });
		};
		add("3 %", DETAIL_TOLERANCE, false);
		add("3 %, finer where bent", DETAIL_TOLERANCE, true);
		add("1 %", 0.01, false);
		add("0.5 %", 0.005, false);
		add("0.2 %", 0.002, false);
	}
	return rows;
}

} // namespace bench
