// SPDX-License-Identifier: MIT
// Claims about bodies that are cut: nothing vanishes, nothing jumps, and the pieces go on.
#include "core/creator/body_cut.h"
#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "core/model/material.h"
#include "scenes/cut_oracles.h"
#include "scenes/jelly.h"
#include "scenes/random_cuts.h"
#include "support/compare.h"
#include "support/threads.h"

#include <doctest/doctest.h>

#include <numeric>

using namespace softbody;
using namespace softbody::testing;

namespace {

struct Sums {
	double mass = 0;
	double x = 0, y = 0; ///< momentum
	double spin = 0; ///< angular momentum about the origin
	double size = 0; ///< sum of m |v|, the unit of momentum
	double arm = 0; ///< sum of m |x| |v|, the unit of angular momentum

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
			arm += m * std::hypot(double(p.x), double(p.y)) * std::hypot(double(v.x), double(v.y));
		}
	}
};

// Of sums of up to 60 numbers, each rounded; in single precision the sums are exact beside the numbers.
constexpr double ROUNDING = (sizeof(Real) == 4 ? 2 : 32) * EPSILON;

enum class Model { NETWORK,
	MODES,
	TRIANGLES };

StructureOptions options_of(Model model) {
	StructureOptions options;
	options.mass = Real(1.7);
	options.elastic = model == Model::MODES;
	options.elastic_triangles = model == Model::TRIANGLES;
	options.center_point = model != Model::TRIANGLES;
	return options;
}

SoftBodyData make_body(std::span<const Vec2> hull, const StructureOptions &options, const BodySettings &settings = {}) {
	return SoftBodyData::create(SoftBodyCreator::create_polygon(hull, options).value(), settings, { { 300, 200 }, Rotation::from_angle(Real(0.7)) }).value();
}

// A body of 16 points that flies, spins and wobbles.
SoftBodyData moving_body(const StructureOptions &options, Random &random) {
	SoftBodyData body = make_body(circle_hull(50, 16).value(), options);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 arm = body.positions()[i] - Vec2{ 300, 200 };
		const Vec2 place = body.positions()[i] + Vec2{ arm.x * Real(0.2), -arm.y * Real(0.1) } + random.vector(1);
		REQUIRE_FALSE(body.set_point(i, place, Vec2{ 120, -40 } + perpendicular(arm) * Real(3) + random.vector(20)));
	}
	return body;
}

const std::vector<Vec2> ACROSS = { { 200, 190 }, { 400, 215 } };

} // namespace

TEST_CASE("mass, momentum and angular momentum of the pieces are those of the body") {
	Random random(3);
	for (const Model model : { Model::NETWORK, Model::MODES, Model::TRIANGLES }) {
		for (int i = 0; i < 5; ++i) {
			const StructureOptions options = options_of(model);
			const SoftBodyData body = moving_body(options, random);
			Sums before;
			before.add(body);
			const Vec2 way = Rotation::from_angle(random.real(0, 6.28)).apply({ 200, 0 });
			const Vec2 middle = Vec2{ 300, 200 } + random.vector(20);
			const auto pieces = cut_body(body, options, std::vector<Vec2>{ middle - way, middle + way });
			REQUIRE(pieces);
			REQUIRE(pieces.value().size() == 2);
			Sums after;
			for (const SoftBodyData &piece : pieces.value()) {
				after.add(piece);
			}
			CHECK(std::abs(after.mass / before.mass - 1) <= 2 * ROUNDING);
			CHECK(std::hypot(after.x - before.x, after.y - before.y) <= ROUNDING * before.size);
			CHECK(std::abs(after.spin - before.spin) <= ROUNDING * before.arm);
		}
	}
}

