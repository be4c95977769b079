// SPDX-License-Identifier: MIT
// Changes of detail while a body moves: how far its drawn outline jumps, what its momentum loses, and how long a change takes.
#include "bench.h"
#include "detail_scenes.h"

#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "core/skin/outline_binding.h"

#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Real;
using softbody::Vec2;

constexpr int TICKS = 90; // of a throw, during which the body lands and bounces
constexpr int TICKS_A_SWITCH = 6;
constexpr int FLYERS = 200;

// A hull that stands for an outline, with what follows it.
struct Level {
	std::string name;
	Points hull;
	ElasticBody body;
	softbody::OutlineBinding binding; // empty for the outline itself
	bool is_outline = false;

	Points drawn(std::span<const Vec2> values, std::size_t count) const {
		if (is_outline) {
			return Points(values.begin(), values.begin() + std::ptrdiff_t(count));
		}
		Points outline(count);
		binding.place(values.first(hull.size()), outline);
		return outline;
	}
	Points fitted(const Points &outline) const {
		if (is_outline) {
			return outline;
		}
		Points points(hull.size());
		binding.fit(outline, points);
		return points;
	}
};

Level level_of(std::string name, const Points &outline, double tolerance, int most_points, bool is_outline) {
	const bool has_deep_dents = softbody::has_deep_dents(outline);
	Level level;
	level.name = std::move(name);
	level.is_outline = is_outline;
	level.hull = outline;
	if (!is_outline) {
		const softbody::SimplifiedOutline made = simplified(outline, tolerance, most_points);
		level.hull = made.hull;
		level.binding = softbody::OutlineBinding(outline, made.hull, made.places);
	}
	level.body = outline_body(level.hull, has_deep_dents, !is_outline);
	return level;
}

struct Momentum {
	Vec2 linear;
	double angular = 0; // about the center of mass
};

Momentum momentum_of(const softbody::SoftBodyData &body) {
	const softbody::BodyFrame frame = softbody::measure_frame(body);
	return { frame.velocity * body.shape().total_mass(), double(frame.angular_velocity) * double(frame.inertia) };
}

// As a node does it: the hull nearest to what was drawn, then velocity and spin of the old body.
softbody::SoftBodyData switched(const softbody::SoftBodyData &old, const Level &from, const Level &to, std::size_t count) {
	const Points positions = to.fitted(from.drawn(old.positions(), count));
	const Points velocities = to.fitted(from.drawn(old.velocities(), count));
	softbody::SoftBodyData body = take(softbody::SoftBodyData::create(to.body.shape, to.body.settings));
	place_points(body, positions, velocities);
	const softbody::BodyFrame frame = softbody::measure_frame(old);
	check(softbody::set_linear_velocity(body, frame.velocity));
	check(softbody::set_angular_velocity(body, frame.angular_velocity));
	return body;
}

json measure_switch(const OutlineKind &kind, const Level &from, const Level &to) {
	softbody::WorldData world = weighty_world();
	softbody::Border floor;
	floor.plane = { { 0, 0 }, { 0, -1 } };
	check(world.add_border(floor));
	softbody::Pose pose;
	pose.position = { 0, -200 };
	const softbody::BodyId id = world.add_soft_body(take(softbody::SoftBodyData::create(from.body.shape, from.body.settings, pose)));
	check(softbody::set_linear_velocity(*world.find(id), { 200, 0 }));
	check(softbody::set_angular_velocity(*world.find(id), 3));
	softbody::Simulator simulator(world);
	const double radius = softbody::radius_of_area(kind.outline);
	const std::size_t count = kind.outline.size();
	double jump = 0;
	double linear_error = 0;
	double angular_error = 0;
	std::vector<Duration> times;
	for (int tick = 1; tick <= TICKS; ++tick) {
		simulator.simulate(Real(TICK));
		if (tick % TICKS_A_SWITCH != 0) {
			continue;
		}
		const softbody::SoftBodyData &old = *world.find(id);
		const Stopwatch watch;
		const softbody::SoftBodyData body = switched(old, from, to, count);
		times.push_back(watch.elapsed());
		const Points before = from.drawn(old.positions(), count);
		const Points after = to.drawn(body.positions(), count);
		for (std::size_t i = 0; i < count; ++i) {
			jump = std::max(jump, double(length(after[i] - before[i])));
		}
		const Momentum was = momentum_of(old);
		const Momentum is = momentum_of(body);
		const double mass = double(old.shape().total_mass());
		// Against that of a speed of 100 px/s and of a spin of 1 rad/s at least: near rest a share of nothing says nothing.
		linear_error = std::max(linear_error, double(length(is.linear - was.linear)) / std::max(double(length(was.linear)), 100 * mass));
		angular_error = std::max(angular_error, std::abs(is.angular - was.angular) / std::max(std::abs(was.angular), mass * radius * radius / 2));
	}
	return { { "outline", kind.name }, { "by", "a script" }, { "from", from.name }, { "to", to.name }, { "points_from", from.hull.size() }, { "points_to", to.hull.size() },
		{ "outline_error_percent", 100 * outline_distance(kind.outline, to.hull) / radius }, { "jump_px", jump },
		{ "linear_momentum_error", linear_error }, { "angular_momentum_error", angular_error }, { "switch_us", times_of(times).cpu.median * 1e6 } };
}

// Bodies in the air that wobble, each in its own way, until all of them fly.
struct Flyers {
	softbody::WorldData world = weighty_world();

