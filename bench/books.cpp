// SPDX-License-Identifier: MIT
// Contacts against the books: scenes whose energy, height or way theory knows, in pixels and at the node's old default body.
#include "bench.h"
#include "bodies.h"

#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/integrator_facts.h"
#include "scenes/jelly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::BodySettings;
using softbody::Integrator;
using softbody::Real;
using softbody::SoftBodyData;
using softbody::Vec2;
using softbody::WorldData;

constexpr double RADIUS = 50; // px
constexpr double PIXELS_A_METER = 100;
constexpr double GRAVITY = 980; // px/s²
constexpr double DEGREE = std::numbers::pi / 180;

WorldData world_of(Vec2 gravity) {
	WorldData world;
	check(world.set_length_unit(Real(PIXELS_A_METER)));
	check(world.set_gravity(gravity));
	return world;
}

softbody::Border wall(Vec2 at, Vec2 normal, double restitution = 0) {
	softbody::Border border;
	border.plane = { at, normal };
	border.surface.restitution = Real(restitution);
	return border;
}

struct Disc {
	double stiffness = 100;
	double damping = 1; ///< of the default body's
	int points = 16;
	double restitution = 0;
	double friction = 0;
	double rolling_resistance = 0;
	Integrator integrator = Integrator::AUTOMATIC;
	double angle = 0;
};

// Springs to a center point and shape matching of 0.4 k, with the damping ratios of the node's first default.
SoftBodyData disc(const Disc &of, Vec2 center, Vec2 velocity = {}) {
	softbody::StructureOptions options;
	options.stiffness = Real(of.stiffness);
	options.damping = Real(0.012 * std::sqrt(of.stiffness) * of.damping);
	const Shape shape = take(softbody::testing::circle_shape(Real(RADIUS), of.points, options));
	BodySettings settings;
	set_shape_matching(settings, *shape, 0.4 * of.stiffness);
	settings.shape_damping *= Real(of.damping);
	settings.restitution = Real(of.restitution);
	settings.friction = Real(of.friction);
	settings.rolling_resistance = Real(of.rolling_resistance);
	settings.integrator = of.integrator;
	const softbody::Pose pose{ center, softbody::Rotation::from_angle(Real(of.angle)) };
	SoftBodyData body = take(SoftBodyData::create(shape, settings, pose));
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		check(body.set_point(i, body.positions()[i], velocity));
	}
	return body;
}

double energy_of(const WorldData &world) {
	double energy = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		energy += softbody::measure_energy(body, world.gravity()).total();
	}
	return energy;
}

Vec2 center_of(const SoftBodyData &body) {
	return softbody::measure_frame(body).center;
}

struct Account {
	double highest = 1; ///< share of the first energy
	double end = 1;
	double least = 1;
};

// The energy above `lowest`, as a share of that at the start.
Account run_account(WorldData &world, double seconds, int rate, double lowest = 0) {
	softbody::Simulator simulator(world);
	const double first = energy_of(world) - lowest;
	Account account;
	for (int i = 0; i < int(seconds * rate); ++i) {
		simulator.simulate(Real(1) / Real(rate));
		account.end = (energy_of(world) - lowest) / first;
		account.highest = std::max(account.highest, account.end);
		account.least = std::min(account.least, account.end);
		if (!(account.end < 1e6)) {
			break;
		}
	}
	return account;
}

json row_of(const char *scene, const Account &account) {
	return { { "scene", scene }, { "energy_highest", account.highest }, { "energy_end", account.end } };
}

// 50 bodies at 300 px/s in all directions between four walls; nothing is damped.
json closed_box(double stiffness, Integrator integrator, double seconds, int seed, int count = 50) {
	WorldData world = world_of({});
	world.set_sleeping(false);
	const double width = count == 1 ? 160 : 1600;
	const double height = count == 1 ? 160 : 900;
	check(world.add_border(wall({ 0, 0 }, { 1, 0 })));
	check(world.add_border(wall({ Real(width), 0 }, { -1, 0 })));
	check(world.add_border(wall({ 0, 0 }, { 0, 1 })));
	check(world.add_border(wall({ 0, Real(height) }, { 0, -1 })));
	Random random{ std::uint64_t(seed) };
	for (int i = 0; i < count; ++i) {
		const double angle = random.uniform(0, 2 * std::numbers::pi);
		const Vec2 at = count == 1 ? Vec2{ 80, 80 } : Vec2{ Real(80 + 155 * (i % 10)), Real(90 + 170 * (i / 10)) };
		Disc of;
		of.stiffness = stiffness;
		of.damping = 0;
		of.restitution = 1;
		of.integrator = integrator;
		world.add_soft_body(disc(of, at, Vec2{ Real(std::cos(angle)), Real(std::sin(angle)) } * Real(300)));
	}
	json row = row_of(count == 1 ? "one_in_a_box" : "closed_box", run_account(world, seconds, 60));
	row.update({ { "k", stiffness }, { "integrator", softbody::integrator_facts(integrator).name }, { "seed", seed } });
	return row;
}

