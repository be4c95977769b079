// SPDX-License-Identifier: MIT
// Contacts against theory: when a block slides, how high a body bounces, what two bodies keep when they meet; and how
// deep bodies are inside one another for how much time; and the thesis's separation force beside the contacts in use.
#include "bench.h"
#include "bodies.h"
#include "soft_pile.h"

#include "core/creator/soft_body_creator.h"
#include "core/dynamics/energy.h"
#include "thesis/separation_force.h"
#include "thesis/damping_ratio.h"
#include "scenes/circle.h"
#include "scenes/integrator_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::BodySettings;
using softbody::Integrator;
using softbody::Real;
using softbody::SoftBodyData;
using softbody::Vec2;

constexpr int RATE = 60;
constexpr Real STEP = Real(1) / RATE;
constexpr double GRAVITY = 9.81;
constexpr double STIFFNESS = 2000;
constexpr double DEGREE = std::numbers::pi / 180;

enum class Ground { BORDER, PINNED_BODY };
constexpr std::array GROUNDS = { Ground::BORDER, Ground::PINNED_BODY };

const char *ground_name(Ground ground) {
	return ground == Ground::BORDER ? "border" : "pinned_body";
}

struct Body {
	Vec2 center; ///< of mass
	Vec2 velocity;
	double mass = 0;
	double spin = 0; ///< angular momentum about the origin
};

Body measure(const SoftBodyData &body) {
	Body result;
	double x = 0, y = 0, vx = 0, vy = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double mass = 1 / double(body.shape().inverse_masses()[i]);
		const Vec2 p = body.positions()[i];
		const Vec2 v = body.velocities()[i];
		result.mass += mass;
		x += mass * double(p.x);
		y += mass * double(p.y);
		vx += mass * double(v.x);
		vy += mass * double(v.y);
		result.spin += mass * (double(p.x) * double(v.y) - double(p.y) * double(v.x));
	}
	result.center = { Real(x / result.mass), Real(y / result.mass) };
	result.velocity = { Real(vx / result.mass), Real(vy / result.mass) };
	return result;
}

// The ground at y = 0 under everything, x from -50 to 50.
void add_ground(softbody::WorldData &world, Ground ground, double friction) {
	if (ground == Ground::BORDER) {
		softbody::Border border;
		border.plane = { { 0, 0 }, { 0, 1 } };
		world.add_border(border);
		return;
	}
	const std::vector<Vec2> outline = { { -50, -2 }, { 50, -2 }, { 50, 0 }, { -50, 0 } };
	softbody::StructureOptions options;
	BodySettings settings;
	settings.friction = Real(friction);
	SoftBodyData body = take(SoftBodyData::create(take(softbody::SoftBodyCreator::create_polygon(outline, options)), settings));
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		if (body.set_pinned(i, true)) {
			throw std::runtime_error("a point cannot be pinned");
		}
	}
	world.add_soft_body(std::move(body));
}

// A square block of a meter, three points a side, standing on the ground with its middle at x = 0.
SoftBodyData block(double friction) {
	std::vector<Vec2> outline;
	const std::array<Vec2, 4> corners = { { { -0.5, 0 }, { 0.5, 0 }, { 0.5, 1 }, { -0.5, 1 } } };
	for (std::size_t i = 0; i < 4; ++i) {
		outline.push_back(corners[i]);
		outline.push_back((corners[i] + corners[(i + 1) % 4]) * Real(0.5));
	}
	softbody::StructureOptions options;
	options.stiffness = Real(STIFFNESS);
	options.damping = softbody::damping_for_ratio(Real(0.3), options.stiffness, 1, outline.size() + 1);
	const Shape shape = take(softbody::SoftBodyCreator::create_polygon(outline, options));
	BodySettings settings;
	settings.friction = Real(friction);
	set_shape_matching(settings, *shape, 0.4 * STIFFNESS);
	return take(SoftBodyData::create(shape, settings));
}

// How far the block has moved in the last second of three on a slope; gravity turns instead of the ground.
double slide(Ground ground, double friction, double angle, double *acceleration = nullptr) {
	softbody::WorldData world;
	world.set_sleeping(false);
	softbody::Simulator simulator(world);
	add_ground(world, ground, friction);
	const softbody::BodyId id = world.add_soft_body(block(friction));
	world.set_gravity({ 0, -Real(GRAVITY) });
	for (int i = 0; i < RATE; ++i) {
		simulator.simulate(STEP);
	}
	world.set_gravity({ Real(GRAVITY * std::sin(angle)), -Real(GRAVITY * std::cos(angle)) });
	Body before = measure(*world.find(id));
	for (int i = 0; i < 2 * RATE; ++i) {
		if (i == RATE) {
			before = measure(*world.find(id));
		}
		simulator.simulate(STEP);
	}
	const Body after = measure(*world.find(id));
	if (acceleration != nullptr) {
		*acceleration = double(after.velocity.x - before.velocity.x);
	}
	return double(after.center.x - before.center.x);
}

