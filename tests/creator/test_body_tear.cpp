// SPDX-License-Identifier: MIT
// Claims about bodies that tear: where, when, and that nothing vanishes.
#include "core/creator/body_tear.h"
#include "core/geometry/polygon.h"
#include "scenes/random_cuts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real STRETCH = Real(0.4);

TearLimits limits_of(Real stretch = STRETCH) {
	TearLimits limits;
	limits.stretch = stretch;
	return limits;
}

/// A bar 200 long and 40 wide with points 20 apart.
std::vector<Vec2> bar() {
	std::vector<Vec2> hull;
	for (int i = 0; i < 10; ++i) {
		hull.push_back({ Real(-100 + 20 * i), -20 });
	}
	for (int i = 0; i < 2; ++i) {
		hull.push_back({ 100, Real(-20 + 20 * i) });
	}
	for (int i = 0; i < 10; ++i) {
		hull.push_back({ Real(100 - 20 * i), 20 });
	}
	for (int i = 0; i < 2; ++i) {
		hull.push_back({ -100, Real(20 - 20 * i) });
	}
	return hull;
}

SoftBodyData make(std::span<const Vec2> hull, const StructureOptions &options, const Pose &pose = {}) {
	auto shape = SoftBodyCreator::create_polygon(hull, options);
	REQUIRE(shape);
	auto body = SoftBodyData::create(shape.value(), BodySettings(), pose);
	REQUIRE(body);
	return body.value();
}

/// Moves each point to `map` of its place at rest.
void deform(SoftBodyData &body, const std::function<Vec2(Vec2)> &map, Rotation turn = {}) {
	const std::vector<Vec2> rest(body.shape().rest_positions().begin(), body.shape().rest_positions().end());
	for (std::uint32_t i = 0; i < rest.size(); ++i) {
		REQUIRE(!body.set_point(i, turn.apply(map(rest[i])), {}));
	}
}

/// The middle of the cut: mean of the points that both pieces have.
Vec2 cut_middle(const BodyCut &cut) {
	Vec2 sum;
	int count = 0;
	for (const std::uint32_t point : cut.pieces[0].outline) {
		if (std::ranges::find(cut.pieces[1].outline, point) != cut.pieces[1].outline.end()) {
			sum += cut.polygon.points[point].position;
			++count;
		}
	}
	return sum * (Real(1) / Real(std::max(1, count)));
}

} // namespace

TEST_CASE("a body tears where it is stretched beyond what it bears, and not below") {
	SoftBodyData body = make(bar(), {});
	for (const Real strain : { Real(0), Real(0.2), Real(0.39), Real(0.45), Real(0.8) }) {
		CAPTURE(strain);
		deform(body, [&](Vec2 p) { return Vec2{ p.x * (1 + strain), p.y / (1 + strain) }; });
		CHECK(is_overstretched(body, STRETCH) == (strain > STRETCH));
		const auto tear = plan_tear(body, {}, limits_of());
		REQUIRE(tear);
		CHECK(tear.value().pieces.size() == (strain > STRETCH ? 2 : 1));
	}
}

TEST_CASE("what is pressed does not tear, however much") {
	SoftBodyData body = make(bar(), {});
	deform(body, [](Vec2 p) { return p * Real(0.3); });
	CHECK_FALSE(is_overstretched(body, STRETCH));
}

TEST_CASE("a bar tears across, whichever way it lies") {
	for (int i = 0; i < 8; ++i) {
		CAPTURE(i);
		SoftBodyData body = make(bar(), {});
		const Real angle = Real(0.37) * Real(i);
		const Rotation turn = Rotation::from_angle(angle);
		deform(body, [](Vec2 p) { return Vec2{ p.x * Real(1.5), p.y * Real(0.9) }; }, turn);
		const auto tear = plan_tear(body, {}, limits_of());
		REQUIRE(tear);
		REQUIRE(tear.value().pieces.size() == 2);
		// The cut is not much longer than the bar is wide: its ends lie on both long sides.
		const BodyCut &cut = tear.value();
		std::vector<Vec2> shared;
		for (const std::uint32_t point : cut.pieces[0].outline) {
			if (std::ranges::find(cut.pieces[1].outline, point) != cut.pieces[1].outline.end()) {
				shared.push_back(turn.apply_inverse(cut.polygon.points[point].position));
			}
		}
		Real low = 1000, high = -1000, left = 1000, right = -1000;
		for (const Vec2 p : shared) {
			low = std::min(low, p.y);
			high = std::max(high, p.y);
			left = std::min(left, p.x);
			right = std::max(right, p.x);
		}
		CHECK(low == doctest::Approx(-18).epsilon(0.01));
		CHECK(high == doctest::Approx(18).epsilon(0.01));
		CHECK(right - left < 30);
	}
}

