// SPDX-License-Identifier: MIT
// Outlines that bodies take in the scenes of bench/fem under every model and number of points, and what a tick costs.
// The outlines are judged against the finite elements' by tables_model.py.
#include "bench.h"
#include "elastic_bodies.h"
#include "soft_pile.h"

#include "core/dynamics/simulator.h"
#include "core/geometry/aabb.h"
#include "core/geometry/polygon.h"
#include "core/model/model_choice.h"
#include "scenes/integrator_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Material;
using softbody::Real;
using softbody::SoftBodyData;
using softbody::Vec2;

constexpr const char *REFERENCES = "bench/fem/references.json"; // bench.py runs the programs in the repository
constexpr int RATE = 60;
constexpr int COUNTS[] = { 8, 12, 16, 24, 32, 64, 128 };
constexpr int QUICK_COUNTS[] = { 8, 16, 32 };
constexpr int COMPANY = 64; // equal bodies side by side in a timed world
constexpr double LONGEST_TIMING = 1; // s, after which the ticks so far must do
constexpr double APART = 400; // px, more than any of them is wide
constexpr double FAR_BELOW = 10000; // px: a floor that nothing reaches, as a game nearly always has one
constexpr int SETTLE = 10 * RATE; // ticks
constexpr int PRESS = 3 * RATE; // ticks in which plates close by a stage, and then wait
constexpr double ABOVE_FLOOR = 0.01; // px, at the start
constexpr double COLUMN_FRICTION = 0.4; // the node's default
constexpr double FAINT_DAMPING = 0.01; // ratio: high modes die away, and the lowest frequency hardly changes
constexpr int LISTEN = 8 * RATE; // ticks of a wobble
constexpr double NUDGE = 0.003; // of the radius, in each of the ways that a wobble starts

struct Reference {
	json data;
	Material material;
	double mass = 1;
	double gravity = 0; // px/s²
	double radius = 0; // px, of the disc, and unit of every error
};

Reference read_reference() {
	std::ifstream file(REFERENCES);
	if (!file) {
		throw std::runtime_error(std::string("cannot read ") + REFERENCES + "; run scripts/bench.sh, or from the repository's folder");
	}
	Reference reference;
	reference.data = json::parse(file);
	const json &material = reference.data["material"];
	reference.material.youngs_modulus = Real(material["E"].get<double>());
	reference.material.poisson_ratio = Real(material["nu"].get<double>());
	reference.mass = material["mass"];
	reference.gravity = material["gravity"];
	reference.radius = reference.data["disc"]["radius"];
	return reference;
}

Points points_of(const json &list) {
	Points points;
	for (const json &p : list) {
		points.push_back({ Real(p[0].get<double>()), Real(p[1].get<double>()) });
	}
	return points;
}

json to_json(std::span<const Vec2> points) {
	json list = json::array();
	for (const Vec2 p : points) {
		list.push_back({ p.x, p.y });
	}
	return list;
}

softbody::Border horizontal(double y, double up) {
	softbody::Border border;
	border.plane = { { 0, Real(y) }, { 0, Real(up) } };
	return border;
}

/// A world in pixels, y down.
class Stage {
public:
	explicit Stage(double gravity) : simulator_(world_) {
		check(world_.set_length_unit(PIXELS_A_METER));
		check(world_.set_gravity({ 0, Real(gravity) }));
	}
	void add(const ElasticBody &body, Vec2 at) {
		softbody::Pose pose;
		pose.position = at;
		world_.add_soft_body(take(SoftBodyData::create(body.shape, body.settings, pose)));
	}
	void set_floor(double y) { check(world_.add_border(horizontal(y, -1))); }
	/// Plates at ± half.
	void set_plates(double half) {
		world_.clear_environment();
		check(world_.add_border(horizontal(half, -1)));
		check(world_.add_border(horizontal(-half, 1)));
	}
	void step(int ticks = 1) {
		for (int i = 0; i < ticks; ++i) {
			resets_ += simulator_.simulate(Real(TICK)).reset_bodies.size();
		}
	}
	SoftBodyData &body(std::size_t index = 0) { return world_.soft_bodies()[index]; }
	std::size_t resets() const { return resets_; }
	/// Time of a tick of one body [µs] in a world with COMPANY times as many, each as it is now.
	double us_per_tick(int ticks);
	/// What a row says of this world: the outline of every body, the plan, the time.
	json row(int timed_ticks);

private:
	softbody::WorldData world_;
	softbody::Simulator simulator_;
	std::size_t resets_ = 0;
};

