// SPDX-License-Identifier: MIT
// A crowd of mixed bodies, a tenth of which is tossed about near the player: what less detail saves there.
#include "bench.h"
#include "detail_scenes.h"

#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/rigid_motion.h"
#include "scenes/fine_outlines.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Real;
using softbody::Vec2;

constexpr int BODIES = 3000;
constexpr int QUICK_BODIES = 300;
constexpr double SPACING = 150; // px
// Near: a tenth of the bodies lies in pits, and every third of them is tossed up in turn.
constexpr int PIT_COLUMNS = 10;
constexpr int PIT_BODIES = 30;
constexpr int TICKS_A_TOSS = 20;
constexpr double TOSS = 700; // px/s
// Far: two thirds lie on shelves, a third drifts without weight.
constexpr int SHELF_BODIES = 30;
constexpr double SHELF_HEIGHT = 400; // px
constexpr double DRIFT = 15; // px/s
constexpr double DRIFT_SPACING = 220; // px
constexpr double SETTLE = 4; // s before a tick counts; less, and nothing sleeps yet
constexpr double MEASURED = 0.7; // s

// How a crowd is simulated.
struct Way {
	std::string name;
	bool is_automatic = false; // the fewest points within the tolerance, instead of the points as drawn
	double share = 1; // of those points
	bool flies = false; // rigid flight
};

std::vector<OutlineKind> crowd_outlines() {
	softbody::testing::Random random(7);
	std::vector<OutlineKind> all = fine_outlines(false);
	all.push_back({ "character 100", softbody::testing::character_outline(100) });
	for (const int count : { 16, 32, 64, 128 }) {
		all.push_back({ "circle " + std::to_string(count), softbody::circle_hull(50, count).value() });
		all.push_back({ "blob " + std::to_string(count), softbody::testing::random_blob(count, random) });
	}
	for (OutlineKind &kind : all) {
		const Vec2 middle = softbody::area_centroid(kind.outline);
		for (Vec2 &p : kind.outline) {
			p = p - middle;
		}
	}
	return all;
}

struct CrowdKind {
	ElasticBody body;
	double error = 0; // of the outline [px]
	double radius = 0;
	std::size_t points = 0;
};

CrowdKind crowd_kind(const OutlineKind &kind, const Way &way) {
	Points hull = kind.outline;
	if (way.is_automatic && hull.size() > 16) { // a node simulates so few as they are drawn
		hull = simplified(kind.outline, DETAIL_TOLERANCE).hull;
		if (way.share < 1) {
			hull = simplified(kind.outline, DETAIL_TOLERANCE, std::max(4, int(way.share * double(hull.size())))).hull;
		}
	}
	CrowdKind made;
	made.radius = softbody::radius_of_area(kind.outline);
	made.error = hull.size() == kind.outline.size() ? 0 : outline_distance(kind.outline, hull);
	made.points = hull.size();
	made.body = outline_body(hull, softbody::has_deep_dents(kind.outline));
	return made;
}

void add_box(softbody::WorldData &world, Vec2 from, Vec2 to) {
	softbody::Collider box;
	box.vertices = { from, { to.x, from.y }, to, { from.x, to.y } };
	check(world.add_collider(box));
}

// A crowd and the scene that it lies in.
class Crowd {
public:
	Crowd(std::span<const CrowdKind> kinds, int bodies, bool may_sleep, bool flies) : simulator_(world_) {
		softbody::testing::Random random(3);
		const int near = bodies / 10;
		const int drifting = (bodies - near) / 3;
		world_.set_sleeping(may_sleep);
		world_.set_rigid_flight(flies);
		for (int pit = 0; pit * PIT_BODIES < near; ++pit) {
			const Real left = Real(pit * (PIT_COLUMNS + 2) * SPACING);
			const Real right = left + Real(PIT_COLUMNS * SPACING);
			add_box(world_, { left - 100, 0 }, { right + 100, 100 });
			add_box(world_, { left - 100, -4000 }, { left, 0 });
			add_box(world_, { right, -4000 }, { right + 100, 0 });
			for (int i = 0; i < PIT_BODIES && pit * PIT_BODIES + i < near; ++i) {
				near_.push_back(add(kinds, left + Real((i % PIT_COLUMNS + 0.5) * SPACING), Real(-SPACING * (0.6 + i / PIT_COLUMNS)), random));
			}
		}
		for (int i = 0; i < bodies - near - drifting; ++i) {
			const Vec2 shelf{ 0, Real(1000 + i / SHELF_BODIES * SHELF_HEIGHT) };
			if (i % SHELF_BODIES == 0) {
				add_box(world_, shelf, shelf + Vec2{ Real(SHELF_BODIES * SPACING), 20 });
			}
			add(kinds, Real((i % SHELF_BODIES + 0.5) * SPACING), shelf.y - 75, random);
		}
		for (int i = 0; i < drifting; ++i) {
			const softbody::BodyId id = add(kinds, Real(-i % 30 * DRIFT_SPACING - 2000), Real(i / 30 * DRIFT_SPACING), random);
			softbody::SoftBodyData &body = *world_.find(id);
			softbody::BodySettings settings = body.settings();
			settings.gravity_scale = 0;
			check(body.set_settings(settings));
			check(softbody::set_linear_velocity(body, { random.real(-DRIFT, DRIFT), Real(random.real(-DRIFT, DRIFT)) }));
			check(softbody::set_angular_velocity(body, random.real(-0.5, 0.5)));
		}
	}