// Two bodies meet, the second `offset` to the side of the first's path.
json two_meet(double stiffness, double offset, double speed, Integrator integrator = Integrator::AUTOMATIC) {
	WorldData world = world_of({});
	world.set_sleeping(false);
	for (int i = 0; i < 2; ++i) {
		Disc of;
		of.stiffness = stiffness;
		of.damping = 0;
		of.restitution = 1;
		of.integrator = integrator;
		world.add_soft_body(disc(of, { Real(i * 200), Real(i * offset) }, { Real(i == 0 ? speed : 0), 0 }));
	}
	json row = row_of("two_meet", run_account(world, 3, 60));
	const Vec2 parting = softbody::measure_frame(world.soft_bodies()[1]).velocity - softbody::measure_frame(world.soft_bodies()[0]).velocity;
	row.update({ { "k", stiffness }, { "offset", offset }, { "speed", speed }, { "parting", double(length(parting)) / speed } });
	return row;
}

json row_of_five(double stiffness, double gap) {
	WorldData world = world_of({});
	world.set_sleeping(false);
	for (int i = 0; i < 5; ++i) {
		Disc of;
		of.stiffness = stiffness;
		of.damping = 0;
		of.restitution = 1;
		world.add_soft_body(disc(of, { Real(i * (2 * RADIUS + gap) - (i == 0 ? 100 : 0)), 0 }, { i == 0 ? Real(300) : Real(0), 0 }));
	}
	json row = row_of("row_of_five", run_account(world, 3, 60));
	row.update({ { "k", stiffness }, { "gap", gap }, { "last_speed", softbody::measure_frame(world.soft_bodies()[4]).velocity.x } });
	return row;
}

// Each body hangs from its own rod, held at its center.
json cradle(double stiffness, double gap) {
	WorldData world = world_of({ 0, Real(GRAVITY) });
	world.set_sleeping(false);
	constexpr double ROD = 400;
	double lowest = 0;
	for (int i = 0; i < 5; ++i) {
		Disc of;
		of.stiffness = stiffness;
		of.damping = 0;
		of.restitution = 1;
		const Vec2 hook{ Real(i * (2 * RADIUS + gap)), 0 };
		const double angle = i == 0 ? 45 * DEGREE : 0;
		const Vec2 at = hook + Vec2{ Real(-ROD * std::sin(angle)), Real(ROD * std::cos(angle)) };
		const softbody::BodyId id = world.add_soft_body(disc(of, at));
		softbody::Joint joint;
		joint.first = softbody::JointAnchor::at_place(hook);
		joint.second = softbody::JointAnchor::on_point(id, 16);
		joint.rest_length = Real(ROD);
		if (const auto added = world.add_joint(joint); !added) {
			throw std::runtime_error(added.error().message());
		}
		lowest -= GRAVITY * ROD;
	}
	json row = row_of("cradle", run_account(world, 10, 60, lowest));
	row.update({ { "k", stiffness }, { "gap", gap } });
	return row;
}

// The height to which a body rises again that fell by 300 px.
double rise(const Disc &of, int rate, double drop = 300) {
	WorldData world = world_of({ 0, Real(GRAVITY) });
	world.set_sleeping(false);
	check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
	const double rest = RADIUS * (of.angle == 0 ? 1 : std::cos(std::numbers::pi / of.points));
	world.add_soft_body(disc(of, { 0, Real(-rest - drop) }));
	softbody::Simulator simulator(world);
	bool has_hit = false;
	double highest = 0;
	for (int i = 0; i < 3 * rate; ++i) {
		simulator.simulate(Real(1) / Real(rate));
		const softbody::BodyFrame frame = softbody::measure_frame(world.soft_bodies()[0]);
		has_hit |= double(frame.center.y) > -rest - 1;
		if (has_hit && frame.velocity.y < 0) {
			highest = std::max(highest, -double(frame.center.y) - rest);
		} else if (has_hit && highest > 0 && frame.velocity.y > 0) {
			break;
		}
	}
	return highest;
}

