// SPDX-License-Identifier: MIT
// Whether the automatic choice keeps random crumpled bodies tame, and how much dearer it is than it had to be.
#include "bench.h"
#include "bodies.h"

#include "core/base/constants.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/dynamics/simulator.h"

#include <algorithm>
#include <cmath>
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
constexpr std::uint64_t SEED = 20150702;

struct RunResult {
	bool finite = true;
	double highest = 1; // energy over its start, at the ends of ticks
	bool is_safe() const { return finite && highest <= ENERGY_LIMIT; } // false also when `highest` is not a number
};

// The search may stop as soon as a run has failed. What is judged runs to its end: a body that blows up passes the
// energy limit long before it stops being finite, and would never be seen to do so.
enum class Until { END, FAILURE };

RunResult run(const RandomBody &random_body, const Points &start, Integrator integrator, int substeps, Until until) {
	softbody::BodySettings settings = random_body.settings;
	settings.integrator = integrator;
	settings.substeps = substeps;
	softbody::WorldData world;
	softbody::Simulator simulator(world);
	world.add_soft_body(body_at(random_body.shape, settings, start));
	const softbody::SoftBodyData &body = world.soft_bodies()[0];
	const double energy_before = softbody::measure_energy(body, {}).total();
	RunResult result;
	for (int i = 0; i < TICKS && result.finite && (until == Until::END || result.is_safe()); ++i) {
		result.finite = simulator.simulate(Real(1) / RATE).reset_bodies.empty();
		const double energy = softbody::measure_energy(body, {}).total() / energy_before;
		if (!(energy <= result.highest)) { // also when it is not a number
			result.highest = energy;
		}
	}
	return result;
}

// The fewest substeps that are safe, by trying all from 1 up. No more than allowed can be needed in earnest.
int cheapest(const RandomBody &body, const Points &start, Integrator integrator) {
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

} // namespace

json automatic(const Options &options) {
	const int bodies = options.quick ? 300 : 2500;
	Random random(SEED);
	int non_finite = 0;
	int above = 0;
	int within_half = 0;
	double highest = 0;
	std::vector<double> explicit_ratios;
	std::vector<double> explicit_substeps;
	std::vector<double> cheapest_substeps;
	std::vector<double> xpbd_ratios;
	json failures = json::array();
	json by_model = json::object();
	for (const Model model : MODELS) {
		by_model[model_name(model)] = { { "bodies", 0 }, { "failed", 0 } };
	}
	for (int i = 0; i < bodies; ++i) {
		const RandomBody body = random_body(random, LEAST_DAMPING);
		const Points start = deformed(*body.shape, Deformation::CRUMPLED, random);
		const softbody::SubstepPlan plan = softbody::plan_substeps(*body.shape, body.settings, Real(1) / RATE, false);
		const RunResult result = run(body, start, Integrator::AUTOMATIC, 0, Until::END);
		non_finite += int(!result.finite);
		above += int(!result.is_safe()); // those that stopped being finite are among them
		highest = std::max(highest, result.highest);
		json &of_model = by_model[model_name(body.model)];
		of_model["bodies"] = of_model["bodies"].get<int>() + 1;
		of_model["failed"] = of_model["failed"].get<int>() + int(!result.is_safe());
		if (!result.is_safe()) {
			failures.push_back({ { "body", i }, { "model", model_name(body.model) },
					{ "hull_points", body.shape->hull_count() }, { "mass_ratio", body.mass_ratio },
					{ "stiffness_ratio", body.stiffness_ratio }, { "damping_ratio", body.damping_ratio },
					{ "integrator", softbody::integrator_traits(plan.integrator).name }, { "substeps", plan.substeps },
					{ "finite", result.finite }, { "highest", result.finite ? json(result.highest) : json(nullptr) } });
			continue;
		}
		// Explicit methods are compared with the cheapest of them, whichever the rule runs.
		const bool to_xpbd = plan.integrator == Integrator::XPBD;
		const int least = cheapest(body, start, to_xpbd ? Integrator::XPBD : Integrator::SEMI_IMPLICIT_EULER);
		const double ratio = double(plan.substeps) / least;
		if (to_xpbd) {
			xpbd_ratios.push_back(ratio);
		} else {
			explicit_ratios.push_back(ratio);
			explicit_substeps.push_back(plan.substeps);
			cheapest_substeps.push_back(least);
			within_half += int(plan.substeps <= 2 * least);
		}
	}
	json ratio = statistics(explicit_ratios);
	ratio["share_within_2"] = explicit_ratios.empty() ? json(nullptr) : json(within_half / double(explicit_ratios.size()));
	return { { "bodies", bodies }, { "seed", SEED }, { "seconds", double(TICKS) / RATE }, { "energy_limit", ENERGY_LIMIT },
		{ "least_damping", LEAST_DAMPING }, { "non_finite", non_finite }, { "energy_above_2x", above },
		{ "highest_energy", std::isfinite(highest) ? json(highest) : json(nullptr) }, { "failures", failures },
		{ "by_model", by_model }, { "over_modelling_ratio", ratio }, { "substeps", statistics(explicit_substeps) },
		{ "cheapest_substeps", statistics(cheapest_substeps) }, { "xpbd_bodies", xpbd_ratios.size() },
		{ "xpbd_over_modelling_ratio", statistics(xpbd_ratios) } };
}

} // namespace bench