	std::size_t step() {
		if (tick_ % TICKS_A_TOSS == 0) {
			for (std::size_t i = std::size_t(tick_ / TICKS_A_TOSS % 3); i < near_.size(); i += 3) {
				softbody::SoftBodyData &body = *world_.find(near_[i]);
				check(softbody::set_linear_velocity(body, { Real(i % 2 == 0 ? 100 : -100), Real(-TOSS) }));
				check(softbody::set_angular_velocity(body, Real(i % 2 == 0 ? 3 : -3)));
			}
		}
		++tick_;
		return simulator_.simulate(Real(TICK)).flying_bodies;
	}

private:
	softbody::BodyId add(std::span<const CrowdKind> kinds, Real x, Real y, softbody::testing::Random &random) {
		const CrowdKind &kind = kinds[count_++ % kinds.size()];
		softbody::BodySettings settings = kind.body.settings;
		settings.can_sleep = true;
		softbody::Pose pose;
		pose.position = { x, y };
		pose.rotation = softbody::Rotation::from_angle(random.real(-3, 3));
		return world_.add_soft_body(take(softbody::SoftBodyData::create(kind.body.shape, settings, pose)));
	}

	softbody::WorldData world_ = weighty_world();
	softbody::Simulator simulator_;
	std::vector<softbody::BodyId> near_;
	std::size_t count_ = 0;
	int tick_ = 0;
};

// A crowd of one way, while it is measured.
struct Measured {
	std::vector<CrowdKind> kinds;
	double error = 0; // of the worst outline, of its radius
	double points = 0; // a body
	std::unique_ptr<Crowd> crowd;
	double flying = 0;
	std::vector<Duration> times;
};

// All ways in turn, tick by tick: what else runs on the machine then takes its share of all of them.
std::vector<Measured> measure_crowds(std::span<const Way> ways, bool may_sleep, const Options &options) {
	const int bodies = options.quick ? QUICK_BODIES : BODIES;
	std::vector<Measured> all(ways.size());
	for (std::size_t i = 0; i < ways.size(); ++i) {
		for (const OutlineKind &kind : crowd_outlines()) {
			all[i].kinds.push_back(crowd_kind(kind, ways[i]));
			all[i].error = std::max(all[i].error, all[i].kinds.back().error / all[i].kinds.back().radius);
			all[i].points += double(all[i].kinds.back().points);
		}
		all[i].points /= double(all[i].kinds.size());
		all[i].crowd = std::make_unique<Crowd>(all[i].kinds, bodies, may_sleep, ways[i].flies);
	}
	const int settle = int(SETTLE / TICK);
	const int measured = int(MEASURED / TICK);
	for (int tick = 0; tick < settle + measured; ++tick) {
		for (Measured &each : all) {
			const Stopwatch watch;
			const std::size_t flying = each.crowd->step();
			if (tick >= settle) {
				each.times.push_back(watch.elapsed());
				each.flying += double(flying) / measured;
			}
		}
	}
	return all;
}

} // namespace

json detail_crowd(const Options &options) {
	const std::vector<Way> ways = { { "as drawn" }, { "automatic", true }, { "automatic, rigid flight", true, 1, true }, { "half the points", true, 0.5 },
		{ "a quarter", true, 0.25 } };
	json rows = json::array();
	for (const bool may_sleep : { true, false }) {
		const std::vector<Measured> all = measure_crowds(ways, may_sleep, options);
		const double as_drawn = times_of(all[0].times).cpu.median;
		for (std::size_t i = 0; i < ways.size(); ++i) {
			const double time = times_of(all[i].times).cpu.median;
			rows.push_back({ { "way", ways[i].name }, { "sleep", may_sleep }, { "bodies", options.quick ? QUICK_BODIES : BODIES },
					{ "points_a_body", all[i].points }, { "outline_error_percent", 100 * all[i].error }, { "flying", all[i].flying },
					{ "tick_ms", time * 1e3 }, { "speedup", as_drawn / time } });
		}
	}
	return rows;
}

} // namespace bench