json method_bounces() {
	json rows = json::array();
	for (const double stiffness : { 1e4, 4e4 }) {
		for (const int rate : { 60, 120 }) {
			for (const double restitution : { 0.0, 0.5, 0.8 }) {
				Disc of;
				of.stiffness = stiffness;
				of.restitution = restitution;
				of.integrator = Integrator::SEMI_IMPLICIT_EULER;
				const double euler = rise(of, rate);
				of.integrator = Integrator::XPBD;
				const double xpbd = rise(of, rate);
				rows.push_back({ { "scene", "method_bounce" }, { "k", stiffness }, { "rate", rate }, { "restitution", restitution },
						{ "euler", euler }, { "xpbd", xpbd }, { "theory", 300 * restitution * restitution },
						{ "gap_percent", 100 * std::abs(euler - xpbd) / std::max(euler, xpbd) } });
			}
		}
	}
	return rows;
}

// Height of the center at rest on the floor [px].
double rest_height(const Disc &of, int rate) {
	WorldData world = world_of({ 0, Real(GRAVITY) });
	world.set_sleeping(false);
	check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
	world.add_soft_body(disc(of, { 0, Real(-RADIUS) }));
	softbody::Simulator simulator(world);
	for (int i = 0; i < 6 * rate; ++i) {
		simulator.simulate(Real(1) / Real(rate));
	}
	return -double(center_of(world.soft_bodies()[0]).y);
}

// Period of the wobble of a disc that was stretched by a tenth, floating free: the mean time between changes of sign, interpolated [s].
double wobble_period(const Disc &of, int rate) {
	WorldData world = world_of({});
	world.set_sleeping(false);
	SoftBodyData stretched = disc(of, {});
	for (std::uint32_t i = 0; i < stretched.point_count(); ++i) {
		const Vec2 p = stretched.positions()[i];
		check(stretched.set_point(i, { p.x * Real(1.1), p.y / Real(1.1) }, {}));
	}
	world.add_soft_body(std::move(stretched));
	softbody::Simulator simulator(world);
	const auto stretch = [&] {
		double sum = 0;
		for (const Vec2 p : world.soft_bodies()[0].hull()) {
			sum += double(p.x) * p.x - double(p.y) * p.y;
		}
		return sum;
	};
	double before = stretch();
	double first = 0;
	double last = 0;
	int count = 0;
	for (int i = 0; i < rate * 4 && count < 9; ++i) {
		simulator.simulate(Real(1) / Real(rate));
		const double now = stretch();
		if ((before > 0) != (now > 0)) {
			last = (i + before / (before - now)) / rate;
			first = count == 0 ? last : first;
			count += 1;
		}
		before = now;
	}
	return count > 1 ? 2 * (last - first) / (count - 1) : 0;
}

// The same body by both families of methods that the automatic choice takes, at rest and wobbling.
json methods_alike() {
	json rows = json::array();
	// At rates that see the wobble: a period has three ticks or more.
	for (const auto &[stiffness, rate] : { std::pair(100.0, 60), { 1e3, 60 }, { 1e3, 240 }, { 1e4, 240 } }) {
		Disc of;
		of.stiffness = stiffness;
		of.angle = std::numbers::pi / of.points;
		Disc other = of;
		of.integrator = Integrator::SEMI_IMPLICIT_EULER;
		other.integrator = Integrator::XPBD;
		const double heights[] = { rest_height(of, rate), rest_height(other, rate) };
		rows.push_back({ { "scene", "method_rest" }, { "k", stiffness }, { "rate", rate }, { "euler", heights[0] }, { "xpbd", heights[1] },
				{ "gap_percent", 100 * std::abs(heights[0] - heights[1]) / RADIUS } });
		const double periods[] = { wobble_period(of, rate), wobble_period(other, rate) };
		rows.push_back({ { "scene", "method_wobble" }, { "k", stiffness }, { "rate", rate }, { "euler", periods[0] }, { "xpbd", periods[1] },
				{ "gap_percent", 100 * std::abs(periods[0] / periods[1] - 1) } });
	}
	return rows;
}

