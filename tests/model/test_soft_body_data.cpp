// SPDX-License-Identifier: MIT
// Claims about the state of one body: creation, checked changes, pinning, teleporting.
#include "core/model/soft_body_data.h"
#include "scenes/deformations.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <functional>

using namespace softbody;
using namespace softbody::testing;

namespace {

// Everything of a body that a refused setter could have touched.
struct Snapshot {
	explicit Snapshot(const SoftBodyData &body) :
			positions(copy_of(body.positions())), velocities(copy_of(body.velocities())), previous(copy_of(body.previous_positions())), inverse_masses(body.inverse_masses().begin(), body.inverse_masses().end()), forces(body.external_forces().size()), shape(&body.shape()), settings(body.settings()), memory(body.rotation_memory()) {}

	bool matches(const SoftBodyData &body) const {
		const BodySettings &s = body.settings();
		return identical(positions, body.positions()) && identical(velocities, body.velocities()) &&
				identical(previous, body.previous_positions()) && forces == body.external_forces().size() && shape == &body.shape() &&
				inverse_masses == std::vector<Real>(body.inverse_masses().begin(), body.inverse_masses().end()) &&
				s.friction == settings.friction && s.restitution == settings.restitution && s.substeps == settings.substeps &&
				memory.c == body.rotation_memory().c && memory.s == body.rotation_memory().s;
	}

	std::vector<Vec2> positions, velocities, previous;
	std::vector<Real> inverse_masses;
	std::size_t forces;
	const SoftBodyShape *shape;
	BodySettings settings;
	Rotation memory;
};

SoftBodyData moving_body() {
	SoftBodyData body = thesis_body(thesis_shape(), {}, Pose{ { 3, -2 }, Rotation::from_angle(Real(0.4)) });
	Random random(41);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i] + random.vector(0.1), random.vector(2));
	}
	body.add_external_force(3, { 1, 2 });
	return body;
}

} // namespace

TEST_CASE("a body is created at rest where its pose puts the description") {
	const std::vector<Vec2> outline{ { 10, 20 }, { 14, 20 }, { 14, 23 }, { 10, 23 } };
	const auto shape = SoftBodyCreator::create_polygon(outline, {}).value();
	const Pose pose{ { 100, -50 }, Rotation::from_angle(Real(0.7)) };
	const SoftBodyData body = SoftBodyData::create(shape, {}, pose).value();
	for (std::size_t i = 0; i < outline.size(); ++i) {
		CHECK(distance(body.positions()[i], pose.apply(outline[i])) <= 8 * EPSILON * 150); // numbers up to 150
		CHECK(body.velocities()[i] == Vec2{});
		CHECK(body.inverse_masses()[i] == 1 / shape->masses()[i]);
	}
	CHECK(identical(body.previous_positions(), body.positions()));
	CHECK(body.hull().size() == 4);
	CHECK(body.point_count() == 5);
	CHECK(body.is_active());
	CHECK(body.external_forces().empty());
	CHECK(body.rotation_memory().s == pose.rotation.s);
}

TEST_CASE("a body is not created without a shape, with bad settings, or at a pose that is not finite") {
	CHECK(SoftBodyData::create(nullptr, {}).error().name == "shape");
	BodySettings settings;
	settings.friction = -1;
	CHECK(SoftBodyData::create(thesis_shape(), settings).error().name == "friction");
	for (const Pose &pose : { Pose{ { NOT_A_NUMBER, 0 }, {} }, Pose{ { 0, INFINITE }, {} }, Pose{ {}, { NOT_A_NUMBER, 0 } }, Pose{ {}, { 1, INFINITE } } }) {
		CHECK(SoftBodyData::create(thesis_shape(), {}, pose).error().name == "pose");
	}
}