	Flyers(const Level &level, int count) {
		softbody::testing::Random random(17);
		softbody::Border floor;
		floor.plane = { { 0, 1e6 }, { 0, -1 } };
		check(world.add_border(floor));
		for (int i = 0; i < count; ++i) {
			softbody::Pose pose;
			pose.position = { Real(300 * i), 0 };
			softbody::SoftBodyData body = take(softbody::SoftBodyData::create(level.body.shape, level.body.settings, pose));
			check(softbody::set_linear_velocity(body, random.vector(300)));
			check(softbody::set_angular_velocity(body, random.real(-1, 1)));
			for (std::uint32_t k = 0; k < body.point_count(); ++k) { // squashed by up to a tenth
				const Vec2 rest = body.shape().rest_positions()[k];
				check(body.set_point(k, body.positions()[k] + Vec2{ rest.x, -rest.y } * Real(0.02 + 0.08 * i / count), body.velocities()[k]));
			}
			world.add_soft_body(std::move(body));
		}
	}
};

// From soft to rigid in flight, which the core does by itself. A body that leaves flight goes on from where it is: nothing is changed then.
json measure_flight(const OutlineKind &kind, const Level &level, int count) {
	Flyers flyers(level, count);
	softbody::WorldData world = flyers.world;
	softbody::Simulator simulator(world);
	const std::size_t drawn = kind.outline.size();
	double jump = 0;
	double linear_error = 0;
	double angular_error = 0;
	double soft_us = 0;
	double rigid_us = 0;
	std::vector<double> switch_us;
	std::vector<char> flew(std::size_t(count), 0);
	int entered = 0;
	for (int tick = 0; tick < 4 * TICKS && entered < count; ++tick) {
		softbody::WorldData soft = world;
		world.set_rigid_flight(true);
		soft.set_rigid_flight(false);
		const Stopwatch rigid_watch;
		const std::size_t flying = simulator.simulate(Real(TICK)).flying_bodies;
		const double with_us = rigid_watch.elapsed().cpu * 1e6 / count;
		softbody::Simulator without(soft);
		softbody::WorldData warm = soft; // the first step of a simulator lists its bodies
		softbody::Simulator arranged(warm);
		arranged.simulate(Real(TICK));
		const Stopwatch soft_watch;
		arranged.simulate(Real(TICK));
		const double without_us = soft_watch.elapsed().cpu * 1e6 / count;
		without.simulate(Real(TICK));
		if (flying == 0 && tick > 2) {
			switch_us.push_back(std::max(0.0, with_us - without_us)); // what it costs to look
			soft_us = without_us;
		}
		if (flying == std::size_t(count)) {
			rigid_us = with_us;
		}
		for (std::size_t i = 0; i < flew.size(); ++i) {
			if (flew[i] != 0 || !simulator.has_flown(world.id_at(i))) {
				continue;
			}
			flew[i] = 1;
			++entered;
			const Points a = level.drawn(world.soft_bodies()[i].positions(), drawn);
			const Points b = level.drawn(soft.soft_bodies()[i].positions(), drawn);
			for (std::size_t k = 0; k < drawn; ++k) {
				jump = std::max(jump, double(length(a[k] - b[k])));
			}
			const Momentum is = momentum_of(world.soft_bodies()[i]);
			const Momentum same = momentum_of(soft.soft_bodies()[i]);
			const double mass = double(level.body.shape->total_mass());
			const double radius = softbody::radius_of_area(kind.outline);
			linear_error = std::max(linear_error, double(length(is.linear - same.linear)) / std::max(double(length(same.linear)), 100 * mass));
			angular_error = std::max(angular_error, std::abs(is.angular - same.angular) / std::max(std::abs(same.angular), mass * radius * radius / 2));
		}
	}
	std::sort(switch_us.begin(), switch_us.end());
	return { { "outline", kind.name }, { "by", "the core" }, { "from", level.name }, { "to", "rigid flight" }, { "points_from", level.hull.size() },
		{ "points_to", level.hull.size() }, { "outline_error_percent", 100 * outline_distance(kind.outline, level.hull) / softbody::radius_of_area(kind.outline) },
		{ "jump_px", jump }, { "linear_momentum_error", linear_error }, { "angular_momentum_error", angular_error },
		{ "switch_us", switch_us.empty() ? 0.0 : switch_us[switch_us.size() / 2] }, { "bodies", count }, { "entered", entered }, { "soft_us", soft_us },
		{ "rigid_us", rigid_us } };
}

} // namespace

json detail_levels(const Options &options) {
	json rows = json::array();
	for (const OutlineKind &kind : fine_outlines(options.quick)) {
		const Level drawn = level_of("as drawn", kind.outline, 0, 0, true);
		const Level automatic = level_of("automatic", kind.outline, DETAIL_TOLERANCE, 0, false);
		const int points = int(automatic.hull.size());
		const Level half = level_of("half", kind.outline, DETAIL_TOLERANCE, points / 2, false);
		const Level quarter = level_of("quarter", kind.outline, DETAIL_TOLERANCE, std::max(4, points / 4), false);
		rows.push_back(measure_flight(kind, automatic, options.quick ? 64 : FLYERS));
		rows.push_back(measure_switch(kind, drawn, automatic));
		rows.push_back(measure_switch(kind, automatic, drawn));
		rows.push_back(measure_switch(kind, automatic, half));
		rows.push_back(measure_switch(kind, automatic, quarter));
		rows.push_back(measure_switch(kind, half, automatic));
		rows.push_back(measure_switch(kind, quarter, automatic));
	}
	return rows;
}

} // namespace bench