json tick_bounces() {
	json rows = json::array();
	for (const double stiffness : { 100.0, 1000.0, 1e4, 4e4 }) {
		for (const double restitution : { 0.0, 0.8, 1.0 }) {
			json row = { { "scene", "tick_bounce" }, { "k", stiffness }, { "restitution", restitution }, { "heights", json::array() } };
			double least = 1e30;
			double most = 0;
			for (const int rate : { 30, 60, 120, 240 }) {
				Disc of;
				of.stiffness = stiffness;
				of.restitution = restitution;
				const double height = rise(of, rate);
				least = std::min(least, height);
				most = std::max(most, height);
				row["heights"].push_back(height);
			}
			row["gap_percent"] = 100 * (most - least) / most;
			row["theory"] = 300 * restitution * restitution;
			rows.push_back(row);
		}
	}
	return rows;
}

// Twelve bodies fall into a corner, once upright and once with the whole scene turned. Apart by what, after a second?
json turned_scene(double degrees, double seconds, Vec2 offset = {}) {
	std::vector<std::vector<Vec2>> ends;
	const auto run = [&](softbody::Rotation turn, Vec2 shift) {
		WorldData world = world_of(turn.apply({ 0, Real(GRAVITY) }));
		world.set_sleeping(false);
		const auto place = [&](Vec2 p) { return turn.apply(p) + shift; };
		check(world.add_border(wall(place({ 0, 0 }), turn.apply({ 0, -1 }))));
		check(world.add_border(wall(place({ -200, 0 }), turn.apply({ 1, 0 }))));
		Random random(3);
		for (int i = 0; i < 12; ++i) {
			Disc of;
			of.friction = 0.4;
			of.restitution = 0.3;
			const Vec2 at{ Real(-140 + 110 * (i % 3) + random.uniform(-3, 3)), Real(-80 - 110 * (i / 3)) };
			SoftBodyData body = disc(of, {}, {});
			for (std::uint32_t k = 0; k < body.point_count(); ++k) {
				check(body.set_point(k, place(body.positions()[k] + at), turn.apply({ -100, 200 })));
			}
			body.set_rotation_memory(turn);
			world.add_soft_body(std::move(body));
		}
		softbody::Simulator simulator(world);
		for (int i = 0; i < int(60 * seconds); ++i) {
			simulator.simulate(Real(1) / 60);
		}
		std::vector<Vec2> points;
		for (const SoftBodyData &body : world.soft_bodies()) {
			for (const Vec2 p : body.positions()) {
				points.push_back(turn.apply_inverse(p - shift));
			}
		}
		return points;
	};
	const std::vector<Vec2> upright = run({}, {});
	const std::vector<Vec2> turned = run(softbody::Rotation::from_angle(Real(degrees * DEGREE)), offset);
	double worst = 0;
	for (std::size_t i = 0; i < upright.size(); ++i) {
		worst = std::max(worst, double(length(upright[i] - turned[i])) / RADIUS);
	}
	return { { "scene", "turned" }, { "degrees", degrees }, { "seconds", seconds }, { "error_R", worst }, { "double", sizeof(Real) == 8 } };
}

// The way of a disc that rolls from rest without sliding for `seconds`, after it has settled on flat ground; the mean of the ways to both
// sides, as springs are solved in their order.
double rolled_way(const Disc &of, double degrees, double seconds, int rate) {
	const double angle = degrees * DEGREE;
	double sum = 0;
	for (const double side : { 1.0, -1.0 }) {
		WorldData world = world_of({ 0, Real(GRAVITY) });
		world.set_sleeping(false);
		check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
		world.add_soft_body(disc(of, { 0, Real(-RADIUS * std::cos(std::numbers::pi / of.points)) }));
		softbody::Simulator simulator(world);
		for (int i = 0; i < rate; ++i) {
			simulator.simulate(Real(1) / Real(rate));
		}
		const double start = double(center_of(world.soft_bodies()[0]).x);
		check(world.set_gravity({ Real(side * GRAVITY * std::sin(angle)), Real(GRAVITY * std::cos(angle)) }));
		for (int i = 0; i < int(rate * seconds); ++i) {
			simulator.simulate(Real(1) / Real(rate));
		}
		sum += side * (double(center_of(world.soft_bodies()[0]).x) - start) / 2;
	}
	return sum;
}

