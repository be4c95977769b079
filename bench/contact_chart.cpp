// SPDX-License-Identifier: MIT
// What more contact substeps buy: each error of contacts that a player sees, over the time of a step, for default nodes
// stepped by forces and by constraints.
#include "bench.h"
#include "field_stage.h"

#include "core/dynamics/energy.h"
#include "core/model/body_frame.h"
#include "scenes/integrator_facts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace bench {

namespace {

using nlohmann::json;
using softbody::BodyId;
using softbody::Integrator;
using softbody::Real;
using softbody::Vec2;

constexpr double RADIUS = 50; // px
constexpr double DEGREE = std::numbers::pi / 180;

struct Stepping {
	Integrator integrator = Integrator::SEMI_IMPLICIT_EULER;
	int substeps = 4;
};

/// The figure of one run; `time` is that of a body and step [µs].
struct Figure {
	double error = 0;
	double time = 0;
	int contact_substeps = 0;
};

// Bodies without damping from outside, which theory does not have. Force methods take at least the substeps that are stable.
void prepare(Stage &stage, const Stepping &stepping) {
	check(stage.world().set_contact_substeps(stepping.substeps));
	stage.values.linear_damp = 0;
	stage.values.angular_damp = 0;
	stage.values.can_sleep = false;
	stage.values.integrator = stepping.integrator;
	(stepping.integrator == Integrator::XPBD ? stage.values.substeps : stage.values.least_substeps) = stepping.substeps;
}

Figure figure_of(const Stage &stage, double error) {
	return { error, stage.us_per_body_step(), stage.contact_substeps() };
}

// 60 discs fall a little into a shaft, ten high: the deepest that one is ever in another [% of R].
Figure penetration(const Stepping &stepping) {
	constexpr int COLUMNS = 6;
	constexpr double PITCH = 2.05 * RADIUS;
	Stage stage({});
	prepare(stage, stepping);
	stage.add_floor();
	stage.add_wall({ 0, 0 }, { 1, 0 });
	stage.add_wall({ Real(COLUMNS * PITCH), 0 }, { -1, 0 });
	Random random(1);
	for (int i = 0; i < 60; ++i) {
		const double x = (i % COLUMNS + 0.5) * PITCH + random.uniform(-2, 2);
		stage.add(circle(RADIUS, 16, false), { Real(x), Real(-(i / COLUMNS + 0.5) * 2.1 * RADIUS + random.uniform(-2, 2)) });
	}
	stage.run(6);
	return figure_of(stage, 100 * stage.worst_penetration());
}

// A disc with a restitution of 0.8 falls by 300 px: how far from 0.64 of that it rises again [% of it].
Figure bounce(const Stepping &stepping) {
	constexpr double DROP = 300;
	Stage stage({});
	prepare(stage, stepping);
	stage.values.restitution = 0.8;
	stage.add_floor();
	const double rest = RADIUS * std::cos(std::numbers::pi / 16); // it lands on an edge
	const BodyId id = stage.add(circle(RADIUS, 16, true), { 0, Real(-rest - DROP) });
	bool has_hit = false;
	double highest = 0;
	stage.run(3, [&] {
		const softbody::BodyFrame frame = softbody::measure_frame(stage.body(id));
		has_hit |= double(frame.center.y) > -rest - 1;
		if (has_hit && frame.velocity.y < 0) {
			highest = std::max(highest, -double(frame.center.y) - rest);
		}
		return has_hit && highest > 0 && frame.velocity.y > 0;
	});
	const double theory = 0.64 * DROP;
	return figure_of(stage, 100 * std::abs(highest / theory - 1));
}

// A disc rolls down a slope of 5 degrees for three seconds: how far from theory it comes [% of it].
Figure rolling(const Stepping &stepping) {
	constexpr double SLOPE = 5 * DEGREE;
	constexpr double TIME = 3;
	Stage stage({});
	prepare(stage, stepping);
	stage.values.rolling_resistance = 0;
	stage.add_floor();
	const BodyId id = stage.add(circle(RADIUS, 32, false), { 0, Real(-RADIUS) });
	stage.run(1); // settles on flat ground
	const double start = double(stage.center(id).x);
	check(stage.world().set_gravity({ Real(FIELD_GRAVITY * std::sin(SLOPE)), Real(FIELD_GRAVITY * std::cos(SLOPE)) }));
	stage.run(TIME);
	const softbody::SoftBodyShape &shape = stage.body(id).shape();
	const double ratio = double(shape.rest_inertia()) / (double(shape.total_mass()) * RADIUS * RADIUS);
	const double theory = FIELD_GRAVITY * std::sin(SLOPE) * TIME * TIME / 2 / (1 + ratio);
	return figure_of(stage, 100 * std::abs((double(stage.center(id).x) - start) / theory - 1));
}

// How far from atan(friction) the slope is from which a block slides [degrees].
Figure slope(const Stepping &stepping) {
	constexpr double FRICTION = 0.4;
	constexpr double MOVED = 2; // px in the last second; a tenth of a degree too steep gives 3
	double holds = 0;
	double slides = 45;
	Figure figure;
	while (slides - holds > 0.02) {
		const double middle = (holds + slides) / 2 * DEGREE;
		Stage stage({});
		prepare(stage, stepping);
		stage.values.friction = FRICTION;
		stage.add_floor();
		const BodyId id = stage.add(rectangle(2 * RADIUS, 2 * RADIUS), { 0, Real(-RADIUS) });
		stage.run(1);
		check(stage.world().set_gravity({ Real(FIELD_GRAVITY * std::sin(middle)), Real(FIELD_GRAVITY * std::cos(middle)) }));
		stage.run(1);
		const double before = double(stage.center(id).x);
		stage.run(1);
		(double(stage.center(id).x) - before < MOVED ? holds : slides) = middle / DEGREE;
		figure = figure_of(stage, 0);
	}
	figure.error = std::abs((holds + slides) / 2 - std::atan(FRICTION) / DEGREE);
	return figure;
}

// Two blocks, one a little out of line: how far the top has moved sideways after 10 s [px]. Three are higher than a column
// of this material stands: 7.84 E I = load times height², both of the whole column.
Figure stack(const Stepping &stepping) {
	Stage stage({});
	prepare(stage, stepping);
	stage.add_floor();
	Random random(2);
	BodyId top;
	double start = 0;
	for (int i = 0; i < 2; ++i) {
		start = random.uniform(-1, 1);
		top = stage.add(rectangle(2 * RADIUS, 2 * RADIUS), { Real(start), Real(-(2 * i + 1) * RADIUS) });
	}
	stage.run(10);
	return figure_of(stage, std::abs(double(stage.center(top).x) - start));
}

// Twenty undamped discs with restitution 1 at 300 px/s between four walls: by how much their energy ever rises [%].
Figure energy_gain(const Stepping &stepping) {
	constexpr double WIDTH = 800;
	constexpr double HEIGHT = 700;
	Stage stage({}, 0);
	prepare(stage, stepping);
	stage.values.restitution = 1;
	stage.values.damping_ratio = 0;
	stage.values.friction = 0;
	stage.values.rolling_resistance = 0;
	stage.add_wall({ 0, 0 }, { 1, 0 });
	stage.add_wall({ Real(WIDTH), 0 }, { -1, 0 });
	stage.add_wall({ 0, 0 }, { 0, 1 });
	stage.add_wall({ 0, Real(HEIGHT) }, { 0, -1 });
	Random random(3);
	for (int i = 0; i < 20; ++i) {
		const Vec2 at{ Real(80 + 155 * (i % 5)), Real(90 + 170 * (i / 5)) };
		const BodyId id = stage.add(circle(RADIUS, 16, false), at);
		const double angle = random.uniform(0, 2 * std::numbers::pi);
		softbody::SoftBodyData &body = *stage.world().find(id);
		for (std::uint32_t k = 0; k < body.point_count(); ++k) {
			check(body.set_point(k, body.positions()[k], Vec2{ Real(std::cos(angle)), Real(std::sin(angle)) } * Real(300)));
		}
	}
	const auto energy = [&] {
		double sum = 0;
		for (const softbody::SoftBodyData &body : stage.world().soft_bodies()) {
			sum += softbody::measure_energy(body, {}).total();
		}
		return sum;
	};
	const double first = energy();
	double highest = first;
	stage.run(10, [&] {
		highest = std::max(highest, energy());
		return !(highest < 1e6 * first);
	});
	return figure_of(stage, 100 * (highest / first - 1));
}

struct Kind {
	const char *name;
	const char *unit;
	Figure (*measure)(const Stepping &);
};
constexpr Kind KINDS[] = {
	{ "penetration of a pile, worst", "% of R", penetration },
	{ "bounce height", "%", bounce },
	{ "rolling distance", "%", rolling },
	{ "slope angle", "degrees", slope },
	{ "drift of a stack", "px", stack },
	{ "energy gain", "%", energy_gain },
};

} // namespace

json contact_chart(const Options &options) {
	json rows = json::array();
	for (const Kind &kind : KINDS) {
		for (const Integrator integrator : { Integrator::SEMI_IMPLICIT_EULER, Integrator::XPBD }) {
			int last = 0;
			for (const int substeps : options.quick ? std::vector{ 1, 8 } : std::vector{ 1, 2, 4, 8, 16, 32 }) {
				const Figure figure = kind.measure({ integrator, substeps });
				// Stability may ask for more; the same run once is enough.
				if (figure.contact_substeps == last) {
					continue;
				}
				last = figure.contact_substeps;
				rows.push_back({ { "error", kind.name }, { "unit", kind.unit },
						{ "integrator", softbody::integrator_facts(integrator).name }, { "asked_substeps", substeps },
						{ "contact_substeps", last }, { "value", figure.error }, { "us_per_body_step", figure.time } });
				std::fprintf(stderr, "  %s\n", rows.back().dump().c_str());
			}
		}
	}
	return rows;
}

} // namespace bench
