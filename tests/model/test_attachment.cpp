// SPDX-License-Identifier: MIT
// Claims about places that go with a body.
#include "core/model/attachment.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<Vec2> ring(int count, Real radius) {
	std::vector<Vec2> points;
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * std::numbers::pi * i / count;
		points.push_back({ radius * Real(std::cos(angle)), radius * Real(std::sin(angle)) });
	}
	return points;
}

std::vector<Vec2> moved(std::span<const Vec2> points, const Pose &pose) {
	std::vector<Vec2> result;
	for (const Vec2 point : points) {
		result.push_back(pose.apply(point));
	}
	return result;
}

} // namespace

TEST_CASE("a place in or outside a body that moves as a whole moves as the body does") {
	Random random(1);
	const std::vector<Vec2> rest = ring(16, 1);
	for (int i = 0; i < 300; ++i) {
		const Vec2 place = random.vector(3);
		const Attachment attachment = Attachment::create(rest, place).value();
		const double angle = random.real(-3.1, 3.1);
		const Pose pose{ random.vector(100), Rotation::from_angle(Real(angle)) };
		const Pose now = attachment.follow(moved(rest, pose));
		// A tolerance of some roundings of 100, which is where the body is.
		CHECK(length(now.position - pose.apply(place)) < 100 * 20 * std::numeric_limits<Real>::epsilon());
		CHECK(length(now.rotation.apply({ 1, 0 }) - pose.rotation.apply({ 1, 0 })) < Real(1e-4));
	}
}

TEST_CASE("a place at a point goes where that point goes, whatever the others do") {
	Random random(2);
	const std::vector<Vec2> rest = ring(12, 50);
	for (std::size_t i = 0; i < rest.size(); ++i) {
		const Attachment attachment = Attachment::create(rest, rest[i]).value();
		std::vector<Vec2> points;
		for (std::size_t k = 0; k < rest.size(); ++k) {
			points.push_back(random.vector(80));
		}
		CHECK(length(attachment.follow(points).position - points[i]) < Real(1e-2)); // px: of the other points 1e-11 is left
	}
}

TEST_CASE("a place turns with the flesh around it, not with the body as a whole") {
	// A strip whose right half is turned up by a right angle about the middle.
	std::vector<Vec2> rest;
	std::vector<Vec2> bent;
	for (int i = -20; i <= 20; ++i) {
		for (const Real y : { Real(-1), Real(1) }) {
			rest.push_back({ Real(i), y });
			bent.push_back(i <= 0 ? rest.back() : Vec2{ -y, Real(i) });
		}
	}
	const Attachment left = Attachment::create(rest, { -15, 0 }).value();
	const Attachment right = Attachment::create(rest, { 15, 0 }).value();
	// A point ten times as far has a hundredth of the say in the rotation.
	CHECK(std::abs(left.follow(bent).rotation.angle()) < Real(0.15));
	CHECK(std::abs(right.follow(bent).rotation.angle() - Real(std::numbers::pi / 2)) < Real(0.15));
	CHECK(length(right.follow(bent).position - Vec2{ 0, 15 }) < Real(1.5));
}

TEST_CASE("places beside one another stay beside one another") {
	Random random(3);
	const std::vector<Vec2> rest = ring(16, 50);
	std::vector<Vec2> wobbling;
	for (const Vec2 point : rest) {
		wobbling.push_back(point + random.vector(10));
	}
	Pose last;
	for (int i = 0; i <= 400; ++i) {
		const Vec2 place{ -60 + Real(0.3) * Real(i), 7 }; // through the body, not near a point
		const Pose now = Attachment::create(rest, place).value().follow(wobbling);
		if (i > 0) {
			CHECK(length(now.position - last.position) < Real(1.5)); // five times the way of the place
		}
		last = now;
	}
}

TEST_CASE("where no rotation is defined the given one holds") {
	const std::vector<Vec2> rest = ring(8, 1);
	const Attachment attachment = Attachment::create(rest, { 0, Real(0.5) }).value();
	const std::vector<Vec2> collapsed(8, Vec2{ 3, 4 });
	const Pose now = attachment.follow(collapsed, Rotation::from_angle(1));
	CHECK(now.rotation.angle() == doctest::Approx(1));
	CHECK(length(now.position - Vec2{ 3, 4 }) < 1);
}

TEST_CASE("attachments to nothing, and at nowhere, are refused by name") {
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	CHECK(Attachment::create({}, {}).error().message().find("rest_positions") != std::string::npos);
	CHECK(Attachment::create(ring(3, 1), { nan, 0 }).error().message().find("place") != std::string::npos);
	CHECK_FALSE(Attachment::create(std::vector<Vec2>{ { nan, 0 } }, {}));
}
