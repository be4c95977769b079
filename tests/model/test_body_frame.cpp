// SPDX-License-Identifier: MIT
// Claims about the rigid motion that is read out of a deformed body.
#include "core/model/body_frame.h"
#include "scenes/deformations.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

// The thesis body's points with random masses: a frame that forgets the weights is off.
std::shared_ptr<const SoftBodyShape> uneven_shape(Random &random) {
	const auto even = thesis_shape();
	SoftBodyShape::Description description;
	description.points = copy_of(even->rest_positions());
	description.hull_count = even->hull_count();
	description.springs.assign(even->springs().begin(), even->springs().end());
	for (std::size_t i = 0; i < description.points.size(); ++i) {
		description.masses.push_back(random.real(0.1, 3));
	}
	return SoftBodyShape::create(description).value();
}

} // namespace

TEST_CASE("the frame of a turned, moved, spinning body is exactly that motion") {
	Random random(51);
	for (int i = 0; i < 200; ++i) {
		const auto shape = uneven_shape(random);
		const double angle = random.real(-3.1, 3.1);
		const Pose pose{ random.vector(10), Rotation::from_angle(Real(angle)) };
		SoftBodyData body = thesis_body(shape, {}, pose);
		const Vec2 center = pose.apply(shape->origin_offset());
		const Vec2 velocity = random.vector(5);
		const Real spin = random.real(-20, 20);
		for (std::uint32_t k = 0; k < body.point_count(); ++k) {
			const Vec2 p = body.positions()[k];
			body.set_point(k, p, velocity + perpendicular(p - center) * spin);
		}
		const BodyFrame frame = measure_frame(body);
		// Positions near 10 carry eps * 10, which is 20 eps of the radius; a dozen sums over nine points.
		const double tolerance = 200 * EPSILON;
		CHECK(frame.rotation_defined);
		CHECK(distance(frame.center, center) <= tolerance);
		CHECK(distance(frame.velocity, velocity) <= tolerance * 20);
		CHECK(distance({ frame.rotation.c, frame.rotation.s }, { pose.rotation.c, pose.rotation.s }) <= tolerance);
		CHECK(std::abs(double(frame.angular_velocity) - spin) <= tolerance * 20);
	}
}

TEST_CASE("no other rotation brings the rest shape closer to a deformed body") {
	Random random(52);
	for (int i = 0; i < 50; ++i) {
		const auto shape = uneven_shape(random);
		SoftBodyData body = thesis_body(shape);
		for (std::uint32_t k = 0; k < body.point_count(); ++k) {
			body.set_point(k, body.positions()[k] + random.vector(0.4), {});
		}
		const BodyFrame frame = measure_frame(body);
		const auto misfit = [&](double angle) {
			double sum = 0;
			for (std::size_t k = 0; k < body.point_count(); ++k) {
				const Vec2 q = shape->rest_positions()[k];
				const double x = std::cos(angle) * q.x - std::sin(angle) * q.y + frame.center.x - body.positions()[k].x;
				const double y = std::sin(angle) * q.x + std::cos(angle) * q.y + frame.center.y - body.positions()[k].y;
				sum += double(shape->masses()[k]) * (x * x + y * y);
			}
			return sum;
		};
		const double least = misfit(std::atan2(double(frame.rotation.s), double(frame.rotation.c)));
		for (int step = 0; step < 360; ++step) {
			// The misfit is flat at its minimum, so the rounding of the angle is far below this.
			CHECK(least <= misfit(step * 0.017453292519943295) + 100 * EPSILON);
		}
		CHECK(std::abs(double(length(Vec2{ frame.rotation.c, frame.rotation.s })) - 1) <= 4 * EPSILON);
	}
}

TEST_CASE("the angular velocity of a deforming body is its angular momentum over its present inertia") {
	Random random(53);
	for (int i = 0; i < 50; ++i) {
		const auto shape = uneven_shape(random);
		SoftBodyData body = thesis_body(shape);
		for (std::uint32_t k = 0; k < body.point_count(); ++k) {
			body.set_point(k, body.positions()[k] * Real(2) + random.vector(0.4), random.vector(3));
		}
		const BodyFrame frame = measure_frame(body);
		const Momentum momentum = measure_momentum(body, frame.center);
		double inertia = 0;
		for (std::size_t k = 0; k < body.point_count(); ++k) {
			const double arm = distance(body.positions()[k], frame.center);
			inertia += double(shape->masses()[k]) * arm * arm;
		}
		CHECK(relative_error(frame.angular_velocity, momentum.angular / inertia) <= 100 * EPSILON); // sums of nine terms
	}
}

TEST_CASE("digits are kept far from the origin") {
	const Vec2 far{ 4096, -8192 }; // where float has steps of 1/1024
	SoftBodyData body = thesis_body(thesis_shape(), {}, Pose{ far, {} });
	const BodyFrame frame = measure_frame(body);
	const double grid = EPSILON * 8192;
	CHECK(distance(frame.center, far) <= 2 * grid);
	CHECK(std::abs(double(frame.rotation.angle())) <= 4 * grid / double(THESIS_RADIUS));
}

TEST_CASE("a very fast flight is not mistaken for a spin") {
	SoftBodyData body = thesis_body(thesis_shape());
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], { 70000, -30000 });
	}
	// With the flight left in, arm x v rounds at eps * 0.5 * 76000 a point; without it there is nothing to round.
	CHECK(std::abs(double(measure_frame(body).angular_velocity)) <= 100 * EPSILON);
}

TEST_CASE("a collapsed body keeps its last orientation and has no spin") {
	SoftBodyData body = thesis_body(thesis_shape(), {}, Pose{ {}, Rotation::from_angle(Real(0.6)) });
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, { 1, 2 }, { Real(i), 0 });
	}
	const BodyFrame frame = measure_frame(body);
	CHECK_FALSE(frame.rotation_defined);
	CHECK(frame.rotation.c == body.rotation_memory().c);
	CHECK(frame.rotation.s == body.rotation_memory().s);
	CHECK(frame.angular_velocity == 0);
	CHECK(is_finite(frame.center));
}

TEST_CASE("a mirrored body gives a finite unit rotation, the last one where all fit alike") {
	SoftBodyData body = thesis_body(thesis_shape(), {}, Pose{ {}, Rotation::from_angle(Real(0.6)) });
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 q = body.shape().rest_positions()[i];
		body.set_point(i, { -q.x, q.y }, {});
	}
	const BodyFrame frame = measure_frame(body);
	CHECK(std::abs(double(length(Vec2{ frame.rotation.c, frame.rotation.s })) - 1) <= 8 * EPSILON);
	if (!frame.rotation_defined) { // rounding may decide for some rotation instead
		CHECK(frame.rotation.c == body.rotation_memory().c);
	}
	CHECK(is_finite(frame.center));
}