TEST_CASE("it tears where it is stretched most") {
	for (const double thin : { -60.0, -20.0, 40.0, 70.0 }) {
		CAPTURE(thin);
		SoftBodyData body = make(bar(), {});
		// Stretched by 0.3, and by up to 0.9 within 25 of one place.
		deform(body, [&](Vec2 p) {
			const double x = double(p.x);
			return Vec2{ Real(1.3 * x + 15 * std::tanh((x - thin) / 25)), p.y };
		});
		const auto tear = plan_tear(body, {}, limits_of());
		REQUIRE(tear);
		REQUIRE(tear.value().pieces.size() == 2);
		CHECK(std::abs(double(cut_middle(tear.value()).x) - 1.3 * thin) < 26); // an edge is 26 to 38 long there
	}
}

TEST_CASE("painted weak spots tear first") {
	const std::vector<Vec2> hull = bar();
	StructureOptions options;
	const SoftBodyData plain = make(hull, options);
	for (const Real weak : { Real(-60), Real(0), Real(60) }) {
		CAPTURE(weak);
		options.springs.clear();
		options.spring_stiffness_scales.clear();
		const std::span<const Vec2> rest = plain.shape().rest_positions();
		for (const Spring2D &spring : plain.shape().springs()) {
			options.springs.push_back({ spring.a, spring.b });
			const Real middle = (rest[spring.a].x + rest[spring.b].x) / 2;
			options.spring_stiffness_scales.push_back(std::abs(middle - weak) < 25 ? Real(0.5) : Real(1));
		}
		SoftBodyData body = make(hull, options);
		deform(body, [](Vec2 p) { return Vec2{ p.x * Real(1.3), p.y }; });
		const auto tear = plan_tear(body, options, limits_of());
		REQUIRE(tear);
		REQUIRE(tear.value().pieces.size() == 2);
		CHECK(std::abs(cut_middle(tear.value()).x - weak * Real(1.3)) < 35);
	}
}

TEST_CASE("a tear follows a painted seam across a body, not the short way") {
	std::vector<Vec2> hull;
	for (int side = 0; side < 4; ++side) {
		for (int i = 0; i < 10; ++i) {
			const Vec2 p{ Real(-100 + 20 * i), -100 };
			hull.push_back(side == 0 ? p : side == 1 ? Vec2{ -p.y, p.x } : side == 2 ? -p : Vec2{ p.y, -p.x });
		}
	}
	StructureOptions options;
	for (int i = 0; i < 25; ++i) {
		options.inner_points.push_back({ Real(-64 + 32 * (i % 5)), Real(-64 + 32 * (i / 5)) });
	}
	const SoftBodyData plain = make(hull, options);
	for (const Real aside : { Real(-40), Real(40) }) {
		CAPTURE(aside);
		options.springs.clear();
		options.spring_stiffness_scales.clear();
		const std::span<const Vec2> rest = plain.shape().rest_positions();
		for (const Spring2D &spring : plain.shape().springs()) {
			options.springs.push_back({ spring.a, spring.b });
			const Vec2 middle = (rest[spring.a] + rest[spring.b]) * Real(0.5);
			options.spring_stiffness_scales.push_back(std::abs(middle.x - aside * middle.y / 100) < 24 ? Real(0.2) : Real(1));
		}
		SoftBodyData body = make(hull, options);
		deform(body, [](Vec2 p) { return Vec2{ p.x * Real(1.2), p.y }; });
		const auto tear = plan_tear(body, options, limits_of());
		REQUIRE(tear);
		REQUIRE(tear.value().pieces.size() == 2);
		const BodyCut &cut = tear.value();
		for (const std::uint32_t point : cut.pieces[0].outline) {
			const Vec2 p = cut.polygon.points[point].position;
			if (std::ranges::find(cut.pieces[1].outline, point) != cut.pieces[1].outline.end()) {
				CHECK(std::abs(p.x / Real(1.2) - aside * p.y / 100) < 30);
			}
		}
	}
}