// Mass-weighted mean of positions or velocities.
Vec2 mean(const SoftBodyData &body, std::span<const Vec2> values) {
	Vec2 sum;
	for (std::size_t i = 0; i < values.size(); ++i) {
		sum += values[i] * body.shape().masses()[i];
	}
	return sum * Real(1 / double(body.shape().total_mass()));
}

// Root mean square speed of the points over the last tick, as one sees it, beyond that of the body as a whole, which nothing
// holds on a floor without friction.
double wobble_speed(const SoftBodyData &body) {
	Points velocities(body.point_count());
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		velocities[i] = (body.positions()[i] - body.previous_positions()[i]) * Real(RATE);
	}
	const Vec2 center = mean(body, body.positions());
	const Vec2 drift = mean(body, velocities);
	double momentum = 0;
	double inertia = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double mass = double(body.shape().masses()[i]);
		const Vec2 arm = body.positions()[i] - center;
		momentum += mass * double(cross(arm, velocities[i] - drift));
		inertia += mass * double(length_squared(arm));
	}
	const Real spin = body.has_pins() ? Real(0) : Real(momentum / inertia);
	double square = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const Vec2 rigid = body.has_pins() ? Vec2{} : drift + perpendicular(body.positions()[i] - center) * spin;
		square += double(length_squared(velocities[i] - rigid)) / double(body.point_count());
	}
	return std::sqrt(square);
}

double Stage::us_per_tick(int ticks) {
	softbody::WorldData crowd;
	check(crowd.set_length_unit(world_.length_unit()));
	check(crowd.set_gravity(world_.gravity()));
	for (const softbody::Border &border : world_.borders()) {
		check(crowd.add_border(border));
	}
	for (int i = 0; i < COMPANY; ++i) {
		softbody::Pose beside;
		beside.position.x = Real((i - COMPANY / 2) * APART);
		for (const SoftBodyData &body : world_.soft_bodies()) {
			SoftBodyData copy = body;
			check(copy.teleport({}, beside));
			crowd.add_soft_body(std::move(copy));
		}
	}
	softbody::Simulator simulator(crowd);
	std::vector<double> times;
	simulator.simulate(Real(TICK)); // to warm up
	const Stopwatch all;
	while (int(times.size()) < ticks && (times.empty() || all.elapsed().cpu < LONGEST_TIMING)) {
		const Stopwatch watch;
		simulator.simulate(Real(TICK));
		times.push_back(watch.elapsed().cpu);
	}
	return statistics_of(std::move(times)).median * 1e6 / double(crowd.soft_bodies().size());
}

json Stage::row(int timed_ticks) {
	json outlines = json::array();
	double speed = 0;
	for (const SoftBodyData &body : world_.soft_bodies()) {
		outlines.push_back(to_json(body.hull()));
		speed = std::max(speed, wobble_speed(body));
	}
	const softbody::SubstepPlan plan = simulator_.plan(body(), Real(TICK));
	json row = { { "outlines", outlines }, { "rest_area", body().shape().rest_area() }, { "speed", speed },
		{ "resets", resets_ }, { "integrator", softbody::integrator_facts(plan.integrator).name },
		{ "substeps", plan.substeps } };
	row["us_per_tick"] = us_per_tick(timed_ticks);
	return row;
}

/// One model with one number of points, and how long it is timed.
struct Case {
	const Reference &reference;
	const ModelChoice &model;
	int points;
	int timed_ticks;

	ElasticBody body(const Points &hull) const { return elastic_body(model, hull, reference.mass, reference.material); }
	ElasticBody body(const Points &hull, double damping_ratio) const {
		Material material = reference.material;
		material.damping_ratio = Real(damping_ratio);
		return elastic_body(model, hull, reference.mass, material);
	}
};

using Rows = std::vector<std::pair<std::string, json>>; // scene, row

double lowest(const Points &hull) {
	return double(softbody::bounding_box(hull).max.y);
}