// Against 1/2 g sin(a) t² / (1 + I/(m r²)) with the true radius and inertia, for a rigid disc; and against the same soft disc with steps
// 16 times as short. What these leave is the damping of the material, which a rigid disc does not have.
json rolling(int points, double stiffness, double degrees) {
	Disc of;
	of.stiffness = stiffness;
	of.points = points;
	of.friction = 1;
	of.angle = std::numbers::pi / points;
	const double seconds = 3;
	const double way = rolled_way(of, degrees, seconds, 60);
	const double converged = rolled_way(of, degrees, seconds, 16 * 60);
	const SoftBodyData body = disc(of, {});
	const double ratio = double(body.shape().rest_inertia()) / (double(body.shape().total_mass()) * RADIUS * RADIUS);
	const double theory = GRAVITY * std::sin(degrees * DEGREE) * seconds * seconds / 2 / (1 + ratio);
	return { { "scene", "rolling" }, { "points", points }, { "k", stiffness }, { "degrees", degrees }, { "way", way }, { "theory", theory },
		{ "error_percent", 100 * std::abs(way / theory - 1) }, { "material_percent", 100 * (1 - converged / theory) },
		{ "step_error_percent", 100 * std::abs(way / converged - 1) } };
}

enum class Pull { SLOPE, WIND, FREE, ON_ANOTHER };
constexpr std::array PULL_SCENES = { "slow_slope", "slow_wind", "slow_free", "slow_on_another" };

// A body that has come to rest, on smooth ground, in the air or on a pinned body, and then is faintly pulled along.
json slow_start(double pull, Pull kind, double friction = 0) {
	WorldData world = world_of({ 0, kind == Pull::FREE ? Real(0) : Real(GRAVITY) });
	check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
	Disc of;
	of.friction = friction;
	of.rolling_resistance = friction > 0 ? 0.1 : 0;
	of.angle = std::numbers::pi / 16;
	double ground = 0;
	if (kind == Pull::ON_ANOTHER) {
		const std::vector<Vec2> outline = { { -2000, -50 }, { 2000, -50 }, { 2000, 0 }, { -2000, 0 } };
		SoftBodyData plank = take(SoftBodyData::create(take(softbody::SoftBodyCreator::create_polygon(outline, {})), {}));
		for (std::uint32_t i = 0; i < plank.point_count(); ++i) {
			check(plank.set_pinned(i, true));
		}
		world.add_soft_body(std::move(plank));
		ground = -50;
	}
	const softbody::BodyId id = world.add_soft_body(disc(of, { 0, Real(kind == Pull::FREE ? -200 : ground - RADIUS * 0.99) }));
	softbody::Simulator simulator(world);
	for (int i = 0; i < 120; ++i) {
		simulator.simulate(Real(1) / 60);
	}
	const bool slept = world.find(id)->is_asleep();
	const double start = double(center_of(*world.find(id)).x);
	if (kind == Pull::WIND) {
		check(world.find(id)->set_acceleration({ Real(pull), 0 }));
	} else if (kind == Pull::FREE) {
		check(world.set_gravity({ Real(pull), 0 }));
	} else {
		check(world.set_gravity({ Real(pull), Real(std::sqrt(GRAVITY * GRAVITY - pull * pull)) }));
	}
	const double seconds = 4;
	for (int i = 0; i < int(60 * seconds); ++i) {
		simulator.simulate(Real(1) / 60);
	}
	const double theory = friction > 0 ? 0 : pull * seconds * seconds / 2;
	const double way = double(center_of(*world.find(id)).x) - start;
	return { { "scene", PULL_SCENES[std::size_t(kind)] }, { "pull", pull }, { "way", way }, { "theory", theory },
		{ "friction", friction }, { "slept_before", slept }, { "asleep", world.find(id)->is_asleep() } };
}

