// SPDX-License-Identifier: MIT
// Whether the automatic choice keeps random crumpled bodies tame, free and thrown on the ground, and how much dearer
// it is than it had to be.
#include "bench.h"
#include "bodies.h"

#include "core/base/constants.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "scenes/integrator_facts.h"
#include "scenes/jelly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Integrator;
using softbody::Real;

constexpr int RATE = 60;
constexpr int TICKS = 2 * RATE;
constexpr double ENERGY_LIMIT = 2; // over the starting energy
constexpr double LEAST_DAMPING = 0.02; // the floor below which the core warns
constexpr Real GRAVITY = Real(9.81); // [m/s²], beside the ground

// The stability budget was chosen by looking at the first seed's bodies. They can no longer judge it alone; the others
// were drawn once, after the choice, and are never to be looked at when something is tuned.
struct Seed {
	std::uint64_t value;
	bool tuned;
};
constexpr std::array SEEDS = { Seed{ 20150702, true }, Seed{ 1618033988, false }, Seed{ 2718281828, false },
	Seed{ 3141592653, false }, Seed{ 5772156649, false } };

enum class Scene { FREE, GROUND };

struct RunResult {
	bool finite = true;
	double highest = 1; // energy over its start, at the ends of ticks
	double substeps = 0; // mean a tick
	bool was_explicit = false; // in some ticks: the plan follows a hull that pressure stretches
	bool was_xpbd = false;
	bool is_safe() const { return finite && highest <= ENERGY_LIMIT; } // false also when `highest` is not a number
};

// The search may stop as soon as a run has failed. What is judged runs to its end: a body that blows up passes the
// energy limit long before it stops being finite, and would never be seen to do so.
enum class Until { END, FAILURE };

struct Start {
	Points points;
	Scene scene = Scene::FREE;
	double drop = 0; // height of the lowest point over the ground [m]
};

// On the ground the energy is counted with gravity, above the ground: it starts with what the fall will bring.
RunResult run(const RandomBody &random_body, const Start &start, Integrator integrator, int substeps, Until until) {
	softbody::BodySettings settings = random_body.settings;
	settings.integrator = integrator;
	settings.substeps = substeps;
	softbody::WorldData world;
	world.set_sleeping(false); // however small the motion
	softbody::Simulator simulator(world);
	Points points = start.points;
	if (start.scene == Scene::GROUND) {
		const auto lowest = std::ranges::min_element(points, {}, &softbody::Vec2::y)->y;
		for (softbody::Vec2 &p : points) {
			p.y += Real(start.drop) - lowest;
		}
		world.set_gravity({ 0, -GRAVITY });
		world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	}
	world.add_soft_body(body_at(random_body.shape, settings, points));
	const softbody::SoftBodyData &body = world.soft_bodies()[0];
	const double energy_before = softbody::measure_energy(body, world.gravity()).total();
	RunResult result;
	for (int i = 0; i < TICKS && result.finite && (until == Until::END || result.is_safe()); ++i) {
		(simulator.plan(body, Real(1) / RATE).integrator == Integrator::XPBD ? result.was_xpbd : result.was_explicit) = true;
		const softbody::StepReport report = simulator.simulate(Real(1) / RATE);
		result.finite = report.reset_bodies.empty();
		result.substeps += double(report.substeps) / TICKS;
		const double energy = softbody::measure_energy(body, world.gravity()).total() / energy_before;
		if (!(energy <= result.highest)) { // also when it is not a number
			result.highest = energy;
		}
	}
	return result;
}

// The fewest substeps that are safe, by trying all from 1 up. No more than allowed can be needed in earnest.
int cheapest(const RandomBody &body, const Start &start, Integrator integrator) {
	int n = 1;
	while (n < softbody::MAX_SUBSTEPS && !run(body, start, integrator, n, Until::FAILURE).is_safe()) {
		n++;
	}
	return n;
}

json statistics(std::vector<double> values) {
	if (values.empty()) {
		return { { "count", 0 }, { "mean", nullptr }, { "median", nullptr }, { "p95", nullptr } };
	}
	std::sort(values.begin(), values.end());
	double sum = 0;
	for (const double value : values) {
		sum += value;
	}
	const auto quantile = [&](double q) { return values[std::size_t(q * double(values.size() - 1) + 0.5)]; };
	return { { "count", values.size() }, { "mean", sum / double(values.size()) }, { "median", quantile(0.5) },
		{ "p95", quantile(0.95) } };
}

// What went wrong, of one seed and scene.
struct Tally {
	int non_finite = 0;
	int above = 0; // those that stopped being finite are among them
	double highest = 0;
	std::array<int, MODELS.size()> bodies{};
	std::array<int, MODELS.size()> failed{};
	json failures = json::array();

