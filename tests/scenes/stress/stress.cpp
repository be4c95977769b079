// SPDX-License-Identifier: MIT
// How a scene is run and what is expected of it.
#include "scenes/stress/stress.h"

#include "core/dynamics/energy.h"
#include "scenes/integrator_facts.h"
#include "support/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace softbody::testing {

namespace {

std::string figures(const char *what, double value, const char *bound, double limit) {
	char text[160];
	std::snprintf(text, sizeof(text), "%s %.6g, must be %s %.6g; ", what, value, bound, limit);
	return text;
}

struct Energies {
	double all = 0;
	double motion = 0;
};

Energies energies_of(const WorldData &world) {
	Energies sum;
	for (const SoftBodyData &body : world.soft_bodies()) {
		const Energy energy = measure_energy(body, body.total_acceleration(world.gravity()));
		sum.all += energy.total();
		sum.motion += energy.kinetic + energy.gravity;
	}
	return sum;
}

bool lives_on_damping(Integrator integrator) {
	return integrator == Integrator::EXPLICIT_EULER || integrator == Integrator::MIDPOINT || integrator == Integrator::HEUN;
}

} // namespace

std::string scene_name(const char *what, double number) {
	char text[96];
	std::snprintf(text, sizeof(text), "%s_%g", what, number);
	return text;
}

void StressVerdict::at_most(const char *what, double value, double limit) {
	if (!(value <= limit)) {
		problems_ += figures(what, value, "at most", limit);
	}
}

void StressVerdict::at_least(const char *what, double value, double limit) {
	if (!(value >= limit)) {
		problems_ += figures(what, value, "at least", limit);
	}
}

void StressVerdict::rests(const char *what, double value, double limit) {
	if (promises_rest_) {
		at_most(what, value, limit);
	}
}

void StressVerdict::holds(const char *what, bool holds) {
	if (!holds) {
		problems_.append("not ").append(what).append("; ");
	}
}

const std::vector<StressFamily> &stress_families() {
	static const std::vector<StressFamily> families = { ratio_scenes, start_scenes, tangle_scenes, impact_scenes, load_scenes,
		extreme_scenes, time_scenes, theory_scenes };
	return families;
}

StressResult run_stress(StressScene scene, const StressSetup &setup) {
	WorldData &world = scene.world;
	Simulator simulator(world);
	StressLog log;
	const Energies start = energies_of(world);
	log.start_energy = log.most_energy = start.all;
	log.start_motion = log.most_motion = start.motion;
	const double tick = 1.0 / setup.rate;
	for (int n = 0; log.time < scene.seconds - tick / 2; ++n) {
		const Real dt = scene.time_step ? scene.time_step(n, Real(tick)) : Real(tick);
		if (scene.before_tick) {
			scene.before_tick(world, log.time, dt);
		}
		for (const SoftBodyData &body : world.soft_bodies()) {
			log.was_safe &= simulator.plan(body, std::max(dt, Real(1e-9))).safe;
		}
		const StepReport report = simulator.simulate(dt);
		log.refused += report.refused.has_value();
		log.time += std::max(double(dt), tick / 16); // a scene of no time ends, too
		log.resets += report.reset_bodies.size();
		for (const SoftBodyData &body : world.soft_bodies()) {
			log.finite &= all_finite(body.positions()) && all_finite(body.velocities());
		}
		const Energies now = energies_of(world);
		log.most_energy = std::max(log.most_energy, now.all);
		log.most_motion = std::max(log.most_motion, now.motion);
		if (scene.after_tick) {
			scene.after_tick(world, log.time);
		}
	}
	StressVerdict verdict;
	verdict.set_promises_rest(setup.integrator == Integrator::AUTOMATIC);
	verdict.holds("finite", log.finite);
	verdict.at_most("resets", double(log.resets), double(scene.allowed_resets));
	if (scene.judge) {
		scene.judge(world, log, verdict);
	}
	StressResult result;
	result.name = scene.name;
	result.name.append(" ").append(integrator_facts(setup.integrator).name).append(" ").append(std::to_string(setup.rate));
	result.met_all = verdict.passed();
	result.problems = verdict.problems();
	const bool is_bound = setup.integrator == Integrator::AUTOMATIC || (log.was_safe && !(scene.is_violent && lives_on_damping(setup.integrator)));
	result.expectation = is_bound ? StressExpectation::PASSES : StressExpectation::STAYS_FINITE;
	result.passed = is_bound ? result.met_all : log.finite;
	return result;
}

} // namespace softbody::testing