Rows rest(const Case &c, const Points &hull) {
	Stage stage(c.reference.gravity);
	stage.set_floor(0);
	stage.add(c.body(hull), { 0, Real(-lowest(hull) - ABOVE_FLOOR) });
	stage.step(SETTLE);
	return { { "rest", stage.row(c.timed_ticks) } };
}

// Plates close from `from` to `to`, half their distance, and wait.
void close_plates(Stage &stage, double from, double to) {
	for (int i = 1; i <= PRESS; ++i) {
		stage.set_plates(from + (to - from) * i / PRESS);
		stage.step();
	}
	stage.step(PRESS);
}

// One body pressed further and further, as its plates would never open in between.
Rows press(const Case &c, const Points &hull) {
	Stage stage(0);
	stage.add(c.body(hull), {});
	Rows rows;
	double before = c.reference.radius;
	for (const char *share : { "0.9", "0.75", "0.5", "0.3" }) {
		const double half = c.reference.radius * std::stod(share);
		close_plates(stage, before, half);
		before = half;
		rows.emplace_back(std::string("press_") + share, stage.row(c.timed_ticks));
	}
	return rows;
}

// The outline of a scene that no model was tuned with, pressed once.
Rows unseen(const Case &c) {
	const json &scene = c.reference.data["scenes"]["unseen"];
	const Points hull = spaced(points_of(scene["rest_outline"]), c.points);
	const double height = scene["rest_height"];
	Stage stage(0);
	stage.add(c.body(hull), {});
	close_plates(stage, height / 2, height / 2 * scene["pressed_to"].get<double>());
	return { { "unseen", stage.row(c.timed_ticks) } };
}

// Held by the points within the angle by which the reference is held: one up to 24 points, nine of 128.
Rows hang(const Case &c) {
	Stage stage(c.reference.gravity);
	stage.set_floor(FAR_BELOW);
	const Points hull = circle(c.reference.radius, c.points, false);
	stage.add(c.body(hull), {});
	const double depth = c.reference.radius * std::cos(std::numbers::pi / 16);
	for (std::size_t i = 0; i < hull.size(); ++i) {
		if (double(-hull[i].y) >= depth - 0.01) {
			check(stage.body().set_pinned(std::uint32_t(i), true));
		}
	}
	stage.step(SETTLE);
	return { { "hang", stage.row(c.timed_ticks) } };
}

Rows arm(const Case &c, const char *name) {
	const json &scene = c.reference.data["scenes"][name];
	const Points hull = divided({ { 0, 0 }, { 100, 0 }, { 100, 40 }, { 40, 40 }, { 40, 100 }, { 0, 100 } }, c.points);
	Stage stage(scene["gravity"].get<double>());
	stage.set_floor(FAR_BELOW);
	stage.add(c.body(hull), {});
	for (std::size_t i = 0; i < hull.size(); ++i) {
		if (double(hull[i].x) < 1e-3) {
			check(stage.body().set_pinned(std::uint32_t(i), true));
		}
	}
	stage.step(SETTLE);
	return { { name, stage.row(c.timed_ticks) } };
}

// With friction: without, as in the reference, whose axis is held, the boxes slide off one another. There they slide by a
// hundredth of a pixel, so that friction has nothing to do but to hold them.
Rows column(const Case &c) {
	const Points hull = divided({ { -50, -50 }, { 50, -50 }, { 50, 50 }, { -50, 50 } }, c.points);
	Stage stage(c.reference.gravity);
	stage.set_floor(0);
	for (int i = 0; i < 3; ++i) {
		ElasticBody box = c.body(hull);
		box.settings.friction = Real(COLUMN_FRICTION);
		stage.add(box, { 0, Real(-50 - 100 * i - ABOVE_FLOOR * (i + 1)) });
	}
	stage.step(SETTLE);
	return { { "column", stage.row(c.timed_ticks) } };
}