// Default bodies dropped into a shaft that is hardly wider than they are.
json collapsed(int count) {
	WorldData world = world_of({ 0, Real(GRAVITY) });
	check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
	check(world.add_border(wall({ -55, 0 }, { 1, 0 })));
	check(world.add_border(wall({ 55, 0 }, { -1, 0 })));
	for (int i = 0; i < count; ++i) {
		Disc of;
		of.friction = 0.4;
		of.rolling_resistance = 0.03;
		SoftBodyData body = disc(of, { Real(i % 2), Real(-60 - 145 * i) });
		BodySettings settings = body.settings();
		softbody::testing::set_default_limits(settings);
		settings.linear_damp = Real(0.1);
		settings.angular_damp = 1;
		check(body.set_settings(settings));
		world.add_soft_body(std::move(body));
	}
	softbody::Simulator simulator(world);
	double speed = 0;
	double fastest = 0;
	json asleep_after = nullptr;
	for (int i = 0; i < 60 * 40 && asleep_after.is_null(); ++i) {
		if (simulator.simulate(Real(1) / 60).sleeping_bodies == std::size_t(count)) {
			asleep_after = i / 60.0;
		}
		double sum = 0;
		for (const SoftBodyData &body : world.soft_bodies()) {
			sum += 2 * softbody::measure_energy(body, {}).kinetic / double(body.shape().total_mass()) / count;
		}
		speed = std::sqrt(sum);
		fastest = i > 60 * 30 ? std::max(fastest, speed) : 0;
	}
	return { { "scene", "collapsed" }, { "bodies", count }, { "rms_speed", speed }, { "fastest_late", fastest }, { "asleep_after_s", asleep_after } };
}

// Bodies thrown at a floor of one segment without radius.
json long_floor(double size, int throws) {
	int leaks = 0;
	double deepest = 0;
	Random random(5);
	for (int n = 0; n < throws; ++n) {
		WorldData world = world_of({ 0, Real(GRAVITY) });
		softbody::Collider floor;
		floor.vertices = { { Real(-size / 2), 0 }, { Real(size / 2), 0 } };
		const double tilt = random.uniform(-0.3, 0.3);
		const softbody::Rotation turn = softbody::Rotation::from_angle(Real(tilt));
		for (Vec2 &p : floor.vertices) {
			p = turn.apply(p);
		}
		check(world.add_collider(floor));
		Disc of;
		of.friction = 0.4;
		of.rolling_resistance = 0.03;
		const double along = std::min(0.4 * size, size / 2 - 1500); // it slides on by a thousand pixels
		const Vec2 at = turn.apply({ Real(random.uniform(-along, along)), -200 });
		world.add_soft_body(disc(of, at, turn.apply({ Real(random.uniform(-300, 300)), Real(random.uniform(300, 2500)) })));
		softbody::Simulator simulator(world);
		for (int i = 0; i < 180; ++i) {
			simulator.simulate(Real(1) / 60);
		}
		double depth = 0;
		for (const Vec2 p : world.soft_bodies()[0].hull()) {
			depth = std::max(depth, double(turn.apply_inverse(p).y));
		}
		leaks += depth > 1;
		deepest = std::max(deepest, depth / RADIUS);
	}
	return { { "scene", "long_floor" }, { "length", size }, { "throws", throws }, { "leaks", leaks }, { "deepest_R", deepest } };
}

json stack(int high, double stiffness) {
	WorldData world = world_of({ 0, Real(GRAVITY) });
	check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
	Random random(2);
	const std::vector<Vec2> outline = { { -30, -30 }, { 0, -30 }, { 30, -30 }, { 30, 0 }, { 30, 30 }, { 0, 30 }, { -30, 30 }, { -30, 0 } };
	softbody::StructureOptions options;
	options.stiffness = Real(stiffness);
	options.damping = Real(0.012 * std::sqrt(stiffness));
	const Shape shape = take(softbody::SoftBodyCreator::create_polygon(outline, options));
	for (int i = 0; i < high; ++i) {
		BodySettings settings;
		set_shape_matching(settings, *shape, 0.4 * stiffness);
		settings.friction = Real(0.4);
		settings.rolling_resistance = Real(0.03);
		const softbody::Pose pose{ { Real(random.uniform(-1, 1)), Real(-30 - 60 * i) }, {} };
		world.add_soft_body(take(SoftBodyData::create(shape, settings, pose)));
	}
	softbody::Simulator simulator(world);
	json asleep_after = nullptr;
	double stands = 60;
	for (int i = 0; i < 3600 && asleep_after.is_null(); ++i) {
		if (simulator.simulate(Real(1) / 60).sleeping_bodies == std::size_t(high)) {
			asleep_after = i / 60.0;
		}
		if (-double(center_of(world.soft_bodies()[std::size_t(high - 1)]).y) < 0.6 * 60 * high) {
			stands = i / 60.0;
			break;
		}
	}
	return { { "scene", "stack" }, { "high", high }, { "k", stiffness }, { "stands_s", stands }, { "asleep_after_s", asleep_after } };
}

