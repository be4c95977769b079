// SPDX-License-Identifier: MIT
// Claims about what a fluid does to an outline.
#include "core/dynamics/fluid_forces.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

// Water below y = 0, as y grows downward.
const std::vector<Vec2> SEA{ { -1000, 0 }, { 1000, 0 }, { 1000, 1000 }, { -1000, 1000 } };
constexpr Real EVERYWHERE = 1e9f;

struct Sum {
	Vec2 force;
	double torque = 0; // about `about`
};

Sum sum_of(std::span<const Vec2> points, std::span<const Vec2> forces, Vec2 about = {}) {
	Sum sum;
	for (std::size_t i = 0; i < points.size(); ++i) {
		sum.force += forces[i];
		sum.torque += double(cross(points[i] - about, forces[i]));
	}
	return sum;
}

std::vector<Vec2> moved(std::vector<Vec2> points, Vec2 by) {
	for (Vec2 &point : points) {
		point += by;
	}
	return points;
}

std::vector<Vec2> forces_of(const Fluid &fluid, const std::vector<Vec2> &hull, Vec2 velocity = {}, const std::vector<Vec2> &region = SEA, Real mass = EVERYWHERE) {
	std::vector<Vec2> forces(hull.size());
	const std::vector<Vec2> velocities(hull.size(), velocity);
	add_fluid_forces(fluid, region, hull, velocities, mass, Real(1.0 / 60), forces);
	return forces;
}

// By the number of edges that a ray to the right crosses.
bool contains(std::span<const Vec2> polygon, Vec2 place) {
	bool is_inside = false;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const Vec2 a = polygon[i];
		const Vec2 b = polygon[(i + 1) % polygon.size()];
		if ((a.y > place.y) != (b.y > place.y) && place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y)) {
			is_inside = !is_inside;
		}
	}
	return is_inside;
}

// The part of a disk of radius r below a line at distance d below its middle: a circular segment.
double segment_area(double r, double d) {
	return r * r * std::acos(d / r) - d * std::sqrt(r * r - d * d);
}

} // namespace

TEST_CASE("buoyancy is the weight of the displaced fluid, and acts at the middle of what is under water") {
	const Fluid water{ .density = 2, .drag = 0, .gravity = { 0, 10 } };
	for (const Real depth : { Real(-40), Real(-25), Real(0), Real(25), Real(49), Real(80) }) { // of the middle
		const std::vector<Vec2> disk = moved(circle_hull(50, 256).value(), { 3, depth });
		const Sum sum = sum_of(disk, forces_of(water, disk), { 3, 0 });
		const double area = depth >= 50 ? std::numbers::pi * 2500 : segment_area(50, -double(depth));
		CAPTURE(depth);
		CHECK(double(sum.force.y) == doctest::Approx(-20 * area).epsilon(1e-3));
		CHECK(std::abs(double(sum.force.x)) < 1e-3 * 20 * area);
		CHECK(std::abs(sum.torque) < 1e-3 * 20 * area * 50);
	}
}

TEST_CASE("buoyancy is as exact a million lengths from the origin as the places there are") {
	const Fluid water{ .density = 2, .drag = 0, .gravity = { 0, 10 } };
	const Vec2 far{ 1'000'000, -1'000'000 };
	const std::vector<Vec2> disk = moved(circle_hull(50, 64).value(), far);
	const double area = std::abs(double(signed_area(circle_hull(50, 64).value())));
	CHECK(double(sum_of(disk, forces_of(water, disk, {}, moved(SEA, far))).force.y) == doctest::Approx(-20 * area / 2).epsilon(5e-3));
}

TEST_CASE("a tilted box is righted by the arm of its centroid, whatever its winding") {
	const Fluid water{ .density = 1, .drag = 0, .gravity = { 0, 10 } };
	// A right triangle, half under water: the part below y = 0 is a triangle of its own with corners (-30, 0), (0, 0), (-30, 30).
	std::vector<Vec2> triangle{ { -30, -30 }, { 30, -30 }, { -30, 30 } };
	for (const bool reversed : { false, true }) {
		if (reversed) {
			std::swap(triangle[1], triangle[2]);
		}
		const Sum sum = sum_of(triangle, forces_of(water, triangle));
		CHECK(double(sum.force.y) == doctest::Approx(-10 * 450).epsilon(1e-4));
		CHECK(sum.torque == doctest::Approx(-20.0 * -10 * 450).epsilon(1e-4)); // its centroid lies 20 to the left
	}
}

