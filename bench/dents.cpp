// SPDX-License-Identifier: MIT
// Dents: whether they depend on the tick rate, what an elastic twin keeps, and what bodies pay that do not dent. Cuts as well.
#include "bench.h"

#include "core/creator/body_tear.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "scenes/metal.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::ElasticModel;
using softbody::Real;
using softbody::Simulator;
using softbody::SoftBodyData;
using softbody::Vec2;
using softbody::WorldData;
using softbody::testing::Metal;

constexpr double LEAST_DENT = 0.02; ///< [1] a smaller one has no spread worth a figure
constexpr std::array<int, 4> TICK_RATES = { 30, 60, 120, 240 };
constexpr std::array<const char *, 5> MODEL_NAMES = { "springs", "springs_and_shape", "springs_shape_and_area", "modes", "triangles" };

/// One drop at every tick rate.
json drop_row(const Metal &metal, Real height) {
	json dents = json::array();
	double least = 1e9;
	double most = 0;
	int folded = 0;
	double worst_area = 0;
	for (const int rate : TICK_RATES) {
		const WorldData world = softbody::testing::drop_metal(metal, height, rate, 4);
		const SoftBodyData &body = world.soft_bodies()[0];
		const double dent = double(body.dent());
		dents.push_back(dent);
		least = std::min(least, dent);
		most = std::max(most, dent);
		folded += softbody::is_folded(body.hull());
		const double first = double(body.shared_shape()->rest_area());
		worst_area = std::max(worst_area, std::abs(double(signed_area(body.shape().rest_hull())) / first - 1));
	}
	json row = { { "model", MODEL_NAMES[std::size_t(metal.model)] }, { "yield", double(metal.yield) }, { "height_px", double(height) },
		{ "dents", dents }, { "folded", folded }, { "rest_area_error", worst_area } };
	if (most >= LEAST_DENT) {
		row["spread_percent"] = 100 * (most / std::max(least, 1e-9) - 1);
	}
	return row;
}

/// How far an elastic body is from its shape after a drop that dents its twin, without weight [% of its radius].
double elastic_twin_error(ElasticModel model, Real height) {
	Metal metal{ .model = model };
	metal.yield = 0;
	WorldData world = softbody::testing::drop_metal(metal, height, 60, 4);
	world.set_gravity({});
	Simulator simulator(world);
	for (int i = 0; i < 240; ++i) {
		simulator.simulate(softbody::testing::FRAME);
	}
	const SoftBodyData &body = world.soft_bodies()[0];
	const softbody::BodyFrame frame = softbody::measure_frame(body);
	double worst = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const Vec2 expected = frame.center + frame.rotation.apply(body.shape().rest_positions()[i]);
		worst = std::max(worst, double(length(body.positions()[i] - expected)));
	}
	return 100 * worst / double(body.shape().radius());
}

double seconds_since(std::chrono::steady_clock::time_point start) {
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
	std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
	return values[values.size() / 2];
}

/// 200 discs on a floor. What a step asks of each body about dents is timed by itself, as there is no build without it.
json undented_cost() {
	WorldData world = softbody::testing::floor_world();
	Metal metal;
	metal.yield = 0;
	constexpr int BODIES = 200;
	for (int i = 0; i < BODIES; ++i) {
		world.add_soft_body(softbody::testing::metal_disc(metal, { Real(i % 40) * 110, Real(-60 - i / 40 * 110) }));
	}
	for (SoftBodyData &body : world.soft_bodies()) {
		softbody::BodySettings settings = body.settings();
		settings.can_sleep = false;
		(void)body.set_settings(settings);
	}
	Simulator simulator(world);
	std::vector<double> steps;
	std::vector<double> questions;
	int yes = 0;
	constexpr int ROUNDS = 100;
	for (int i = 0; i < 240; ++i) {
		const auto start = std::chrono::steady_clock::now();
		simulator.simulate(softbody::testing::FRAME);
		steps.push_back(seconds_since(start));
		const auto asked = std::chrono::steady_clock::now();
		for (int round = 0; round < ROUNDS; ++round) {
			for (SoftBodyData &body : world.soft_bodies()) {
				body.count_damage_pause(softbody::testing::FRAME);
				yes += body.settings().can_dent() && body.takes_damage();
			}
		}
		questions.push_back(seconds_since(asked) / ROUNDS);
	}
	const double step = median(steps);
	return { { "bodies", BODIES }, { "step_us", 1e6 * step }, { "questions_us", 1e6 * median(questions) }, { "answered_yes", yes },
		{ "ratio", 1 + median(questions) / step } };
}

