// SPDX-License-Identifier: MIT
// Scenes made to break soft bodies, each with what must be true of it in the end. Tests and `scripts/bench.sh stress` run them.
#pragma once

#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace softbody::testing {

/// How a scene is stepped.
struct StressSetup {
	Integrator integrator = Integrator::AUTOMATIC; ///< of every body
	int rate = 60; ///< ticks a second
	bool quick = false; ///< fewer bodies where a scene has hundreds
	std::uint64_t seed = 0; ///< of all that a scene leaves to chance; 0 is the usual one
	bool elastic = false; ///< bodies of the default material instead of springs, where a scene does not ask for springs
};

/// What is said about a scene when it is over.
class StressVerdict {
public:
	void at_most(const char *what, double value, double limit);
	void at_least(const char *what, double value, double limit);
	void holds(const char *what, bool holds);
	/// A claim of rest: of the automatic choice alone. Methods whose velocity is ahead of the way just gone tremble beside
	/// contacts, and wander; XPBD is softer than its springs.
	void rests(const char *what, double value, double limit);
	void set_promises_rest(bool promises) { promises_rest_ = promises; }
	bool promises_rest() const { return promises_rest_; }
	bool passed() const { return problems_.empty(); }
	/// Every claim that did not hold, with its figures; empty if all did.
	const std::string &problems() const { return problems_; }

private:
	std::string problems_;
	bool promises_rest_ = true;
};

/// What was seen while a scene ran.
struct StressLog {
	double time = 0; ///< simulated [s]
	bool finite = true; ///< every position and velocity after every tick
	std::size_t resets = 0;
	double start_energy = 0; ///< of all bodies
	double most_energy = 0; ///< likewise, after any tick
	/// Kinetic and in gravity alone: a contact that moves a point by a pixel strains a stiff spring by far more for a moment.
	double start_motion = 0;
	double most_motion = 0;
	bool was_safe = true; ///< whether every body's plan called itself safe in every tick
	int refused = 0; ///< steps
};

/// A world, what is done to it, and what must come of it.
struct StressScene {
	StressScene(std::string scene_name, WorldData scene_world) :
			name(std::move(scene_name)), world(std::move(scene_world)) {}

	std::string name; ///< "family/variant"
	WorldData world;
	double seconds = 4; ///< simulated
	/// Bodies are strongly deformed, or pressed against one another. No bound holds for explicit Euler, midpoint and Heun
	/// then (see SubstepPlan::safe), and trembling methods do not come to rest.
	bool is_violent = true;
	std::function<Real(int tick, Real dt)> time_step = {}; ///< of each tick; empty: the rate's
	std::function<void(WorldData &world, double time, Real dt)> before_tick = {};
	std::function<void(const WorldData &world, double time)> after_tick = {};
	/// Claims beside those that hold for all: finite, and no body reset.
	std::function<void(const WorldData &world, const StressLog &log, StressVerdict &verdict)> judge = {};
	std::size_t allowed_resets = 0;
};

/// "family/what_number".
std::string scene_name(const char *what, double number);

using StressFamily = std::vector<StressScene> (*)(const StressSetup &setup);

/// The families, each in a file of its own.
std::vector<StressScene> ratio_scenes(const StressSetup &setup); ///< mass and stiffness; heavy on light
std::vector<StressScene> start_scenes(const StressSetup &setup); ///< flattened, inverted, crumpled, random
std::vector<StressScene> tangle_scenes(const StressSetup &setup); ///< spawned on each other, pressed together, inside out
std::vector<StressScene> impact_scenes(const StressSetup &setup); ///< corners, seams, projectiles
std::vector<StressScene> load_scenes(const StressSetup &setup); ///< stack, squeeze, funnel, gravity
std::vector<StressScene> extreme_scenes(const StressSetup &setup); ///< spin, sizes, places, pins
std::vector<StressScene> time_scenes(const StressSetup &setup); ///< hitches and time scales
std::vector<StressScene> theory_scenes(const StressSetup &setup); ///< thesis methods where theory says that they fail
const std::vector<StressFamily> &stress_families();

/// What is expected of a run.
enum class StressExpectation {
	PASSES, ///< all claims
	STAYS_FINITE, ///< no non-finite number after any tick: the method promises no more in this scene
};

struct StressResult {
	std::string name; ///< "family/variant integrator rate"
	StressExpectation expectation = StressExpectation::PASSES;
	bool passed = false;
	bool met_all = false; ///< all claims hold, expected or not
	std::string problems;
};

/// Runs a scene of `setup` to its end.
StressResult run_stress(StressScene scene, const StressSetup &setup);

} // namespace softbody::testing