TEST_CASE("a plate that the fluid meets squarely is pressed by half of density, drag, length and squared speed") {
	const Fluid air{ .density = Real(0.5), .drag = Real(1.2), .flow = { 100, 0 } };
	const std::vector<Vec2> region{ { -500, -500 }, { 500, -500 }, { 500, 500 }, { -500, 500 } };
	const std::vector<Vec2> plate = box_hull({ 10, 80 }, 10).value();
	const Sum wind = sum_of(plate, forces_of(air, plate, {}, region));
	CHECK(double(wind.force.x) == doctest::Approx(0.5 * 0.5 * 1.2 * 80 * 100 * 100).epsilon(1e-4));
	CHECK(double(wind.force.y) == doctest::Approx(0).scale(1));
	// What counts is the difference of both: as fast as the wind, nothing pushes; against it, twice as fast, four times as much.
	CHECK(double(length(sum_of(plate, forces_of(air, plate, { 100, 0 }, region)).force)) == doctest::Approx(0).scale(1));
	CHECK(double(sum_of(plate, forces_of(air, plate, { -100, 0 }, region)).force.x) == doctest::Approx(4 * double(wind.force.x)).epsilon(1e-4));
	// A round body: the integral of cos² θ over its front, 4/3 r of the plate's length.
	std::vector<Vec2> disk = circle_hull(40, 256).value();
	for (int winding = 0; winding < 2; ++winding) {
		CHECK(double(sum_of(disk, forces_of(air, disk, {}, region)).force.x) == doctest::Approx(0.5 * 0.5 * 1.2 * (4.0 / 3 * 40) * 10000).epsilon(1e-3));
		const std::vector<Vec2> forces = forces_of(air, disk, {}, region);
		for (std::size_t i = 0; i < disk.size(); ++i) {
			CHECK((disk[i].x < 2 || length(forces[i]) == 0)); // the lee side is not pulled
		}
		std::ranges::reverse(disk);
	}
}

TEST_CASE("only what is inside of the region feels the fluid") {
	const Fluid air{ .density = 1, .flow = { 100, 0 } };
	const std::vector<Vec2> plate = box_hull({ 10, 80 }, 80).value();
	const std::vector<Vec2> fine_plate = box_hull({ 10, 80 }, 10).value();
	const std::vector<Vec2> below{ { -500, 20 }, { 500, 20 }, { 500, 500 }, { -500, 500 } };
	CHECK(double(sum_of(plate, forces_of(air, plate, {}, below)).force.x) == doctest::Approx(0.5 * 20 * 10000).epsilon(1e-4));
	CHECK(double(sum_of(fine_plate, forces_of(air, fine_plate, {}, below)).force.x) == doctest::Approx(0.5 * 20 * 10000).epsilon(1e-4));
	const std::vector<Vec2> away = moved(below, { 0, 100 });
	CHECK(length(sum_of(plate, forces_of(air, plate, {}, away)).force) == 0);
}

TEST_CASE("drag never takes more than the difference in speed, however light the body is") {
	const Fluid syrup{ .density = 1000, .drag = 100, .viscosity = 1000 };
	const std::vector<Vec2> region{ { -500, -500 }, { 500, -500 }, { 500, 500 }, { -500, 500 } };
	const std::vector<Vec2> disk = circle_hull(40, 24).value();
	const Real mass = Real(1e-6);
	const std::vector<Vec2> forces = forces_of(syrup, disk, { 300, 0 }, region, mass);
	for (const Vec2 force : forces) {
		CHECK(std::abs(300 + double(force.x) / mass / 60) <= 601); // drag and viscosity at once
	}
	const Fluid thick{ .density = 1000, .drag = 0, .viscosity = 1000 };
	const Sum sum = sum_of(disk, forces_of(thick, disk, { 300, 0 }, region, mass));
	CHECK(double(sum.force.x) / (mass * 24) / 60 == doctest::Approx(-300).epsilon(1e-3));
}

TEST_CASE("a polygon and what is left of it have the area that a brute-force count of points finds") {
	Random random(7);
	for (int round = 0; round < 40; ++round) {
		std::vector<Vec2> star;
		for (int i = 0; i < 11; ++i) {
			const double angle = 2 * std::numbers::pi * i / 11;
			const double radius = random.real(10, 50);
			star.push_back({ Real(radius * std::cos(angle)), Real(radius * std::sin(angle)) });
		}
		const double tilt = random.real(0, 6);
		std::vector<Vec2> region;
		for (int i = 0; i < 4; ++i) {
			const double angle = tilt + 2 * std::numbers::pi * i / 4;
			region.push_back({ Real(20 + 40 * std::cos(angle)), Real(40 * std::sin(angle)) });
		}
		const std::vector<Vec2> part = clip_to_convex(star, region);
		int inside = 0;
		for (int y = -60; y < 60; ++y) {
			for (int x = -60; x < 60; ++x) {
				const Vec2 place{ Real(x) + Real(0.5), Real(y) + Real(0.5) };
				inside += contains(star, place) && contains(region, place);
			}
		}
		CHECK((part.size() < 3 ? 0.0 : std::abs(double(signed_area(part)))) == doctest::Approx(inside).epsilon(0.02).scale(1000));
	}
}

TEST_CASE("values that are no fluid are refused by name") {
	CHECK(check_fluid({ .density = 1 }) == std::nullopt);
	CHECK(check_fluid({ .density = -1 })->message().find("density") != std::string::npos);
	CHECK(check_fluid({ .drag = -1 })->message().find("drag") != std::string::npos);
	CHECK(check_fluid({ .viscosity = std::numeric_limits<Real>::quiet_NaN() })->message().find("viscosity") != std::string::npos);
	CHECK(check_fluid({ .flow = { std::numeric_limits<Real>::infinity(), 0 } })->message().find("flow") != std::string::npos);
}