	void add(int number, const RandomBody &body, const RunResult &result) {
		const bool safe = result.is_safe();
		non_finite += int(!result.finite);
		above += int(!safe);
		highest = std::max(highest, result.highest);
		bodies[std::size_t(body.model)]++;
		failed[std::size_t(body.model)] += int(!safe);
		if (!safe) {
			failures.push_back({ { "body", number }, { "model", model_name(body.model) },
					{ "hull_points", body.shape->hull_count() }, { "mass_ratio", body.mass_ratio },
					{ "stiffness_ratio", body.stiffness_ratio }, { "damping_ratio", body.damping_ratio },
					{ "xpbd", result.was_xpbd }, { "substeps", result.substeps },
					{ "finite", result.finite }, { "highest", std::isfinite(result.highest) ? json(result.highest) : json(nullptr) } });
		}
	}

	json as_json() const {
		json by_model = json::object();
		for (const Model model : MODELS) {
			by_model[model_name(model)] = { { "bodies", bodies[std::size_t(model)] }, { "failed", failed[std::size_t(model)] } };
		}
		return { { "non_finite", non_finite }, { "energy_above_2x", above },
			{ "highest_energy", std::isfinite(highest) ? json(highest) : json(nullptr) }, { "by_model", by_model },
			{ "failures", failures } };
	}
};

// All bodies of one seed: free, on the ground, and free again with ever more substeps until it is safe.
json judge(Seed seed, int bodies) {
	Random random(seed.value);
	Random drops(~seed.value); // apart from the stream that makes the bodies
	Tally free;
	Tally ground;
	int within_half = 0;
	int both_ways = 0;
	std::vector<double> explicit_ratios;
	std::vector<double> explicit_substeps;
	std::vector<double> cheapest_substeps;
	std::vector<double> xpbd_ratios;
	for (int i = 0; i < bodies; ++i) {
		const RandomBody body = random_body(random, LEAST_DAMPING);
		const Points points = deformed(*body.shape, Deformation::CRUMPLED, random);
		const Start falling{ points, Scene::GROUND, drops.uniform(0, 0.5) };
		ground.add(i, body, run(body, falling, Integrator::AUTOMATIC, 0, Until::END));
		const Start start{ points };
		const RunResult result = run(body, start, Integrator::AUTOMATIC, 0, Until::END);
		free.add(i, body, result);
		if (!result.is_safe()) {
			continue;
		}
		if (result.was_xpbd && result.was_explicit) {
			both_ways++; // neither kind of search says what was needed
		} else if (result.was_xpbd) {
			xpbd_ratios.push_back(result.substeps / cheapest(body, start, Integrator::XPBD));
		} else {
			// Explicit methods are compared with the cheapest of them, whichever the rule runs.
			const int least = cheapest(body, start, Integrator::SEMI_IMPLICIT_EULER);
			explicit_ratios.push_back(result.substeps / least);
			explicit_substeps.push_back(result.substeps);
			cheapest_substeps.push_back(least);
			within_half += int(result.substeps <= 2 * least);
		}
	}
	json ratio = statistics(explicit_ratios);
	ratio["share_within_2"] = explicit_ratios.empty() ? json(nullptr) : json(within_half / double(explicit_ratios.size()));
	return { { "seed", seed.value }, { "tuned", seed.tuned }, { "bodies", bodies }, { "free", free.as_json() },
		{ "ground", ground.as_json() }, { "over_modelling_ratio", ratio }, { "substeps", statistics(explicit_substeps) },
		{ "cheapest_substeps", statistics(cheapest_substeps) }, { "xpbd_bodies", xpbd_ratios.size() },
		{ "explicit_and_xpbd_bodies", both_ways },
		{ "xpbd_over_modelling_ratio", statistics(xpbd_ratios) } };
}

// --- Plans of the methods that live on damping: how far "safe" can be trusted

json safety(Integrator integrator, double least_damping, int bodies) {
	constexpr std::uint64_t seed = 77;
	constexpr double nudge = 1e-3; // of each point's distance from the center
	Random random(seed);
	int safe = 0;
	int failed_near_rest = 0;
	int failed_crumpled = 0;
	for (int i = 0; i < bodies; ++i) {
		RandomBody body = random_body(random, least_damping);
		const Points crumpled = deformed(*body.shape, Deformation::CRUMPLED, random);
		Points nudged(body.shape->rest_positions().begin(), body.shape->rest_positions().end());
		for (softbody::Vec2 &p : nudged) {
			p *= Real(1 + nudge * random.uniform(-1, 1));
		}
		body.settings.integrator = integrator;
		if (!softbody::plan_substeps(*body.shape, body.settings, Real(1) / RATE, false).safe) {
			continue;
		}
		safe++;
		failed_near_rest += int(!run(body, { nudged }, integrator, 0, Until::FAILURE).is_safe());
		failed_crumpled += int(!run(body, { crumpled }, integrator, 0, Until::FAILURE).is_safe());
	}
	return { { "integrator", softbody::integrator_facts(integrator).name }, { "least_damping", least_damping },
		{ "bodies", bodies }, { "seed", seed }, { "called_safe", safe }, { "failed_near_rest", failed_near_rest },
		{ "failed_crumpled", failed_crumpled } };
}