TEST_CASE("a refused change leaves every bit of the state as it was") {
	const std::vector<std::pair<std::string, std::function<Status(SoftBodyData &)>>> changes{
		{ "point", [](auto &b) { return b.add_external_force(9, { 1, 1 }); } },
		{ "force", [](auto &b) { return b.add_external_force(0, { NOT_A_NUMBER, 1 }); } },
		{ "force", [](auto &b) { return b.add_external_force(0, { 1, INFINITE }); } },
		{ "point", [](auto &b) { return b.apply_impulse(9, { 1, 1 }); } },
		{ "impulse", [](auto &b) { return b.apply_impulse(2, { -INFINITE, 1 }); } },
		{ "point", [](auto &b) { return b.set_point(9, { 1, 1 }, {}); } },
		{ "position", [](auto &b) { return b.set_point(2, { 1, NOT_A_NUMBER }, {}); } },
		{ "velocity", [](auto &b) { return b.set_point(2, { 1, 1 }, { INFINITE, 0 }); } },
		{ "point", [](auto &b) { return b.set_pinned(9, true); } },
		{ "point", [](auto &b) { return b.set_pinned(UINT32_MAX, false); } },
		{ "pose", [](auto &b) { return b.teleport({}, Pose{ { NOT_A_NUMBER, 0 }, {} }); } },
		{ "pose", [](auto &b) { return b.teleport(Pose{ {}, { INFINITE, 0 } }, {}); } },
		{ "pose", [](auto &b) { return b.teleport({}, Pose{ {}, { 2, 0 } }); } },
		{ "pose", [](auto &b) { return b.teleport(Pose{ {}, { Real(0.6), Real(0.6) } }, {}); } },
		{ "pose", [](auto &b) { return b.teleport({}, Pose{ {}, { 0, 0 } }); } },
		{ "shape", [](auto &b) { return b.set_shape(nullptr); } },
		{ "shape", [](auto &b) { return b.set_shape(circle_shape(1, 9, {}).value()); } },
		// The same number of points, but all of them on the hull.
		{ "shape", [](auto &b) { return b.set_shape(circle_shape(1, 9, { 1, 1, 1, false }).value()); } },
		{ "restitution", [](auto &b) {
			 BodySettings settings;
			 settings.friction = 3;
			 settings.restitution = 2;
			 return b.set_settings(settings);
		 } },
	};
	for (const auto &[name, change] : changes) {
		SoftBodyData body = moving_body();
		const Snapshot before(body);
		const Status status = change(body);
		CAPTURE(name);
		REQUIRE(status.has_value());
		CHECK(status->name == name);
		CHECK(before.matches(body));
	}
}

TEST_CASE("an accepted change does what it says, to that point only") {
	SoftBodyData body = moving_body();
	const Snapshot before(body);
	REQUIRE_FALSE(body.set_point(4, { 7, 8 }, { 9, 10 }));
	REQUIRE_FALSE(body.apply_impulse(5, { Real(0.5), -1 }));
	CHECK(body.positions()[4] == Vec2{ 7, 8 });
	CHECK(body.velocities()[4] == Vec2{ 9, 10 });
	// m = 1/9: the impulse changes the velocity by 9 times itself.
	CHECK(distance(body.velocities()[5], before.velocities[5] + Vec2{ Real(4.5), -9 }) <= 8 * EPSILON * 9);
	for (const std::size_t i : { 0u, 1u, 2u, 3u, 6u, 7u, 8u }) {
		CHECK(body.positions()[i] == before.positions[i]);
		CHECK(body.velocities()[i] == before.velocities[i]);
	}
	BodySettings settings;
	settings.friction = 2;
	CHECK_FALSE(body.set_settings(settings));
	CHECK(body.settings().friction == 2);
}

TEST_CASE("a point shows its state and the sum of the forces queued for it") {
	SoftBodyData body = moving_body();
	body.add_external_force(3, { 10, 20 });
	body.add_external_force(4, { 100, 200 });
	const Point2D point = body.point(3);
	CHECK(point.force == Vec2{ 11, 22 });
	CHECK(point.position == body.positions()[3]);
	CHECK(point.velocity == body.velocities()[3]);
	CHECK(point.mass == body.shape().masses()[3]);
	CHECK(point.inverse_mass == 1 / point.mass);
	CHECK(body.point(2).force == Vec2{});
}