json slopes(bool quick) {
	constexpr double MOVED = 0.02; // m in that second; a tenth of a degree too steep gives 0.03
	json rows = json::array();
	for (const Ground ground : GROUNDS) {
		for (const double friction : quick ? std::vector{ 0.4 } : std::vector{ 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8 }) {
			const double theory = std::atan(friction) / DEGREE;
			double holds = 0;
			double slides = 60;
			while (slides - holds > 0.02) {
				const double middle = (holds + slides) / 2;
				(slide(ground, friction, middle * DEGREE) < MOVED ? holds : slides) = middle;
			}
			double acceleration = 0;
			const double steeper = theory + 5;
			slide(ground, friction, steeper * DEGREE, &acceleration);
			const double expected = GRAVITY * (std::sin(steeper * DEGREE) - friction * std::cos(steeper * DEGREE));
			rows.push_back({ { "ground", ground_name(ground) }, { "friction", friction }, { "theory_degrees", theory },
					{ "measured_degrees", (holds + slides) / 2 }, { "creep_at_90_percent", slide(ground, friction, 0.9 * theory * DEGREE) },
					{ "acceleration_5_degrees_steeper", acceleration }, { "acceleration_theory", expected } });
		}
	}
	return rows;
}

SoftBodyData ball(double mass, double restitution, double friction, Vec2 center, Vec2 velocity) {
	softbody::StructureOptions options;
	options.mass = Real(mass);
	options.stiffness = Real(STIFFNESS);
	options.damping = softbody::damping_for_ratio(softbody::DEFAULT_DAMPING_RATIO, options.stiffness, options.mass, 9);
	const Shape shape = take(softbody::testing::circle_shape(Real(0.5), 8, options));
	BodySettings settings;
	settings.restitution = Real(restitution);
	settings.friction = Real(friction);
	set_shape_matching(settings, *shape, 0.4 * STIFFNESS);
	// A flat side, not a corner, faces along the axes.
	const softbody::Pose pose{ center, softbody::Rotation::from_angle(Real(std::numbers::pi / 8)) };
	SoftBodyData body = take(SoftBodyData::create(shape, settings, pose));
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		if (body.set_point(i, body.positions()[i], velocity)) {
			throw std::runtime_error("a point cannot be set");
		}
	}
	return body;
}

json restitutions() {
	constexpr double DROP = 1; // m
	json rows = json::array();
	for (const Ground ground : GROUNDS) {
		for (const double restitution : { 0.0, 0.25, 0.5, 0.75, 1.0 }) {
			softbody::WorldData world;
			world.set_sleeping(false);
			softbody::Simulator simulator(world);
			world.set_gravity({ 0, -Real(GRAVITY) });
			add_ground(world, ground, 0.4);
			const double rest = 0.5 * std::cos(std::numbers::pi / 8); // height of the center of a body on its flat side
			const softbody::BodyId id = world.add_soft_body(ball(1, restitution, 0.4, { 0, Real(rest + DROP) }, {}));
			double highest = 0;
			bool has_hit = false;
			bool rises = false;
			for (int i = 0; i < 2 * RATE; ++i) {
				simulator.simulate(STEP);
				const Body body = measure(*world.find(id));
				has_hit = has_hit || double(body.center.y) < rest + 0.05 * DROP;
				rises = has_hit && (rises || body.velocity.y > 0);
				if (rises) {
					highest = std::max(highest, double(body.center.y) - rest);
					if (body.velocity.y < 0 && double(body.center.y) > rest) {
						break;
					}
				}
			}
			rows.push_back({ { "ground", ground_name(ground) }, { "restitution", restitution }, { "drop", DROP },
					{ "height", highest }, { "theory_height", restitution * restitution * DROP },
					{ "effective_restitution", std::sqrt(std::max(highest, 0.0) / DROP) } });
		}
	}
	return rows;
}

