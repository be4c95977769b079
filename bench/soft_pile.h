// SPDX-License-Identifier: MIT
// A pile of thesis bodies in our own simulator, in all the ways that the benches ask for.
#pragma once

#include "pile_scene.h"
#include "thread_pool.h"

#include "core/base/constants.h"
#include "core/dynamics/simulator.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <span>
#include <vector>

namespace bench {

struct SoftPileSettings {
	softbody::Integrator integrator = softbody::Integrator::AUTOMATIC;
	int substeps = 0; ///< 0: as many as the core chooses
	int contact_substeps = softbody::MIN_CONTACT_SUBSTEPS;
	double stiffness = 0; ///< k of every spring [N/m]
	double damping = 0; ///< c of every spring [N s/m]
	double shape_stiffness = 0; ///< [N/m]
	double shape_damping = 0; ///< [N s/m]
	double heavy = 1; ///< every second body has that times the mass
	double top = 0; ///< if not 0, the last body has that times the mass
	bool bodies_collide = true;
	bool may_sleep = false; ///< off, so that every counted body is simulated
	double rolling_resistance = 0.03; ///< the node's default
	bool has_separation_force = false; ///< the thesis's force instead of contacts between bodies, in time steps as short as a substep
};

/// The default model: shape matching of 0.4 k, damped like the node does, the automatic method and substeps.
SoftPileSettings default_settings(double stiffness);
/// Explicit Euler in steps of h [s] with the damping that it needs: a mode decays where c/k > h. Twice that much.
SoftPileSettings explicit_euler_settings(double stiffness, double h);

/// The stiffness by which the lowest body loses about a tenth of its area, 10 load / R [N/m].
double carrying_stiffness(const PileScene &scene, double mean_mass = 1);

/// The scene with its middle at x = 0: far from there, floats resolve less.
PileScene centered(PileScene scene);

/// How long something took [s]: by the clock, and as processor time of the calling thread, which does not count while
/// another program has the processor.
struct Duration {
	double wall = 0;
	double cpu = 0;
};

class Stopwatch {
public:
	Stopwatch();
	Duration elapsed() const;

private:
	std::chrono::steady_clock::time_point wall_;
	double cpu_ = 0;
};

struct Statistics {
	double median = 0;
	double least = 0;
	double worst = 0;
	double mean = 0;
};
Statistics statistics_of(std::vector<double> values);

/// Of steps [s].
struct StepTimes {
	Statistics wall;
	Statistics cpu; ///< of the calling thread
};
StepTimes times_of(std::span<const Duration> steps);

class SoftPile {
public:
	SoftPile(PileScene scene, const SoftPileSettings &settings, softbody::ParallelFor parallel_for = {});

	/// One time step; how long it took.
	Duration step();
	/// That many, and how long they took.
	StepTimes run(int steps);
	PileQuality quality() const;
	/// Mean over bodies [J].
	double kinetic_energy() const;
	/// Share of bodies whose center of mass moves slower than that [m/s].
	double share_slower(double speed) const;

	const PileScene &scene() const { return scene_; }
	softbody::WorldData &world() { return world_; }
	softbody::Simulator &simulator() { return simulator_; }
	/// Of the last step.
	const softbody::StepReport &report() const { return report_; }
	/// Bodies put back because they were no longer finite, so far.
	std::size_t resets() const { return resets_; }
	/// Substeps in which a body looks for contacts, as the core takes them.
	int contact_substeps() const;
	std::size_t size() const { return scene_.bodies.size(); }
	/// Where every body is, and what it weighs, for drawing: [x, y] of every hull point.
	nlohmann::json picture() const;

private:
	PileScene scene_;
	softbody::WorldData world_;
	softbody::Simulator simulator_;
	softbody::StepReport report_;
	std::size_t resets_ = 0;
	int separation_steps_ = 0; ///< in a time step, where the separation force acts
};

/// As result files name it.
nlohmann::json to_json(const PileQuality &quality);
nlohmann::json to_json(const SoftPileSettings &settings);

} // namespace bench
