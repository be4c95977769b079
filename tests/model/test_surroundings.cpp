// SPDX-License-Identifier: MIT
// Claims about borders, colliders and their validators.
#include "core/model/surroundings.h"
#include "scenes/jelly.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <functional>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("a border needs a finite plane with a normal of unit length") {
	CHECK_FALSE(check_border(floor_at(100)));
	CHECK_FALSE(check_border({ { {}, { Real(0.6), Real(0.8005) } }, {} })); // to 1e-3
	for (const Vec2 normal : { Vec2{ 0, 0 }, Vec2{ 0, Real(1.002) }, Vec2{ 0, Real(0.998) }, Vec2{ NOT_A_NUMBER, 1 }, Vec2{ 0, INFINITE } }) {
		const Status status = check_border({ { {}, normal }, {} });
		REQUIRE(status.has_value());
		CHECK(status->name == "border.normal");
	}
	for (const Vec2 position : { Vec2{ NOT_A_NUMBER, 0 }, Vec2{ 0, INFINITE } }) {
		const Status status = check_border({ { position, { 0, 1 } }, {} });
		REQUIRE(status.has_value());
		CHECK(status->name == "border.position");
	}
}

TEST_CASE("points, segments, polygons and their rounded kin are colliders") {
	const std::vector<Collider> good{
		{ { { 3, 4 } }, 2, {} },
		{ { { 3, 4 }, { 5, 6 } }, 0, {} },
		{ { { 3, 4 }, { 5, 6 } }, 1, {} },
		{ { { 0, 0 }, { 1, 0 }, { 0, 1 } }, 0, {} },
		box_collider({ 5, 5 }, { 1, 2 }),
		{ { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 2 } }, Real(0.5), {} }, // a corner of 180 degrees
	};
	for (const Collider &collider : good) {
		CHECK_FALSE(check_collider(collider));
	}
}

TEST_CASE("every kind of bad collider is refused by name") {
	struct Case {
		std::vector<std::string> parts;
		Collider collider;
	};
	const std::vector<Case> cases{
		{ { "collider.vertices", "0 points" }, {} },
		{ { "collider.radius", "> 0" }, { { { 1, 1 } }, 0, {} } },
		{ { "collider.radius", "-1" }, { { { 1, 1 }, { 2, 2 } }, -1, {} } },
		{ { "collider.radius", "nan" }, { { { 1, 1 } }, NOT_A_NUMBER, {} } },
		{ { "collider.radius", "inf" }, { { { 1, 1 } }, INFINITE, {} } },
		{ { "collider.vertices[1]", "finite" }, { { { 1, 1 }, { 2, NOT_A_NUMBER } }, 1, {} } },
		{ { "collider.vertices[0]", "finite" }, { { { INFINITE, 1 } }, 1, {} } },
		{ { "collider.vertices[0]", "coincides" }, { { { 1, 1 }, { 1, 1 } }, 1, {} } },
		{ { "collider.vertices[2]", "coincides" }, { { { 0, 0 }, { 1, 0 }, { 0, 0 } }, 0, {} } },
		{ { "convex" }, { { { 0, 0 }, { 0, 1 }, { 1, 0 } }, 0, {} } }, // winds negatively
		{ { "collider.vertices[1]", "convex" }, { { { 0, 0 }, { 4, 0 }, { 1, 1 }, { 0, 4 } }, 0, {} } },
		{ { "area" }, { { { 0, 0 }, { 1, 1 }, { 2, 2 } }, 0, {} } },
	};
	for (const Case &bad : cases) {
		const Status status = check_collider(bad.collider);
		REQUIRE(status.has_value());
		CAPTURE(status->message());
		for (const std::string &part : bad.parts) {
			CAPTURE(part);
			CHECK(mentions(status->message(), part));
		}
	}
}

TEST_CASE("a star that turns the same way at every corner is not convex") {
	// A pentagram: five left turns, but two rounds.
	Collider star;
	for (int i = 0; i < 5; ++i) {
		star.vertices.push_back(Rotation::from_angle(Real(i * 2 * 1.2566370614359172)).apply({ 1, 0 }));
	}
	CHECK(check_collider(star).has_value());
}

TEST_CASE("bad surface values are refused on borders and colliders alike") {
	const std::vector<std::pair<std::string, std::function<void(Surface &)>>> cases{
		{ "surface.friction", [](Surface &s) { s.friction = Real(-0.1); } },
		{ "surface.friction", [](Surface &s) { s.friction = NOT_A_NUMBER; } },
		{ "surface.restitution", [](Surface &s) { s.restitution = Real(1.1); } },
		{ "surface.restitution", [](Surface &s) { s.restitution = Real(-0.1); } },
		{ "surface.linear_velocity", [](Surface &s) { s.linear_velocity.y = NOT_A_NUMBER; } },
		{ "surface.velocity_origin", [](Surface &s) { s.velocity_origin.x = INFINITE; } },
		{ "surface.angular_velocity", [](Surface &s) { s.angular_velocity = NOT_A_NUMBER; } },
	};
	for (const auto &[name, spoil] : cases) {
		CAPTURE(name);
		Border border = floor_at(0);
		spoil(border.surface);
		Collider collider = box_collider({}, { 1, 1 });
		spoil(collider.surface);
		const Status of_border = check_border(border);
		const Status of_collider = check_collider(collider);
		REQUIRE((of_border && of_collider));
		CHECK(of_border->name == name);
		CHECK(of_collider->name == name);
	}
}

TEST_CASE("a turning surface moves like a wheel about its origin") {
	Surface surface;
	surface.linear_velocity = { 1, 0 };
	surface.velocity_origin = { 10, 10 };
	surface.angular_velocity = 2;
	CHECK(surface.velocity_at({ 10, 10 }) == Vec2{ 1, 0 });
	CHECK(surface.velocity_at({ 13, 10 }) == Vec2{ 1, 6 });
	CHECK(surface.velocity_at({ 10, 11 }) == Vec2{ -1, 0 });
}

TEST_CASE("a collider's box contains its rounding") {
	const Collider capsule{ { { 1, 2 }, { 5, -3 } }, 2, {} };
	CHECK(capsule.bounds().min == Vec2{ -1, -5 });
	CHECK(capsule.bounds().max == Vec2{ 7, 4 });
}