TEST_CASE("points that a body had keep their places to the bit, and their velocities up to the common correction") {
	Random random(4);
	const StructureOptions options = options_of(Model::NETWORK);
	const SoftBodyData body = moving_body(options, random);
	const auto cut = plan_cut(body, options, ACROSS);
	REQUIRE(cut);
	REQUIRE(cut.value().pieces.size() == 2);
	std::size_t kept = 0;
	for (std::size_t i = 0; i < 2; ++i) {
		const BodyPiece &piece = cut.value().pieces[i];
		SoftBodyData placed = make_body(piece.hull, piece.options);
		place_piece(body, cut.value(), i, placed);
		for (std::size_t k = 0; k < piece.outline.size(); ++k) {
			if (piece.outline[k] < 16) {
				++kept;
				CHECK(placed.positions()[k] == body.positions()[piece.outline[k]]);
				CHECK(placed.velocities()[k] == body.velocities()[piece.outline[k]]);
				CHECK(placed.previous_positions()[k] == body.previous_positions()[piece.outline[k]]);
			}
		}
	}
	CHECK(kept == 16);
}

TEST_CASE("pieces of a body that moves rigidly move rigidly as one; without a spin nearly as it did") {
	for (const Model model : { Model::NETWORK, Model::MODES, Model::TRIANGLES }) {
		for (const Real spin : { Real(0), Real(2) }) {
			const StructureOptions options = options_of(model);
			SoftBodyData body = make_body(circle_hull(50, 16).value(), options);
			for (std::uint32_t i = 0; i < body.point_count(); ++i) {
				REQUIRE_FALSE(body.set_point(i, body.positions()[i], Vec2{ 30, -20 } + perpendicular(body.positions()[i] - Vec2{ 300, 200 }) * spin));
			}
			const auto pieces = cut_body(body, options, ACROSS);
			REQUIRE(pieces);
			const BodyFrame first = measure_frame(pieces.value()[0]);
			for (const SoftBodyData &piece : pieces.value()) {
				for (std::size_t i = 0; i < piece.point_count(); ++i) {
					const Vec2 arm = piece.positions()[i] - first.center;
					CHECK(distance(piece.velocities()[i], first.velocity + perpendicular(arm) * first.angular_velocity) < 1e-3);
					if (spin == 0) {
						// Masses are divided anew. Their common center moves by up to a hundredth of the radius, R, and what
						// that takes of the angular momentum comes back as a spin of at most v 0.01 R / (0.25 R²).
						CHECK(distance(piece.velocities()[i], { 30, -20 }) < 0.04 * 36);
					}
				}
			}
			if (model == Model::TRIANGLES) { // whose masses lie where the solid's do
				CHECK(double(first.angular_velocity) == doctest::Approx(double(spin)).epsilon(0.01));
			}
		}
	}
}

TEST_CASE("an undeformed body leaves undeformed pieces") {
	for (const Model model : { Model::NETWORK, Model::MODES, Model::TRIANGLES }) {
		const StructureOptions options = options_of(model);
		const SoftBodyData body = make_body(circle_hull(50, 16).value(), options);
		const auto pieces = cut_body(body, options, ACROSS);
		REQUIRE(pieces);
		for (const SoftBodyData &piece : pieces.value()) {
			const BodyFrame frame = measure_frame(piece);
			for (std::size_t i = 0; i < piece.point_count(); ++i) {
				CHECK(distance(piece.positions()[i], frame.center + frame.rotation.apply(piece.shape().rest_positions()[i])) < 1e-3);
			}
		}
	}
}

TEST_CASE("pins stay with their points; a pinned corner that is cut through is pinned on both sides") {
	const StructureOptions options = options_of(Model::NETWORK);
	SoftBodyData body = make_body(circle_hull(50, 16).value(), options);
	for (const std::uint32_t point : { 0u, 3u, 8u }) {
		REQUIRE_FALSE(body.set_pinned(point, true));
	}
	const Vec2 way = body.positions()[8] - body.positions()[0];
	const auto pieces = cut_body(body, options, std::vector<Vec2>{ body.positions()[0] - way, body.positions()[8] + way });
	REQUIRE(pieces);
	REQUIRE(pieces.value().size() == 2);
	std::size_t pins = 0;
	for (const SoftBodyData &piece : pieces.value()) {
		for (std::uint32_t i = 0; i < piece.point_count(); ++i) {
			if (piece.is_pinned(i)) {
				++pins;
				CHECK(std::ranges::any_of(std::array{ 0, 3, 8 }, [&](int source) { return body.positions()[std::size_t(source)] == piece.positions()[i]; }));
			}
		}
	}
	CHECK(pins == 5);
	// The center point is in one of the pieces.
	SoftBodyData held = make_body(circle_hull(50, 16).value(), options);
	REQUIRE_FALSE(held.set_pinned(16, true));
	const auto halves = cut_body(held, options, ACROSS);
	REQUIRE(halves);
	CHECK(int(halves.value()[0].has_pins()) + int(halves.value()[1].has_pins()) == 1);
}