/// What a step costs of bodies that may dent and are strained below their yield, over that of the same that may not.
double unreached_ratio(int rounds) {
	std::array<std::vector<double>, 2> times;
	for (int round = 0; round < rounds; ++round) {
		for (const std::size_t which : { std::size_t(round % 2), std::size_t(1 - round % 2) }) {
			WorldData world = softbody::testing::floor_world();
			Metal metal;
			metal.yield = which == 0 ? Real(0) : Real(0.95);
			for (int i = 0; i < 100; ++i) {
				world.add_soft_body(softbody::testing::metal_disc(metal, { Real(i) * 110, -150 }));
			}
			Simulator simulator(world);
			const auto start = std::chrono::steady_clock::now();
			for (int i = 0; i < 60; ++i) {
				simulator.simulate(softbody::testing::FRAME);
			}
			times[which].push_back(seconds_since(start));
		}
	}
	return median(times[1]) / median(times[0]);
}

/// Median time of a tear of a disc that is drawn to 1.5 times its length [us], without and with the check that comes first
/// for a body that is not overstretched.
json tear_times(int points, int repetitions) {
	const softbody::StructureOptions options;
	const auto shape = softbody::SoftBodyCreator::create_polygon(softbody::testing::circle_of(50, points), options).value();
	SoftBodyData body = SoftBodyData::create(shape, {}, {}).value();
	const softbody::TearLimits limits{ .stretch = Real(0.4) };
	std::vector<double> checks;
	std::vector<double> tears;
	std::size_t pieces = 0;
	int overstretched = 0;
	for (int i = 0; i < repetitions; ++i) {
		for (const Real stretch : { Real(1), Real(1.5) }) {
			for (std::uint32_t k = 0; k < body.point_count(); ++k) {
				const Vec2 rest = shape->rest_positions()[k];
				(void)body.set_point(k, { rest.x * stretch, rest.y / stretch }, {});
			}
			const auto start = std::chrono::steady_clock::now();
			if (stretch == 1) {
				overstretched += softbody::is_overstretched(body, limits.stretch);
			} else {
				pieces += softbody::plan_tear(body, options, limits).value().pieces.size();
			}
			(stretch == 1 ? checks : tears).push_back(1e6 * seconds_since(start));
		}
	}
	return { { "points", points }, { "check_us", median(checks) }, { "tear_us", median(tears) }, { "pieces", pieces / std::size_t(repetitions) },
		{ "overstretched_at_rest", overstretched } };
}

} // namespace

json dents(const Options &options) {
	json result = cuts(options);
	result["drops"] = json::array();
	const std::vector<Real> heights = options.quick ? std::vector<Real>{ 400 } : std::vector<Real>{ 100, 200, 400, 800 };
	const std::vector<Real> yields = options.quick ? std::vector<Real>{ Real(0.05) } : std::vector<Real>{ Real(0.02), Real(0.05), Real(0.1) };
	double spread = 0;
	for (const ElasticModel model : softbody::testing::MODELS) {
		for (const Real yield : yields) {
			for (const Real height : heights) {
				result["drops"].push_back(drop_row({ .model = model, .yield = yield }, height));
				spread = std::max(spread, result["drops"].back().value("spread_percent", 0.0));
			}
		}
	}
	result["dent_spread_over_ticks_percent"] = spread;
	result["elastic_twins"] = json::array();
	double twin = 0;
	for (const ElasticModel model : softbody::testing::MODELS) {
		for (const Real height : heights) {
			const double error = elastic_twin_error(model, height);
			result["elastic_twins"].push_back({ { "model", MODEL_NAMES[std::size_t(model)] }, { "height_px", double(height) }, { "error_percent", error } });
			twin = std::max(twin, error);
		}
	}
	result["elastic_twin_error_percent"] = twin;
	result["undented"] = undented_cost();
	result["undented_step_ratio"] = result["undented"]["ratio"];
	result["tears"] = json::array();
	for (const int points : { 16, 64, 256 }) {
		result["tears"].push_back(tear_times(points, options.quick ? 11 : 51));
	}
	result["unreached_step_ratio"] = unreached_ratio(options.quick ? 5 : 21);
	return result;
}

} // namespace bench