TEST_CASE("a pinned point stops, ignores impulses, and keeps its place in a heavier shape until let go") {
	SoftBodyData body = moving_body();
	REQUIRE_FALSE(body.set_pinned(2, true));
	CHECK(body.inverse_masses()[2] == 0);
	CHECK(body.velocities()[2] == Vec2{});
	CHECK_FALSE(body.apply_impulse(2, { 100, 100 }));
	CHECK(body.velocities()[2] == Vec2{});
	CHECK(body.point(2).mass > 0);
	const auto heavier = body.shape().resized(1, 10).value();
	REQUIRE_FALSE(body.set_shape(heavier));
	CHECK(body.shared_shape() == heavier);
	CHECK(body.inverse_masses()[2] == 0);
	CHECK(body.inverse_masses()[1] == 1 / heavier->masses()[1]);
	REQUIRE_FALSE(body.set_pinned(1, true));
	REQUIRE_FALSE(body.set_pinned(2, false));
	CHECK(body.inverse_masses()[2] == 1 / heavier->masses()[2]);
	CHECK(body.has_pins());
	CHECK_FALSE(body.is_free());
	REQUIRE_FALSE(body.set_pinned(1, false)); // the last one
	CHECK_FALSE(body.has_pins());
	CHECK(body.is_free());
}

TEST_CASE("no body is made at a rotation that is not of unit length") {
	const auto made = SoftBodyData::create(circle_shape(1, 9, {}).value(), BodySettings(), Pose{ {}, { 2, 0 } });
	REQUIRE_FALSE(made);
	CHECK(made.error().name == "pose");
	CHECK(made.error().message().find("length 2") != std::string::npos);
}

TEST_CASE("a body that is turned again and again keeps its size") {
	SoftBodyData body = moving_body();
	const auto size = [&body] {
		double sum = 0;
		for (const Vec2 p : body.positions()) {
			sum += double(distance(p, body.positions()[0]));
		}
		return sum;
	};
	const double before = size();
	const Pose turned{ {}, Rotation::from_angle(Real(0.1)) };
	constexpr int TURNS = 300000;
	for (int i = 0; i < TURNS; ++i) {
		REQUIRE_FALSE(body.teleport({}, turned));
	}
	// In float the turn is exact in double, and roundings of the points go either way: their sum grows by the root of their
	// number. In double the cosine and the sine are rounded too, alike in every turn.
	const double turns = sizeof(Real) == 4 ? std::sqrt(double(TURNS)) : double(TURNS);
	CHECK(std::abs(size() / before - 1) <= 4 * EPSILON * turns);
	CHECK(std::abs(double(length(Vec2{ body.rotation_memory().c, body.rotation_memory().s })) - 1) <= 4 * EPSILON);
}

TEST_CASE("a teleport moves points and previous points rigidly and leaves velocities alone") {
	SoftBodyData body = moving_body();
	const Snapshot before(body);
	const Pose from{ { 3, -2 }, Rotation::from_angle(Real(0.4)) };
	const Pose to{ { -10, 5 }, Rotation::from_angle(Real(-1.3)) };
	REQUIRE_FALSE(body.teleport(from, to));
	CHECK(identical(body.velocities(), before.velocities));
	const double angle = -1.3 - 0.4;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double x = double(before.positions[i].x) - 3;
		const double y = double(before.positions[i].y) + 2;
		const Vec2 expected{ Real(-10 + std::cos(angle) * x - std::sin(angle) * y), Real(5 + std::sin(angle) * x + std::cos(angle) * y) };
		// Cosines and sines of rounded angles, and coordinates up to 11.
		CHECK(distance(body.positions()[i], expected) <= 16 * EPSILON * 11);
		// Nothing is drawn in between: the way since the previous positions has only been turned.
		const Vec2 way = body.positions()[i] - body.previous_positions()[i];
		CHECK(distance(way, Rotation::from_angle(Real(angle)).apply(before.positions[i] - before.previous[i])) <= 32 * EPSILON * 11);
	}
	CHECK(std::abs(double(body.rotation_memory().angle()) - (0.4 + angle)) <= 16 * EPSILON);
	REQUIRE_FALSE(body.teleport(to, from));
	CHECK(largest_distance(body.positions(), before.positions) <= 32 * EPSILON * 11);
	CHECK(largest_distance(body.previous_positions(), before.previous) <= 32 * EPSILON * 11);
}