TEST_CASE("inner points and painted factors go with their piece") {
	StructureOptions options = options_of(Model::NETWORK);
	options.inner_points = { { -20, 0 }, { 20, 5 }, { -25, 10 } };
	const std::vector<Vec2> hull = circle_hull(50, 16).value();
	const std::vector<SpringEnds> springs = automatic_springs(hull, options.inner_points, Vec2{});
	options.spring_stiffness_scales.assign(springs.size(), 1);
	options.spring_stiffness_scales[0] = 3; // from point 0 to 1
	const SoftBodyData body = SoftBodyData::create(SoftBodyCreator::create_polygon(hull, options).value(), {}).value();
	const auto cut = plan_cut(body, options, std::vector<Vec2>{ { 2, -100 }, { 2, 100 } });
	REQUIRE(cut);
	REQUIRE(cut.value().pieces.size() == 2);
	CHECK(cut.value().pieces[0].inner_points == std::vector<std::uint32_t>{ 0, 2 });
	CHECK(cut.value().pieces[1].inner_points == std::vector<std::uint32_t>{ 1 });
	for (const BodyPiece &piece : cut.value().pieces) {
		const auto shape = SoftBodyCreator::create_polygon(piece.hull, piece.options);
		REQUIRE(shape);
		const auto firm = std::ranges::count_if(shape.value()->springs(), [&](const Spring2D &spring) { return spring.stiffness > 2 * options.stiffness; });
		CHECK(firm == (&piece == &cut.value().pieces[1] ? 1 : 0));
	}
}

TEST_CASE("what cannot be cut is refused by name, and a blade that misses leaves one body") {
	const StructureOptions options = options_of(Model::NETWORK);
	SoftBodyData body = make_body(circle_hull(50, 16).value(), options);
	const auto name_of = [&](const std::vector<Vec2> &blade, const BodyCutLimits &limits = {}) {
		const auto cut = plan_cut(body, options, blade, limits);
		return cut ? std::string() : cut.error().name;
	};
	CHECK(name_of({ { 0, 0 } }) == "blade");
	CHECK(name_of({ { 0, 0 }, { NOT_A_NUMBER, 0 } }) == "blade[1]");
	CHECK(name_of(std::vector<Vec2>(5000)) == "blade");
	CHECK(name_of(ACROSS, { .smallest_piece = Real(0.7) }) == "smallest_piece");
	CHECK(name_of(ACROSS, { .smallest_piece = NOT_A_NUMBER }) == "smallest_piece");
	CHECK(name_of(ACROSS, { .least_width = -1 }) == "least_width");
	CHECK(name_of(ACROSS, { .most_pieces = 0 }) == "most_pieces");
	CHECK(name_of(ACROSS, { .most_pieces = 1 }) == "most_pieces");
	CHECK(name_of(ACROSS, { .least_width = 40 }) == "least_width");
	CHECK(name_of({ { 310, 100 }, { 310, 400 } }, { .smallest_piece = Real(0.5) }) == "smallest_piece");
	const auto missed = plan_cut(body, options, std::vector<Vec2>{ { 0, 0 }, { 1, 1 } });
	REQUIRE(missed);
	CHECK(missed.value().pieces.size() == 1);
	CHECK(double(missed.value().pieces[0].options.mass) == doctest::Approx(1.7).epsilon(4 * EPSILON));
	REQUIRE_FALSE(body.set_point(0, Vec2{ 200, 200 }, {})); // through the other side
	CHECK(name_of(ACROSS) == "shape");
}

