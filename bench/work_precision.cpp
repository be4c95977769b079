// SPDX-License-Identifier: MIT
// What every integrator costs and where it ends up, over a sweep of steps, for bench/reference.py to judge.
#include "bench.h"

#include "core/base/constants.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/dynamics/simulator.h"
#include "thesis/damping_ratio.h"
#include "scenes/circle.h"
#include "scenes/integrator_facts.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bench {

namespace {

using namespace softbody;
using nlohmann::json;

constexpr Real RADIUS = Real(0.5); // [m]
constexpr int FRAMES = 60; // frames of 1/60 s: every run lasts one second
constexpr int SAMPLES = 10; // states kept of a run, evenly over that second

// One body and how it is made of k. Damping coefficients are c = ratio sqrt(k m) of a point's mass m.
struct Model {
	const char *name;
	const char *text;
	int hull_points;
	Real damping; // ratio of the springs
	Real shape; // k_s / k
	Real shape_damping; // 2 ratio of the shape matching, as the node sets it
	Real pressure; // k_p / k
};

constexpr Model MODELS[] = {
	{ "thesis", "8 hull points, light damping", 8, DEFAULT_DAMPING_RATIO, 0, 0, 0 },
	{ "thesis_undamped", "8 hull points, no damping", 8, 0, 0, 0, 0 },
	{ "thesis_shape", "8 hull points, shape matching", 8, DEFAULT_DAMPING_RATIO, DEFAULT_SHAPE_MATCHING, Real(0.5), 0 },
	{ "circle32", "32 hull points, shape matching, pressure", 32, DEFAULT_DAMPING_RATIO, DEFAULT_SHAPE_MATCHING,
			Real(0.5), 1 },
};

constexpr Integrator METHODS[] = { Integrator::EXPLICIT_EULER, Integrator::SEMI_IMPLICIT_EULER, Integrator::MIDPOINT,
	Integrator::HEUN, Integrator::RUNGE_KUTTA_4, Integrator::VELOCITY_VERLET, Integrator::XPBD };

// How far the sweep goes and how long the clock runs.
struct Effort {
	int finest; // steps a second are 60 · 2^0 to 60 · 2^finest
	int finest_of_order_4; // which alone can reach the reference, and is done soonest
	double batch_seconds; // shortest time that the clock is trusted with
	int rounds; // timings of which the median counts
};

Effort effort_of(const Options &options) {
	// Single precision has nothing to gain from ever finer steps; five doublings past its best show that it loses.
	const bool single = std::numeric_limits<Real>::digits < 30;
	if (options.quick) {
		return { 9, single ? 9 : 12, 0.0005, 3 };
	}
	return { single ? 11 : 14, single ? 11 : 14, 0.003, 5 };
}

json pairs(std::span<const Vec2> vectors) {
	json list = json::array();
	for (const Vec2 v : vectors) {
		list.push_back({ v.x, v.y });
	}
	return list;
}

json list_of(std::span<const Real> numbers) {
	return json(std::vector<Real>(numbers.begin(), numbers.end()));
}

// Stretched by 1.15 and 0.9, sheared by 0.1, and turning at 3 rad/s: smooth, no symmetry left, and every
// spring within a fifth of its rest length, so that none comes near to where it has no direction.
SoftBodyData make_body(const Model &model, Real stiffness) {
	StructureOptions options;
	options.stiffness = stiffness;
	options.damping = damping_for_ratio(model.damping, stiffness, options.mass, std::size_t(model.hull_points) + 1);
	BodySettings settings;
	settings.shape_stiffness = model.shape * stiffness;
	settings.shape_damping = damping_for_ratio(model.shape_damping, settings.shape_stiffness, options.mass,
			std::size_t(model.hull_points) + 1);
	settings.pressure_stiffness = model.pressure * stiffness;
	SoftBodyData body =
			SoftBodyData::create(softbody::testing::circle_shape(RADIUS, model.hull_points, options).value(), settings).value();
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 rest = body.shape().rest_positions()[i];
		const Vec2 x{ Real(1.15) * rest.x + Real(0.1) * rest.y, Real(0.9) * rest.y };
		body.set_point(i, x, perpendicular(x) * Real(3));
	}
	return body;
}

