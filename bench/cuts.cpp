// SPDX-License-Identifier: MIT
// Random cuts of random outlines, against brute force, and what a cut costs.
#include "bench.h"

#include "core/creator/body_cut.h"
#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "scenes/cut_oracles.h"
#include "scenes/random_cuts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::BodyCut;
using softbody::BodyPiece;
using softbody::Real;
using softbody::SoftBodyCreator;
using softbody::SoftBodyData;
using softbody::StructureOptions;
using softbody::Vec2;

constexpr std::uint64_t SEED = 2022;

struct Momentum {
	double x = 0, y = 0, spin = 0, mass = 0;
	double size = 0, spin_size = 0; ///< sums of the sizes of what is added up

	void add(const SoftBodyData &body) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			const double m = double(body.shape().masses()[i]);
			const Vec2 p = body.positions()[i];
			const Vec2 v = body.velocities()[i];
			mass += m;
			x += m * double(v.x);
			y += m * double(v.y);
			spin += m * (double(p.x) * double(v.y) - double(p.y) * double(v.x));
			size += m * std::hypot(double(v.x), double(v.y));
			spin_size += m * std::hypot(double(p.x), double(p.y)) * std::hypot(double(v.x), double(v.y));
		}
	}
};

json random_cuts(int wanted) {
	softbody::testing::Random random(SEED);
	json result = { { "random_cuts", 0 }, { "violations", 0 }, { "refused", 0 }, { "missed", 0 }, { "pieces", 0 } };
	double worst_momentum = 0;
	double worst_area = 0;
	double worst_mass = 0;
	int cuts = 0;
	int violations = 0;
	int pieces = 0;
	int refused = 0;
	int missed = 0;
	for (int i = 0; cuts < wanted; ++i) {
		const std::vector<Vec2> rest = softbody::testing::random_outline(softbody::testing::OutlineKind(i % softbody::testing::OUTLINE_KIND_COUNT), i % 10 == 0 ? 256 : 40, random);
		const StructureOptions options;
		const auto shape = SoftBodyCreator::create_polygon(rest, options);
		if (!shape) {
			continue; // the mean of the corners is one of them
		}
		SoftBodyData body = SoftBodyData::create(shape.value(), {}).value();
		const std::vector<Vec2> bent = softbody::testing::bent_outline(rest, random);
		for (std::uint32_t k = 0; k < body.point_count(); ++k) {
			(void)body.set_point(k, k < bent.size() ? bent[k] : softbody::area_centroid(bent), random.vector(300));
		}
		const std::vector<Vec2> blade = softbody::testing::random_blade(bent, 8, random);
		const auto cut = softbody::plan_cut(body, options, blade);
		if (!cut || cut.value().pieces.size() < 2) {
			(cut ? missed : refused)++;
			continue;
		}
		++cuts;
		pieces += int(cut.value().pieces.size());
		const auto made = softbody::cut_body(body, options, blade);
		std::vector<Vec2> twin;
		for (const Vec2 p : body.shape().rest_hull()) {
			twin.push_back(p + body.shape().origin_offset());
		}
		const double least = 0.02 * double(body.shape().rest_area()) * (1 - 1e-5);
		const softbody::testing::CutFacts facts = softbody::testing::facts_of(bent, twin, { .least_area = least }, cut.value().polygon);
		worst_area = std::max(worst_area, facts.area_error);
		violations += !facts.violation.empty() || !made;
		if (!made) {
			continue;
		}
		Momentum before;
		before.add(body);
		Momentum after;
		for (const SoftBodyData &piece : made.value()) {
			after.add(piece);
		}
		worst_momentum = std::max({ worst_momentum, std::hypot(after.x - before.x, after.y - before.y) / before.size, std::abs(after.spin - before.spin) / before.spin_size });
		worst_mass = std::max(worst_mass, std::abs(after.mass / before.mass - 1));
	}
	result["random_cuts"] = cuts;
	result["violations"] = violations;
	result["refused"] = refused;
	result["missed"] = missed;
	result["pieces"] = pieces;
	result["worst_momentum_error"] = worst_momentum;
	result["worst_mass_error"] = worst_mass;
	result["worst_area_error"] = worst_area;
	result["seed"] = SEED;
	return result;
}

// Median time of a cut through the middle of a disc [us]: where it goes and what each piece is made of, and all of it
// with the bodies of the pieces.
json cut_times(int points, bool is_elastic, int repetitions) {
	StructureOptions options;
	options.elastic = is_elastic;
	const SoftBodyData body = SoftBodyData::create(SoftBodyCreator::create_polygon(softbody::circle_hull(50, points).value(), options).value(), {}).value();
	const std::vector<Vec2> blade = { { -100, 3 }, { 100, -5 } };
	const auto median_of = [&](const auto &work) {
		std::vector<double> times;
		for (int i = 0; i < repetitions; ++i) {
			const auto start = std::chrono::steady_clock::now();
			work();
			times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
		}
		std::ranges::nth_element(times, times.begin() + repetitions / 2);
		return times[std::size_t(repetitions / 2)];
	};
	std::size_t pieces = 0;
	const double plan = median_of([&] { pieces += softbody::plan_cut(body, options, blade).value().pieces.size(); });
	const double all = median_of([&] { pieces += softbody::cut_body(body, options, blade).value().size(); });
	return { { "points", points }, { "model", is_elastic ? "modes" : "springs" }, { "plan_us", plan }, { "cut_us", all }, { "pieces", pieces / std::size_t(2 * repetitions) } };
}

} // namespace

json cuts(const Options &options) {
	json result = random_cuts(options.quick ? 1000 : 10000);
	result["times"] = json::array();
	for (const int points : { 16, 32, 64, 256 }) {
		for (const bool is_elastic : { false, true }) {
			result["times"].push_back(cut_times(points, is_elastic, is_elastic ? 9 : 201));
		}
	}
	const auto time_of = [&](int points, const char *model) {
		for (const json &row : result["times"]) {
			if (row["points"] == points && row["model"] == model) {
				return row["cut_us"].get<double>();
			}
		}
		return std::numeric_limits<double>::quiet_NaN();
	};
	result["cut_us_of_16_points"] = time_of(16, "springs");
	result["cut_us_of_256_points"] = time_of(256, "springs");
	result["cut_us_of_16_points_with_modes"] = time_of(16, "modes");
	result["cut_us_of_256_points_with_modes"] = time_of(256, "modes");
	return result;
}

} // namespace bench