// The undamped disc meets the floor; the outline is that of the reference's time, a whole number of ticks.
Rows drop(const Case &c) {
	const json &scene = c.reference.data["scenes"]["drop"];
	const double speed = c.reference.data["disc"]["drop_speed"];
	const Points hull = circle(c.reference.radius, c.points, true);
	Stage stage(c.reference.gravity);
	stage.set_floor(0);
	stage.add(c.body(hull, 0), { 0, Real(-lowest(hull)) });
	SoftBodyData &body = stage.body();
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		check(body.set_point(std::uint32_t(i), body.positions()[i], { 0, Real(speed) }));
	}
	const double height = double(softbody::bounding_box(body.hull()).max.y - softbody::bounding_box(body.hull()).min.y);
	const int outline_tick = int(std::lround(scene["time"].get<double>() * RATE));
	json row;
	double least = height;
	double gap_before = 0; // of the lowest point above the floor
	json contact_time = nullptr;
	json rebound = nullptr;
	for (int tick = 1; tick <= 2 * RATE; ++tick) {
		stage.step();
		if (tick == outline_tick) {
			row = stage.row(c.timed_ticks);
		}
		const softbody::Aabb box = softbody::bounding_box(body.hull());
		const double gap = -double(box.max.y);
		least = std::min(least, double(box.max.y - box.min.y));
		constexpr double OFF = 0.5; // px
		if (gap > OFF && gap_before > OFF) {
			// Two ticks in the air: the line through both gaps says when it left the floor, the flight how fast.
			const double off_for = std::clamp(gap / std::max(gap - gap_before, 1e-6), 1.0, 2.0) * TICK;
			contact_time = tick * TICK - off_for;
			rebound = (-double(mean(body, body.velocities()).y) + c.reference.gravity * off_for) / speed;
			break;
		}
		gap_before = gap;
	}
	row.update({ { "contact_time", contact_time }, { "greatest_squash", 1 - least / height }, { "rebound_speed_ratio", rebound } });
	return { { "drop", row } };
}

// Low polynomials of the rest position: strains first, then bending.
using Field = std::function<Vec2(Vec2)>;
const std::array<Field, 9> FIELDS = {
	[](Vec2 p) { return Vec2{ p.x, -p.y }; },
	[](Vec2 p) { return Vec2{ p.y, p.x }; },
	[](Vec2 p) { return Vec2{ p.x, p.y }; },
	[](Vec2 p) { return Vec2{ p.x * p.x, 0 }; },
	[](Vec2 p) { return Vec2{ 0, p.x * p.x }; },
	[](Vec2 p) { return Vec2{ p.y * p.y, 0 }; },
	[](Vec2 p) { return Vec2{ 0, p.y * p.y }; },
	[](Vec2 p) { return Vec2{ p.x * p.y, 0 }; },
	[](Vec2 p) { return Vec2{ 0, p.x * p.y }; },
};

// The rotation about the origin that fits best.
softbody::Rotation turn_of(std::span<const Vec2> from, std::span<const Vec2> to) {
	double along = 0;
	double across = 0;
	for (std::size_t i = 0; i < from.size(); ++i) {
		along += double(dot(from[i], to[i]));
		across += double(cross(from[i], to[i]));
	}
	return softbody::Rotation::from_angle(Real(std::atan2(across, along)));
}

// How a free body swings that starts deformed by the first so many fields: a series a tick of its part in every field.
json listen(Stage &stage, std::size_t nudges) {
	SoftBodyData &body = stage.body();
	const Points start(body.positions().begin(), body.positions().end());
	const Real radius = body.shape().radius();
	const Real unit = 1 / radius;
	const std::array<Real, FIELDS.size()> signs = { 1, 1, 1, -1, 1, -1, -1, 1, 1 };
	for (std::size_t i = 0; i < start.size(); ++i) {
		Vec2 moved = start[i];
		for (std::size_t k = 0; k < nudges; ++k) {
			moved += FIELDS[k](start[i] * unit) * (radius * Real(NUDGE) * signs[k]);
		}
		check(body.set_point(std::uint32_t(i), moved, {}));
	}
	json series = json::array();
	for (int tick = 0; tick < LISTEN; ++tick) {
		stage.step();
		const softbody::Rotation turn = turn_of(start, body.positions());
		json parts = json::array();
		for (const Field &field : FIELDS) {
			double part = 0;
			for (std::size_t i = 0; i < start.size(); ++i) {
				part += double(dot(field(start[i] * unit), turn.apply_inverse(body.positions()[i]) - start[i]) * unit) / double(start.size());
			}
			parts.push_back(part);
		}
		series.push_back(parts);
	}
	return series;
}