TEST_CASE("bodies are cut to dust no finer than the smallest piece") {
	const StructureOptions options = options_of(Model::NETWORK);
	std::vector<SoftBodyData> dust = { make_body(circle_hull(50, 16).value(), options) };
	std::vector<StructureOptions> made_of = { options };
	Random random(8);
	const double whole = double(dust[0].shape().rest_area());
	const BodyCutLimits limits{ .smallest_piece = Real(0.1), .least_width = 4 };
	for (int i = 0; i < 400; ++i) {
		const std::size_t which = std::size_t(random.integer(0, int(dust.size()) - 1));
		const Vec2 middle = area_centroid(dust[which].hull());
		const Vec2 way = Rotation::from_angle(random.real(0, 6.28)).apply({ 200, 0 });
		const auto cut = plan_cut(dust[which], made_of[which], std::vector<Vec2>{ middle - way, middle + way }, limits);
		const auto pieces = cut_body(dust[which], made_of[which], std::vector<Vec2>{ middle - way, middle + way }, limits);
		REQUIRE(cut.has_value() == pieces.has_value());
		if (!pieces) {
			CHECK(mentions("smallest_piece least_width cut", pieces.error().name));
			continue;
		}
		const StructureOptions old = made_of[which];
		for (std::size_t k = 0; k < pieces.value().size(); ++k) {
			(k == 0 ? dust[which] : dust.emplace_back(pieces.value()[k])) = pieces.value()[k];
			if (k > 0) {
				made_of.push_back({});
			}
			(k == 0 ? made_of[which] : made_of.back()) = cut.value().pieces[k].options;
		}
	}
	double mass = 0;
	double area = 0;
	for (const SoftBodyData &body : dust) {
		mass += double(body.shape().total_mass());
		area += double(body.shape().rest_area());
		CHECK(2 * double(body.shape().rest_area()) / double(perimeter(body.shape().rest_hull())) > 3.99);
	}
	CHECK(dust.size() > 10);
	CHECK(mass == doctest::Approx(1.7).epsilon(1e-4));
	CHECK(area == doctest::Approx(whole).epsilon(1e-4));
}

TEST_CASE("pieces of 1,000 random cuts are simple, at their smallest size, and sum to the whole") {
	Random random(21);
	int cuts = 0;
	double worst_momentum = 0;
	for (int i = 0; i < 1000; ++i) {
		CAPTURE(i);
		const StructureOptions options = options_of(Model::NETWORK);
		const std::vector<Vec2> rest = random_outline(OutlineKind(i % OUTLINE_KIND_COUNT), 32, random);
		const auto shape = SoftBodyCreator::create_polygon(rest, options);
		if (!shape) {
			continue; // the mean of its corners is one of them
		}
		SoftBodyData body = SoftBodyData::create(shape.value(), {}).value();
		const std::vector<Vec2> bent = bent_outline(rest, random);
		for (std::uint32_t k = 0; k < body.point_count(); ++k) {
			REQUIRE_FALSE(body.set_point(k, k < bent.size() ? bent[k] : area_centroid(bent), random.vector(100)));
		}
		Sums before;
		before.add(body);
		const auto cut = plan_cut(body, options, random_blade(bent, 8, random));
		if (!cut || cut.value().pieces.size() < 2) {
			continue;
		}
		++cuts;
		Sums after;
		double area = 0;
		std::vector<SoftBodyData> pieces;
		for (std::size_t k = 0; k < cut.value().pieces.size(); ++k) {
			const BodyPiece &piece = cut.value().pieces[k];
			const auto made = SoftBodyCreator::create_polygon(piece.hull, piece.options);
			if (!made) {
				CHECK(mentions(made.error().value, "mean")); // its center point would be a corner
				break;
			}
			SoftBodyData placed = SoftBodyData::create(made.value(), {}).value();
			place_piece(body, cut.value(), k, placed);
			pieces.push_back(std::move(placed));
			CHECK(is_simple(pieces.back().hull()));
			CHECK(shoelace(pieces.back().hull()) > 0);
			CHECK(piece.share >= 0.0199);
			CHECK((k == 0 || piece.share <= cut.value().pieces[k - 1].share));
			area += shoelace(pieces.back().hull());
		}
		if (pieces.size() < cut.value().pieces.size()) {
			continue;
		}
		std::vector<SoftBodyData *> list;
		for (SoftBodyData &piece : pieces) {
			list.push_back(&piece);
		}
		keep_momentum(body, list);
		for (const SoftBodyData &piece : pieces) {
			after.add(piece);
		}
		CHECK(area == doctest::Approx(shoelace(bent)).epsilon(1e-5));
		CHECK(after.mass == doctest::Approx(before.mass).epsilon(1e-6));
		worst_momentum = std::fmax(worst_momentum, std::hypot(after.x - before.x, after.y - before.y) / before.size);
		worst_momentum = std::fmax(worst_momentum, std::abs(after.spin - before.spin) / before.arm);
	}
	CHECK(cuts > 500);
	CHECK(worst_momentum < ROUNDING);
}