TEST_CASE("a body that is bent tears from the stretched side only when half of the way has failed") {
	const auto bent = [](double curvature) {
		return [curvature](Vec2 p) {
			const double angle = double(p.x) * curvature;
			const double radius = 1 / curvature - double(p.y);
			return Vec2{ Real(radius * std::sin(angle)), Real(1 / curvature - radius * std::cos(angle)) };
		};
	};
	SoftBodyData body = make(bar(), {});
	deform(body, bent(0.021)); // strain of 0.42 at the outer side, 0 in the middle
	CHECK(is_overstretched(body, STRETCH));
	auto tear = plan_tear(body, {}, limits_of());
	REQUIRE(tear);
	CHECK(tear.value().pieces.size() == 1);
	tear = plan_tear(body, {}, limits_of(Real(0.3)));
	REQUIRE(tear);
	CHECK(tear.value().pieces.size() == 1); // half of the way is pressed
	tear = plan_tear(body, {}, limits_of(Real(0.1)));
	REQUIRE(tear);
	CHECK(tear.value().pieces.size() == 2); // the outer side is stretched four times as far as it bears
	deform(body, [&](Vec2 p) {
		const Vec2 q = bent(0.015)(p);
		return Vec2{ q.x * Real(1.4), q.y };
	});
	tear = plan_tear(body, {}, limits_of(Real(0.2)));
	REQUIRE(tear);
	CHECK(tear.value().pieces.size() == 2);
}

TEST_CASE("a tear keeps mass, momentum, places and area, and both sides are sound: 300 random bodies") {
	int torn = 0;
	for (int seed = 0; seed < 300; ++seed) {
		CAPTURE(seed);
		Random random{ std::uint64_t(seed) };
		const std::vector<Vec2> hull = random_outline(OutlineKind(seed % OUTLINE_KIND_COUNT), 64, random);
		StructureOptions options;
		options.center_point = random.integer(0, 1) == 1;
		auto shape = SoftBodyCreator::create_polygon(hull, options);
		if (!shape) {
			continue;
		}
		auto made = SoftBodyData::create(shape.value(), BodySettings());
		REQUIRE(made);
		SoftBodyData body = made.value();
		const Real x = random.real(Real(1), Real(2.5));
		const Real y = random.real(Real(0.5), Real(2.5));
		const Real shear = random.real(Real(-0.5), Real(0.5));
		const Rotation turn = Rotation::from_angle(random.real(Real(0), Real(6.28)));
		const std::vector<Vec2> rest(body.shape().rest_positions().begin(), body.shape().rest_positions().end());
		for (std::uint32_t i = 0; i < rest.size(); ++i) {
			const Vec2 p = rest[i];
			REQUIRE(!body.set_point(i, turn.apply({ p.x * x + p.y * shear, p.y * y }), { random.real(Real(-50), Real(50)), random.real(Real(-50), Real(50)) }));
		}
		TearLimits limits = limits_of(random.real(Real(0.1), Real(0.8)));
		const auto tear = plan_tear(body, options, limits);
		REQUIRE(tear);
		const BodyCut &cut = tear.value();
		torn += cut.pieces.size() > 1;
		double share = 0;
		double area = 0;
		for (const BodyPiece &piece : cut.pieces) {
			share += piece.share;
			CHECK(piece.share >= double(limits.pieces.smallest_piece) * (1 - 1e-3));
			CHECK_FALSE(is_folded(piece.hull));
			std::vector<Vec2> now;
			for (const std::uint32_t point : piece.outline) {
				now.push_back(cut.polygon.points[point].position);
			}
			CHECK_FALSE(is_folded(now));
			area += double(signed_area(std::span<const Vec2>(now)));
		}
		CHECK(share == doctest::Approx(1).epsilon(1e-6));
		CHECK(area == doctest::Approx(double(signed_area(body.hull()))).epsilon(1e-4));
	}
	CHECK(torn > 100);
}

TEST_CASE("bad limits are refused by name") {
	const SoftBodyData body = make(bar(), {});
	for (const Real stretch : { Real(0), Real(-1), std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::quiet_NaN() }) {
		const auto tear = plan_tear(body, {}, limits_of(stretch));
		REQUIRE_FALSE(tear);
		CHECK(tear.error().name == "stretch");
	}
	TearLimits limits = limits_of();
	limits.pieces.smallest_piece = Real(0.7);
	const auto tear = plan_tear(body, {}, limits);
	REQUIRE_FALSE(tear);
	CHECK(tear.error().name == "smallest_piece");
}