Rows wobble(const Case &c) {
	Stage stage(0);
	stage.set_floor(FAR_BELOW);
	stage.add(c.body(circle(c.reference.radius, c.points, true), FAINT_DAMPING), {});
	json series = listen(stage, 1);
	json row = stage.row(c.timed_ticks);
	row["series"] = std::move(series);
	return { { "wobble", row } };
}

/// The reference's own polygon under the default model: frequency, width when pressed, sag.
json mesh_row(const Reference &reference, const json &row) {
	const Points hull = points_of(row["polygon"]);
	const softbody::Aabb box = softbody::bounding_box(hull);
	const double height = double(box.max.y - box.min.y);
	const Case c{ reference, default_model(), int(hull.size()), 0 };
	json result = { { "kind", row["kind"] }, { "points", row["points"] } };

	Stage free(0);
	free.set_floor(FAR_BELOW);
	free.add(c.body(hull, FAINT_DAMPING), {});
	result["series"] = listen(free, FIELDS.size());

	// A node's position is that of its description, so a polygon may lie off the origin.
	Stage pressed(0);
	pressed.add(c.body(hull), { 0, -(box.min.y + box.max.y) / 2 });
	close_plates(pressed, height / 2, height / 2 * 0.75);
	const softbody::Aabb flat = softbody::bounding_box(pressed.body().hull());
	result["width"] = double(flat.max.x - flat.min.x) / double(box.max.x - box.min.x);

	Stage resting(reference.gravity);
	resting.set_floor(0);
	resting.add(c.body(hull), { 0, Real(-double(box.max.y) - ABOVE_FLOOR) });
	resting.step(SETTLE);
	const softbody::Aabb sunk = softbody::bounding_box(resting.body().hull());
	result["sag"] = 1 - double(sunk.max.y - sunk.min.y) / height;
	return result;
}

} // namespace

json model(const Options &options) {
	const Reference reference = read_reference();
	const std::span<const int> counts = options.quick ? std::span<const int>(QUICK_COUNTS) : std::span<const int>(COUNTS);
	json rows = json::array();
	const auto add = [&](const Case &c, const char *start, Rows made) {
		for (auto &[scene, values] : made) {
			json row = { { "scene", scene }, { "model", c.model.name }, { "points", c.points }, { "start", start } };
			row.update(values);
			rows.push_back(std::move(row));
		}
	};
	for (const ModelChoice &choice : elastic_models()) {
		for (const int points : counts) {
			const Case c{ reference, choice, points, options.quick ? 9 : 41 };
			for (const bool on_edge : { true, false }) {
				const Points hull = circle(reference.radius, points, on_edge);
				add(c, on_edge ? "edge" : "corner", rest(c, hull));
				add(c, on_edge ? "edge" : "corner", press(c, hull));
			}
			add(c, "corner", hang(c));
			add(c, "edge", wobble(c));
			add(c, "edge", drop(c));
			add(c, "edge", arm(c, "arm_light"));
			add(c, "edge", arm(c, "arm"));
			add(c, "edge", column(c));
			if (reference.data["scenes"].contains("unseen")) {
				add(c, "edge", unseen(c));
			}
			std::fprintf(stderr, "  %s, %d points\n", choice.name.c_str(), points);
		}
	}
	json mesh = json::array();
	for (const json &row : reference.data["mesh"]) {
		if (std::ranges::find(counts, row["points"].get<int>()) == counts.end()) {
			continue; // in a quick run
		}
		mesh.push_back(mesh_row(reference, row));
	}
	json expected = json::array(); // what the automatic choice of a model goes by
	for (const ModelChoice &choice : elastic_models()) {
		for (const int points : counts) {
			if (!choice.is_old_network && choice.inner_points < 2) {
				const double error = softbody::expected_error(choice.model, std::size_t(points));
				expected.push_back({ { "model", choice.name }, { "points", points }, { "expected_percent", 100 * error } });
			}
		}
	}
	return { { "expected", expected }, { "default_model", default_model().name }, { "company", COMPANY }, { "rows", rows }, { "mesh", mesh } };
}

} // namespace bench