TEST_CASE("a pile whose bodies are cut goes on without a failure, and in the same bits on any number of threads" * doctest::test_suite("threads")) {
	StructureOptions options;
	options.mass = JELLY_MASS;
	options.stiffness = JELLY_STIFFNESS;
	options.damping = JELLY_DAMPING;
	struct End {
		std::vector<Vec2> places;
		std::size_t bodies = 0;
		std::size_t failures = 0;
		double mass = 0;
	};
	const auto run = [&](ParallelFor parallel_for) {
		WorldData world = pixel_world();
		REQUIRE_FALSE(world.add_border(floor_at(0)));
		REQUIRE_FALSE(world.add_border({ { { -250, 0 }, { 1, 0 } }, {} }));
		REQUIRE_FALSE(world.add_border({ { { 250, 0 }, { -1, 0 } }, {} }));
		BodySettings settings = jelly_settings(JELLY_STIFFNESS * 4);
		settings.spring_stiffness_scale = 4;
		set_default_limits(settings);
		std::vector<std::pair<BodyId, StructureOptions>> known;
		for (int i = 0; i < 30; ++i) {
			known.push_back({ world.add_soft_body(jelly_circle({ Real(-200 + i % 5 * 100), Real(-60 - i / 5 * 105) }, settings)), options });
		}
		Simulator simulator(world, parallel_for);
		Random random(31);
		End end;
		for (int tick = 0; tick < 300; ++tick) {
			if (tick % 10 == 0) {
				// Every cut is one of a body that is pressed by its neighbors.
				const std::size_t which = std::size_t(random.integer(0, int(known.size()) - 1));
				const SoftBodyData &body = *world.find(known[which].first);
				const Vec2 middle = area_centroid(body.hull());
				const Vec2 way = Rotation::from_angle(random.real(0, 6.28)).apply({ 200, 0 });
				const std::vector<Vec2> blade = { middle - way, middle + way };
				const BodyCutLimits limits{ .smallest_piece = Real(0.1), .least_width = 10 };
				const auto cut = plan_cut(body, known[which].second, blade, limits);
				auto pieces = cut_body(body, known[which].second, blade, limits);
				if (pieces && pieces.value().size() > 1) {
					world.remove_soft_body(known[which].first);
					for (std::size_t k = 0; k < pieces.value().size(); ++k) {
						const std::pair<BodyId, StructureOptions> added = { world.add_soft_body(std::move(pieces.value()[k])), cut.value().pieces[k].options };
						(k == 0 ? known[which] : known.emplace_back()) = added;
					}
				}
			}
			const StepReport report = simulator.simulate(FRAME);
			end.failures += report.reset_bodies.size();
		}
		for (const SoftBodyData &body : world.soft_bodies()) {
			end.places.insert(end.places.end(), body.positions().begin(), body.positions().end());
			end.mass += double(body.shape().total_mass());
		}
		end.bodies = world.soft_bodies().size();
		return end;
	};
	const End alone = run({});
	CHECK(alone.bodies > 45);
	CHECK(alone.failures == 0);
	CHECK(alone.mass == doctest::Approx(30).epsilon(1e-5));
	CHECK(all_finite(alone.places));
	for (const Vec2 place : alone.places) {
		REQUIRE(place.y < 5);
		REQUIRE(std::abs(place.x) < 255);
	}
	for (const std::size_t threads : { 2, 5 }) {
		CHECK(identical(run(on_threads(threads)).places, alone.places));
	}
}