json bounces() {
	constexpr double SPEED = 2; // m/s each
	json rows = json::array();
	for (const double mass : { 1.0, 4.0 }) {
		for (const double offset : { 0.0, 0.25 }) { // of the centers across the motion [m]
			for (const double restitution : { 0.0, 0.5, 1.0 }) {
				softbody::WorldData world;
				world.set_sleeping(false);
				softbody::Simulator simulator(world);
				// The values of both bodies add up.
				world.add_soft_body(ball(1, restitution, 0.4, { -1, Real(offset / 2) }, { Real(SPEED), 0 }));
				world.add_soft_body(ball(mass, 0, 0.4, { 1, -Real(offset / 2) }, { -Real(SPEED), 0 }));
				const auto bodies = world.soft_bodies();
				const auto energy = [&] {
					return softbody::measure_energy(bodies[0], {}).total() + softbody::measure_energy(bodies[1], {}).total();
				};
				const auto both = [&] { return std::array{ measure(bodies[0]), measure(bodies[1]) }; };
				const auto [a, b] = both();
				const double energy_before = energy();
				double highest = energy_before;
				for (int i = 0; i < 2 * RATE; ++i) {
					simulator.simulate(STEP);
					highest = std::max(highest, double(energy()));
				}
				const auto [c, d] = both();
				const auto momentum = [](const Body &p, const Body &q) {
					return std::array{ p.mass * double(p.velocity.x) + q.mass * double(q.velocity.x),
						p.mass * double(p.velocity.y) + q.mass * double(q.velocity.y) };
				};
				const auto before = momentum(a, b);
				const auto after = momentum(c, d);
				const double one = a.mass * SPEED; // momentum of the first body
				rows.push_back({ { "mass_ratio", mass }, { "offset", offset }, { "restitution", restitution },
						{ "momentum_change", std::hypot(after[0] - before[0], after[1] - before[1]) / one },
						{ "angular_momentum_change", std::abs(c.spin + d.spin - a.spin - b.spin) / (one * 0.5) },
						{ "energy_after", energy() / energy_before }, { "highest_energy", highest / energy_before },
						{ "separation_over_approach", double(length(d.velocity - c.velocity)) / (2 * SPEED) } });
			}
		}
	}
	return rows;
}

// A pile that falls and settles, with its contacts looked for so many times a step.
json penetration_run(Integrator integrator, int substeps, std::size_t count, int seconds) {
	const PileScene scene = centered(pile_scene(count));
	SoftPileSettings settings = default_settings(carrying_stiffness(scene));
	settings.integrator = integrator;
	settings.contact_substeps = substeps;
	settings.substeps = integrator == Integrator::AUTOMATIC ? 0 : substeps;
	SoftPile pile(scene, settings);
	std::vector<Duration> times;
	double mean = 0;
	double worst = 0;
	int samples = 0;
	std::size_t folded = 0;
	std::size_t overlapping = 0;
	for (int i = 0; i < seconds * RATE; ++i) {
		times.push_back(pile.step());
		if (i % 12 == 11) {
			const PileQuality quality = pile.quality();
			mean += quality.mean_penetration;
			worst = std::max(worst, quality.worst_penetration);
			folded = std::max(folded, quality.folded);
			overlapping = std::max(overlapping, quality.overlapping);
			++samples;
		}
	}
	const StepTimes settled = times_of(std::span(times).last(std::size_t(RATE)));
	const PileQuality end = pile.quality();
	return { { "integrator", softbody::integrator_facts(integrator).name }, { "asked_substeps", substeps },
		{ "contact_substeps", pile.contact_substeps() }, { "bodies", count }, { "ms_per_step", 1e3 * settled.cpu.median },
		{ "least_ms", 1e3 * settled.cpu.least }, { "mean_penetration", mean / samples }, { "worst_penetration", worst },
		{ "folded_ever", folded }, { "overlapping_ever", overlapping }, { "mean_penetration_at_end", end.mean_penetration },
		{ "worst_penetration_at_end", end.worst_penetration }, { "folded_at_end", end.folded },
		{ "kinetic_energy_at_end", pile.kinetic_energy() }, { "resets", pile.resets() } };
}

json penetrations(bool quick) {
	json rows = json::array();
	for (const Integrator integrator : { Integrator::AUTOMATIC, Integrator::XPBD }) {
		int last = 0;
		for (const int substeps : quick ? std::vector{ 1, 4, 16 } : std::vector{ 1, 2, 3, 4, 6, 8, 12, 16, 24, 32 }) {
			json row = penetration_run(integrator, substeps, 300, quick ? 2 : 8);
			// The automatic choice takes more where its springs need more; the same run once is enough.
			if (row["contact_substeps"] != last) {
				std::fprintf(stderr, "  %s\n", row.dump().c_str());
				last = row["contact_substeps"];
				rows.push_back(std::move(row));
			}
		}
	}
	return rows;
}

// The thesis's separation force beside position-based contacts.

enum class ContactResponse { POSITION_BASED, SEPARATION_FORCE };
constexpr std::array RESPONSES = { ContactResponse::POSITION_BASED, ContactResponse::SEPARATION_FORCE };