// --- Rest: why the rule runs semi-implicit Euler, and not Verlet, beside things to touch

constexpr int REST_TICKS = 12 * RATE;
constexpr double AT_REST = 5; // px/s of the fastest point, of jellies of 50 px

softbody::WorldData jelly_world(bool funnel) {
	softbody::WorldData world = softbody::testing::pixel_world();
	if (funnel) {
		world.add_collider({ { { -200, 100 }, { 0, 250 } }, 0, {} });
		world.add_collider({ { { 0, 250 }, { 200, 100 } }, 0, {} });
	} else {
		world.add_border(softbody::testing::floor_at(200));
	}
	return world;
}

struct Rest {
	int last_moving = 0; // tick
	double end_speed = 0; // fastest point in the last two seconds [px/s]
};

Rest drop(Integrator integrator, int hull_points, double stiffness, double damping_ratio, bool funnel) {
	const double mass = 1.0 / (hull_points + 1);
	const auto shape = take(softbody::testing::circle_shape(
			50, hull_points, { 1, Real(stiffness), Real(damping_ratio * std::sqrt(stiffness * mass)), true }));
	softbody::BodySettings settings;
	set_shape_matching(settings, *shape, 0.4 * stiffness);
	settings.rolling_resistance = Real(0.03);
	settings.integrator = integrator;
	const softbody::Pose pose{ { 3, 0 }, softbody::Rotation::from_angle(Real(0.1)) };
	softbody::WorldData world = jelly_world(funnel);
	world.add_soft_body(take(softbody::SoftBodyData::create(shape, settings, pose)));
	softbody::Simulator simulator(world);
	Rest rest;
	for (int i = 0; i < REST_TICKS; ++i) {
		simulator.simulate(Real(1) / RATE);
		double fastest = 0;
		for (const softbody::Vec2 v : world.soft_bodies()[0].velocities()) {
			fastest = std::max(fastest, double(length(v)));
		}
		rest.last_moving = fastest > AT_REST ? i + 1 : rest.last_moving;
		rest.end_speed = i >= REST_TICKS - 2 * RATE ? std::max(rest.end_speed, fastest) : 0;
	}
	return rest;
}

// Jellies of several sizes and stiffnesses, all of which either method can step explicitly.
json rest(Integrator integrator) {
	int bodies = 0;
	int at_rest = 0;
	double time = 0;
	double speed = 0;
	for (const int hull_points : { 8, 16, 32 }) {
		for (const double stiffness : { 30.0, 100.0, 300.0, 1000.0 }) {
			for (const double damping_ratio : { 0.02, 0.05, 0.2 }) {
				for (const bool funnel : { false, true }) {
					const Rest found = drop(integrator, hull_points, stiffness, damping_ratio, funnel);
					bodies++;
					at_rest += int(found.last_moving < REST_TICKS - RATE / 2);
					time += double(found.last_moving) / RATE;
					speed += found.end_speed;
				}
			}
		}
	}
	return { { "integrator", softbody::integrator_facts(integrator).name }, { "bodies", bodies }, { "at_rest", at_rest },
		{ "mean_time", time / bodies }, { "mean_speed", speed / bodies } };
}

} // namespace

json automatic(const Options &options) {
	// Seeds know nothing of each other, so their threads cannot change what they find.
	const int bodies = options.quick ? 150 : 2500;
	std::vector<std::future<json>> judged;
	for (const Seed seed : SEEDS) {
		judged.push_back(std::async(std::launch::async, judge, seed, bodies));
	}
	std::vector<std::future<json>> trusted;
	for (const double damping : { LEAST_DAMPING, 0.3 }) {
		for (const Integrator integrator : { Integrator::EXPLICIT_EULER, Integrator::MIDPOINT, Integrator::HEUN }) {
			trusted.push_back(std::async(std::launch::async, safety, integrator, damping, bodies));
		}
	}
	json safety_rows = json::array();
	json seeds = json::array();
	for (std::future<json> &each : judged) {
		seeds.push_back(each.get());
	}
	for (std::future<json> &each : trusted) {
		safety_rows.push_back(each.get());
	}
	return { { "seconds", double(TICKS) / RATE }, { "energy_limit", ENERGY_LIMIT }, { "least_damping", LEAST_DAMPING },
		{ "gravity", GRAVITY }, { "seeds", seeds },
		{ "safety", safety_rows }, { "rest", { rest(Integrator::SEMI_IMPLICIT_EULER), rest(Integrator::VELOCITY_VERLET) } } };
}

} // namespace bench
