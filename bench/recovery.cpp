// SPDX-License-Identifier: MIT
// Which models bring a ruined body back to its shape.
#include "bench.h"
#include "bodies.h"

#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Real;
using softbody::Vec2;

constexpr double STIFFNESS = 1000;
constexpr double DAMPING_RATIO = 0.05;
constexpr double SECONDS = 10;
constexpr double TOLERANCE = 0.05; // root mean square distance from the rest shape that counts as recovered, over R
constexpr std::uint64_t SEED = 20150701;

struct ModelCase {
	std::string name;
	bool center_springs = true;
	double pressure = 0; // over k
	double shape_matching = 0; // over k
};

std::vector<ModelCase> model_cases() {
	std::vector<ModelCase> cases;
	for (const double matching : { 0.0, 0.2, 0.4 }) {
		std::string suffix;
		if (matching > 0) {
			suffix = matching < 0.3 ? " + shape matching 0.2 k" : " + shape matching 0.4 k";
		}
		cases.push_back({ "centre springs" + suffix, true, 0, matching });
		cases.push_back({ "hull + pressure 2 k" + suffix, false, 2, matching });
		cases.push_back({ "centre springs + pressure 2 k" + suffix, true, 2, matching });
	}
	return cases;
}

constexpr const char *DEFAULT_MODEL = "centre springs + shape matching 0.4 k";

// Root mean square distance over R of the points from the rest shape, turned and moved to fit best; of the mirrored
// rest shape if `mirrored`. From the least-squares rotation the sum of squares is sum |x|² + sum |q|² - 2 |sum x q*|,
// with points as complex numbers; mirroring replaces q* by q.
double distance_from_rest(const softbody::SoftBodyData &body, bool mirrored) {
	const auto rest = body.shape().rest_positions();
	const Vec2 center = softbody::measure_frame(body).center;
	double squares = 0;
	double real = 0;
	double imaginary = 0;
	for (std::size_t i = 0; i < rest.size(); ++i) {
		const Vec2 p = body.positions()[i] - center;
		const double qx = rest[i].x;
		const double qy = mirrored ? -rest[i].y : rest[i].y;
		squares += double(length_squared(p)) + qx * qx + qy * qy;
		real += p.x * qx + p.y * qy;
		imaginary += p.y * qx - p.x * qy;
	}
	const double rest_of_squares = std::max(0.0, squares - 2 * std::hypot(real, imaginary));
	return std::sqrt(rest_of_squares / double(rest.size())) / body.shape().radius();
}

enum class Outcome { RECOVERED, MIRRORED, OTHER, NOT_FINITE };

struct RunResult {
	Outcome outcome = Outcome::OTHER;
	double distance = 0;
	std::uint64_t substeps = 0;
};

RunResult run(softbody::SoftBodyData start, int rate) {
	softbody::WorldData world;
	world.set_sleeping(false); // however small the motion
	softbody::Simulator simulator(world);
	world.add_soft_body(std::move(start));
	const softbody::SoftBodyData &body = world.soft_bodies()[0];
	RunResult result;
	for (int i = 0; i < int(SECONDS * rate); ++i) {
		const softbody::StepReport report = simulator.simulate(Real(1) / Real(rate));
		result.substeps += report.substeps;
		if (!report.reset_bodies.empty()) {
			result.outcome = Outcome::NOT_FINITE;
			return result;
		}
	}
	result.distance = distance_from_rest(body, false);
	if (result.distance < TOLERANCE) {
		result.outcome = Outcome::RECOVERED;
	} else if (distance_from_rest(body, true) < TOLERANCE) {
		result.outcome = Outcome::MIRRORED;
	}
	return result;
}

json measure(const ModelCase &model, int hull_points, int starts, softbody::Integrator integrator) {
	constexpr int rate = 60;
	const Shape shape = circle_shape(hull_points, model.center_springs, STIFFNESS, DAMPING_RATIO);
	softbody::BodySettings settings;
	settings.integrator = integrator;
	settings.pressure_stiffness = Real(model.pressure * STIFFNESS);
	if (model.shape_matching > 0) {
		set_shape_matching(settings, *shape, model.shape_matching * STIFFNESS);
	}
	json row = { { "model", model.name }, { "hull_points", hull_points }, { "starts", starts }, { "recovered", 0 },
		{ "mirrored_left", 0 }, { "non_finite", 0 }, { "by_kind", json::object() } };
	for (const Deformation kind : DEFORMATIONS) {
		row["by_kind"][deformation_name(kind)] = { { "starts", 0 }, { "recovered", 0 } };
	}
	Random random(SEED + std::uint64_t(hull_points));
	double worst = 0;
	std::uint64_t substeps = 0;
	for (int i = 0; i < starts; ++i) {
		const Deformation kind = DEFORMATIONS[std::size_t(i) % DEFORMATIONS.size()];
		const RunResult result = run(body_at(shape, settings, deformed(*shape, kind, random)), rate);
		json &of_kind = row["by_kind"][deformation_name(kind)];
		const auto count = [](json &number, bool yes) { number = number.get<int>() + int(yes); };
		count(of_kind["starts"], true);
		count(of_kind["recovered"], result.outcome == Outcome::RECOVERED);
		count(row["recovered"], result.outcome == Outcome::RECOVERED);
		count(row["mirrored_left"], result.outcome == Outcome::MIRRORED);
		count(row["non_finite"], result.outcome == Outcome::NOT_FINITE);
		worst = std::max(worst, result.distance);
		substeps += result.substeps;
	}
	row["worst_distance"] = worst;
	row["mean_substeps"] = double(substeps) / (starts * SECONDS * rate);
	return row;
}

} // namespace

json recovery(const Options &options) {
	const int starts = options.quick ? 40 : 250;
	json result = { { "default_model", DEFAULT_MODEL }, { "stiffness", STIFFNESS }, { "damping_ratio", DAMPING_RATIO },
		{ "seconds", SECONDS }, { "tolerance", TOLERANCE }, { "seed", SEED }, { "rows", json::array() } };
	for (const int hull_points : { 6, 8, 16, 32 }) {
		for (const ModelCase &model : model_cases()) {
			result["rows"].push_back(measure(model, hull_points, starts, softbody::Integrator::AUTOMATIC));
		}
		ModelCase by_default = model_cases().front();
		by_default.shape_matching = 0.4;
		by_default.name = std::string(DEFAULT_MODEL) + ", XPBD";
		result["rows"].push_back(measure(by_default, hull_points, starts, softbody::Integrator::XPBD));
	}
	return result;
}

} // namespace bench