const char *response_name(ContactResponse response) {
	return response == ContactResponse::POSITION_BASED ? "position_based" : "separation_force";
}

// Two undamped balls meet; their energy afterwards, wobble included.
json response_bounce(ContactResponse response, double offset, int substeps) {
	constexpr double SPEED = 2; // m/s each
	softbody::WorldData world;
	world.set_sleeping(false);
	const bool is_force = response == ContactResponse::SEPARATION_FORCE; // in time steps as short as a substep
	if (world.set_contact_substeps(is_force ? 1 : substeps)) {
		throw std::runtime_error("so many substeps are refused");
	}
	softbody::StructureOptions options;
	options.stiffness = Real(STIFFNESS);
	options.damping = 0;
	const Shape shape = take(softbody::testing::circle_shape(Real(0.5), 8, options));
	BodySettings settings;
	settings.shape_stiffness = Real(0.4 * STIFFNESS);
	settings.integrator = Integrator::SEMI_IMPLICIT_EULER;
	settings.substeps = is_force ? 1 : substeps;
	settings.collision_layer = is_force ? 0 : 1;
	for (const double side : { -1.0, 1.0 }) {
		const softbody::Pose pose{ { Real(side), Real(-side * offset / 2) }, softbody::Rotation::from_angle(Real(std::numbers::pi / 8)) };
		SoftBodyData body = take(SoftBodyData::create(shape, settings, pose));
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			if (body.set_point(i, body.positions()[i], { Real(-side * SPEED), 0 })) {
				throw std::runtime_error("a point cannot be set");
			}
		}
		world.add_soft_body(std::move(body));
	}
	const auto bodies = world.soft_bodies();
	const auto energy = [&] {
		return softbody::measure_energy(bodies[0], {}).total() + softbody::measure_energy(bodies[1], {}).total();
	};
	const auto spin = [&] { return measure(bodies[0]).spin + measure(bodies[1]).spin; };
	const double energy_before = energy();
	const double spin_before = spin();
	softbody::Simulator simulator(world);
	for (int i = 0; i < 2 * RATE * (is_force ? substeps : 1); ++i) {
		if (is_force) {
			take(softbody::add_separation_forces(world));
		}
		simulator.simulate(is_force ? STEP / Real(substeps) : STEP);
	}
	return { { "response", response_name(response) }, { "offset", offset }, { "substeps", substeps },
		{ "energy_after", energy() / energy_before }, { "angular_momentum_change", std::abs(spin() - spin_before) / (SPEED * 0.5) } };
}

json response_pile(ContactResponse response, std::size_t count, int seconds) {
	const PileScene scene = centered(pile_scene(count));
	SoftPileSettings settings = default_settings(carrying_stiffness(scene));
	settings.has_separation_force = response == ContactResponse::SEPARATION_FORCE;
	SoftPile pile(scene, settings);
	std::vector<Duration> times;
	for (int i = 0; i < seconds * RATE; ++i) {
		times.push_back(pile.step());
	}
	const PileQuality end = pile.quality();
	return { { "response", response_name(response) }, { "bodies", count }, { "seconds", seconds },
		{ "ms_per_step", 1e3 * times_of(std::span(times).last(std::size_t(RATE))).cpu.median },
		{ "kinetic_energy_at_end", pile.kinetic_energy() }, { "mean_penetration_at_end", end.mean_penetration },
		{ "worst_penetration_at_end", end.worst_penetration }, { "overlapping_at_end", end.overlapping },
		{ "folded_at_end", end.folded }, { "resets", pile.resets() } };
}

json separation_force(bool quick) {
	json bounces = json::array();
	for (const double offset : { 0.0, 0.25, 0.5 }) {
		for (const int substeps : quick ? std::vector{ 8, 64 } : std::vector{ 4, 8, 16, 32, 64 }) {
			for (const ContactResponse response : RESPONSES) {
				bounces.push_back(response_bounce(response, offset, substeps));
			}
		}
	}
	json piles = json::array();
	for (const ContactResponse response : RESPONSES) {
		piles.push_back(response_pile(response, quick ? 40 : 100, 20));
	}
	return { { "bounces", bounces }, { "piles", piles } };
}

} // namespace

json contact_accuracy(const Options &options) {
	return { { "slopes", slopes(options.quick) }, { "restitutions", restitutions() }, { "bounces", bounces() },
		{ "penetrations", penetrations(options.quick) }, { "separation_force", separation_force(options.quick) },
		{ "books", contact_books(options)["rows"] }, { "field_scenes", field_scenes(options) },
		{ "chart", contact_chart(options) } };
}

} // namespace bench