// All that an independent program needs to move the same body.
json describe(const SoftBodyData &body, Vec2 gravity) {
	const SoftBodyShape &shape = body.shape();
	const BodySettings &settings = body.settings();
	json springs = json::array();
	for (const Spring2D &spring : shape.springs()) {
		springs.push_back({ { "a", spring.a }, { "b", spring.b }, { "rest_length", spring.rest_length },
				{ "stiffness", spring.stiffness }, { "damping", spring.damping } });
	}
	return { { "hull_count", shape.hull_count() }, { "positions", pairs(body.positions()) },
		{ "velocities", pairs(body.velocities()) }, { "rest_positions", pairs(shape.rest_positions()) },
		{ "masses", list_of(shape.masses()) }, { "springs", springs },
		{ "shape_stiffness", settings.shape_stiffness }, { "shape_damping", settings.shape_damping },
		{ "pressure_stiffness", settings.pressure_stiffness }, { "inflation", settings.inflation },
		{ "gravity", { gravity.x * settings.gravity_scale, gravity.y * settings.gravity_scale } } };
}

// One second in `steps` steps of one method. Velocity Verlet keeps its forces within one call of simulate(),
// so a call takes as many substeps as it may.
struct Run {
	Integrator integrator;
	int calls; // of simulate() in that second
	int substeps; // in each call; 0 leaves them to the rule
	Real dt() const { return Real(1) / Real(calls); }
};

Run run_of(Integrator integrator, int level) {
	const int steps = 1 << level;
	const int substeps = std::min(steps, MAX_SUBSTEPS);
	return { integrator, FRAMES * (steps / substeps), substeps };
}

class Track {
public:
	Track(const SoftBodyData &start, const Run &run) : run_(run), start_(start), simulator_(world_) {
		BodySettings settings = start.settings();
		settings.integrator = run.integrator;
		settings.substeps = run.substeps;
		start_.set_settings(settings);
		world_.set_sleeping(false);
		id_ = world_.add_soft_body(start_);
	}

	// Runs the second once and keeps `SAMPLES` states, or fewer if the body blows up on the way.
	void observe() {
		const std::clock_t begin = std::clock();
		advance();
		estimate_ = double(std::clock() - begin) / CLOCKS_PER_SEC;
	}

	// Takes the CPU time [s] of the second, repeated until the clock is worth reading. A body that blows up is
	// given its rest shape back and costs the same. A long run averages over disturbances by itself, and has
	// been timed when it was observed unless it ended early.
	void measure(double batch_seconds) {
		if (estimate_ > 10 * batch_seconds && !blown_up_at_) {
			times_.assign(1, estimate_);
			return;
		}
		const int repeats = std::max(1, int(std::ceil(batch_seconds / std::max(estimate_, 1e-6))));
		const std::clock_t begin = std::clock();
		for (int i = 0; i < repeats; ++i) {
			restart();
			for (int call = 0; call < run_.calls; ++call) {
				simulator_.simulate(run_.dt());
			}
		}
		times_.push_back(double(std::clock() - begin) / CLOCKS_PER_SEC / repeats);
	}

	const std::vector<std::vector<Vec2>> &samples() const { return samples_; }
	SubstepPlan plan() const { return simulator_.plan(start_, run_.dt()); }

	json result() const {
		const SubstepPlan chosen = plan();
		// A plan of the rule may change from call to call; a run that ended early counts as if it had not.
		const std::int64_t steps = blown_up_at_ ? std::int64_t(run_.calls) * chosen.substeps : std::int64_t(substeps_);
		const bool verlet = chosen.integrator == Integrator::VELOCITY_VERLET;
		std::vector<double> times = times_;
		std::ranges::sort(times);
		json states = json::array();
		for (const std::vector<Vec2> &sample : samples_) {
			states.push_back(pairs(sample));
		}
		return { { "integrator", integrator_facts(run_.integrator).name },
			{ "method", integrator_facts(chosen.integrator).name }, { "steps", steps },
			// The first substep of a call finds no forces to begin with.
			{ "evaluations", steps * integrator_traits(chosen.integrator).evaluations + (verlet ? run_.calls : 0) },
			{ "cpu_us", times[times.size() / 2] * 1e6 }, { "cpu_us_least", times.front() * 1e6 },
			{ "cpu_us_most", times.back() * 1e6 },
			{ "blown_up_at", blown_up_at_ ? json(*blown_up_at_) : json(nullptr) }, { "samples", states } };
	}

private:
	void restart() {
		world_.remove_soft_body(id_);
		id_ = world_.add_soft_body(start_);
	}