class Rows {
public:
	void add(json row, const char *target) {
		row["must_be"] = target;
		std::fprintf(stderr, "  %s\n", row.dump().c_str());
		rows_.push_back(std::move(row));
	}
	void add_all(const json &rows, const char *target) {
		for (const json &row : rows) {
			add(row, target);
		}
	}
	const json &all() const { return rows_; }

private:
	json rows_ = json::array();
};

} // namespace

json contact_books(const Options &options) {
	Rows rows;
	const char *const box = "highest <= 1.01, and end >= 0.5 at k = 1000";
	for (const double stiffness : { 100.0, 1000.0 }) {
		rows.add(closed_box(stiffness, Integrator::AUTOMATIC, options.quick ? 20 : 60, 1, 1), box);
		for (int seed = 1; seed <= (options.quick ? 1 : 3); ++seed) {
			rows.add(closed_box(stiffness, Integrator::AUTOMATIC, options.quick ? 20 : 60, seed), box);
		}
	}
	for (const Integrator integrator : { Integrator::RUNGE_KUTTA_4, Integrator::VELOCITY_VERLET, Integrator::XPBD }) {
		rows.add(closed_box(1000, integrator, options.quick ? 20 : 60, 1), box);
	}
	for (const double stiffness : { 100.0, 1000.0 }) {
		for (const double gap : { 0.05, 0.5, 5.0 }) {
			rows.add(row_of_five(stiffness, gap), "highest <= 1.01, end >= 0.9");
		}
	}
	for (const double stiffness : { 100.0, 1000.0, 1e4 }) {
		for (const double offset : { 0.0, 30.0, 70.0 }) {
			for (const double speed : { 100.0, 600.0 }) {
				rows.add(two_meet(stiffness, offset, speed), "highest <= 1.01");
			}
		}
	}
	for (const double stiffness : { 1000.0, 4000.0 }) {
		for (const double gap : { 0.05, 5.0 }) {
			rows.add(cradle(stiffness, gap), "highest <= 1.01");
		}
	}
	rows.add_all(method_bounces(), "gap <= 5 %");
	rows.add_all(methods_alike(), "gap <= 5 %");
	rows.add_all(tick_bounces(), "gap <= 3 % at restitution 0.8");
	for (const double degrees : { 90.0, 37.0 }) {
		rows.add(turned_scene(degrees, 0.5), "error <= 1e-9 R in double");
		rows.add(turned_scene(degrees, 1), "error <= 1e-9 R in double");
	}
	for (const int points : { 16, 32, 64 }) {
		for (const double stiffness : { 400.0, 1000.0, 1e4 }) {
			for (const double degrees : { 5.0, 20.0 }) {
				rows.add(rolling(points, stiffness, degrees), points < 32 ? "error <= 5 %" : "error <= 2 %");
			}
		}
	}
	for (const double pull : { 5.0, 20.0, 40.0 }) {
		for (const Pull kind : { Pull::SLOPE, Pull::WIND, Pull::FREE, Pull::ON_ANOTHER }) {
			rows.add(slow_start(pull, kind), "way = theory");
		}
	}
	rows.add(slow_start(40, Pull::SLOPE, 0.4), "way = 0, asleep");
	for (const int count : { 6, 12 }) {
		rows.add(collapsed(count), "asleep");
	}
	for (const double size : { 4e3, 8e4, 1e6 }) {
		rows.add(long_floor(size, options.quick ? 50 : 200), "no leaks");
	}
	for (const int high : { 10, 20 }) {
		for (const double stiffness : { 2e4, 8e4, 1.6e5 }) {
			rows.add(stack(high, stiffness), "stands 60 s, asleep within 20");
		}
	}
	return { { "rows", rows.all() } };
}

} // namespace bench