	void advance() {
		for (int call = 1; call <= run_.calls; ++call) {
			const StepReport report = simulator_.simulate(run_.dt());
			substeps_ += report.substeps;
			if (!report.reset_bodies.empty()) {
				blown_up_at_ = double(call) / run_.calls;
				return;
			}
			if (call % (run_.calls / SAMPLES) == 0) {
				const std::span<const Vec2> x = world_.soft_bodies()[0].positions();
				samples_.emplace_back(x.begin(), x.end());
			}
		}
	}

	Run run_;
	SoftBodyData start_;
	WorldData world_;
	BodyId id_;
	Simulator simulator_;
	std::uint64_t substeps_ = 0; // of the observed second
	double estimate_ = 0;
	std::vector<double> times_;
	std::vector<std::vector<Vec2>> samples_;
	std::optional<double> blown_up_at_;
};

// Whether halving the step changed less than a method can still gain; the reference is no better than that.
bool has_converged(const Track &coarse, const Track &fine) {
	if (coarse.samples().size() != SAMPLES || fine.samples().size() != SAMPLES) {
		return false;
	}
	Real change = 0;
	for (std::size_t s = 0; s < SAMPLES; ++s) {
		for (std::size_t i = 0; i < fine.samples()[s].size(); ++i) {
			change = std::max(change, length(fine.samples()[s][i] - coarse.samples()[s][i]));
		}
	}
	return double(change) < 1e-12 * RADIUS;
}

json run_case(const Model &model, Real stiffness, const Effort &effort) {
	const SoftBodyData start = make_body(model, stiffness);
	std::vector<std::unique_ptr<Track>> tracks;
	tracks.push_back(std::make_unique<Track>(start, Run{ Integrator::AUTOMATIC, FRAMES, 0 }));
	tracks.back()->observe();
	for (const Integrator method : METHODS) {
		int past_convergence = 0;
		const int finest = integrator_facts(method).order == 4 ? effort.finest_of_order_4 : effort.finest;
		for (int level = 0; level <= finest && past_convergence < 2; ++level) {
			tracks.push_back(std::make_unique<Track>(start, run_of(method, level)));
			tracks.back()->observe();
			if (level > 0 && has_converged(*tracks[tracks.size() - 2], *tracks.back())) {
				past_convergence++;
			}
		}
	}
	// Round after round over all runs: what slows the machine for a while slows every method alike.
	for (int round = 0; round < effort.rounds; ++round) {
		for (const std::unique_ptr<Track> &track : tracks) {
			track->measure(effort.batch_seconds);
		}
	}

	const SubstepPlan plan = tracks.front()->plan();
	json runs = json::array();
	for (const std::unique_ptr<Track> &track : tracks) {
		runs.push_back(track->result());
	}
	return { { "body", model.name }, { "text", model.text }, { "k", stiffness }, { "radius", RADIUS },
		{ "frequency_bound", plan.frequency }, { "description", describe(start, {}) }, { "runs", runs } };
}

} // namespace

json work_precision(const Options &options) {
	const Effort effort = effort_of(options);
	json cases = json::array();
	for (const Model &model : MODELS) {
		for (const Real stiffness : { Real(1e2), Real(1e3), Real(1e4), Real(1e5) }) {
			const bool is_thesis = &model == &MODELS[0];
			const Real quick_stiffness = model.hull_points > 8 ? Real(1e2) : Real(1e3); // the reference takes its time
			if (options.quick && stiffness != quick_stiffness && !(is_thesis && stiffness <= Real(1e4))) {
				continue;
			}
			cases.push_back(run_case(model, stiffness, effort));
		}
	}
	return { { "precision", std::numeric_limits<Real>::digits < 30 ? "float" : "double" },
		{ "simulated_seconds", 1 }, { "frames", FRAMES }, { "samples", SAMPLES }, { "cases", cases } };
}

} // namespace bench
