// SPDX-License-Identifier: MIT
// Bodies of a batch that have to do with colliders move as bodies that are in no batch: to the last bit.
#include "core/dynamics/simulator.h"
#include "scenes/thesis_body.h"
#include "support/batches.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// Two worlds alike, but that bodies of the second ignore a tag that nothing carries: each of them is stepped alone.
struct Twins {
	WorldData batches;
	WorldData singles;
	Simulator with_batches{ batches };
	Simulator without{ singles };

	template <class Work>
	void in_both(const Work &work) {
		work(batches);
		work(singles);
	}
	void add(const SoftBodyData &body) {
		batches.add_soft_body(body);
		SoftBodyData single = body;
		const std::uint64_t nothing[] = { 12345 };
		single.set_ignored_tags(nothing);
		singles.add_soft_body(std::move(single));
	}
	bool are_batches_used() {
		const auto is_full = [](std::uint32_t count) { return count >= PACK_WIDTH; };
		return std::ranges::all_of(batch_sizes(batches), is_full) && std::ranges::none_of(batch_sizes(singles), is_full);
	}
	bool are_equal() const {
		for (std::size_t i = 0; i < batches.soft_bodies().size(); ++i) {
			const SoftBodyData &a = batches.soft_bodies()[i];
			const SoftBodyData &b = singles.soft_bodies()[i];
			if (!std::ranges::equal(a.positions(), b.positions()) || !std::ranges::equal(a.velocities(), b.velocities())) {
				return false;
			}
		}
		return true;
	}
};

SoftBodyData body_at(Vec2 place, const BodySettings &settings = {}) {
	static const auto shape = thesis_shape_with_ratio(300, Real(0.05));
	return thesis_body(shape, settings, { place, {} });
}

} // namespace

TEST_CASE("a heap pressed onto a thin segment is held by it, in the bits of bodies that are stepped alone") {
	Twins twins;
	twins.in_both([](WorldData &world) {
		world.set_gravity({ 0, Real(-9.81) });
		CHECK_FALSE(world.add_collider({ { { -20, 0 }, { 20, 0 } }, 0, {} }));
	});
	Random random(5);
	for (int i = 0; i < 8; ++i) { // a column whose bodies overlap by half, so that each presses the ones below down
		twins.add(body_at({ random.real(-0.1, 0.1), Real(0.5 + 0.5 * i) }));
	}
	CHECK(twins.are_batches_used());
	for (int step = 0; step < 90; ++step) {
		twins.with_batches.simulate(Real(1) / 60);
		twins.without.simulate(Real(1) / 60);
		REQUIRE(twins.are_equal());
	}
	for (const SoftBodyData &body : twins.batches.soft_bodies()) {
		for (const Vec2 p : body.positions()) { CHECK(p.y > Real(-0.05)); }
	}
}

TEST_CASE("a body that is ruined on a collider is reset as if it were alone, and its batch goes on") {
	for (std::size_t ruined = 0; ruined < 4; ++ruined) {
		Twins twins;
		twins.in_both([](WorldData &world) {
			world.set_gravity({ 0, Real(-9.81) });
			CHECK_FALSE(world.add_collider({ { { -1, -1 }, { 20, -1 }, { 20, 0 }, { -1, 0 } }, 0, {} }));
		});
		BodySettings settings;
		settings.collision_layer = 2;
		for (int i = 0; i < 4; ++i) {
			twins.add(body_at({ Real(2 * i), Real(0.45) }, settings));
		}
		CHECK(twins.are_batches_used());
		for (int step = 0; step < 20; ++step) {
			if (step == 5) {
				twins.in_both([&](WorldData &world) {
					SoftBodyData &body = world.soft_bodies()[ruined];
					body.set_point(2, body.positions()[2], { std::numeric_limits<Real>::max() / 2, 0 });
				});
			}
			const StepReport report = twins.with_batches.simulate(Real(1) / 60);
			CHECK(report.reset_bodies.size() == (step == 5 ? 1 : 0));
			CHECK(report.reset_bodies.size() == twins.without.simulate(Real(1) / 60).reset_bodies.size());
			REQUIRE(twins.are_equal());
		}
	}
}

TEST_CASE("a bounce that is under way when its surface goes is given back as to a body alone") {
	Twins twins;
	Surface springy;
	springy.restitution = Real(0.9);
	twins.in_both([&](WorldData &world) {
		CHECK_FALSE(world.add_collider({ { { -1, -1 }, { 20, -1 }, { 20, 0 }, { -1, 0 } }, 0, springy }));
	});
	BodySettings settings;
	settings.collision_layer = 2;
	for (int i = 0; i < 4; ++i) {
		SoftBodyData body = body_at({ Real(2 * i), Real(0.6 + 0.05 * i) }, settings);
		for (std::uint32_t point = 0; point < body.point_count(); ++point) {
			body.set_point(point, body.positions()[point], { 0, -3 });
		}
		twins.add(body);
	}
	CHECK(twins.are_batches_used());
	const auto rising = [&] {
		const auto velocities = twins.batches.soft_bodies()[0].velocities();
		Real sum = 0;
		for (const Vec2 v : velocities) {
			sum += v.y / Real(velocities.size());
		}
		return sum;
	};
	bool is_gone = false;
	for (int step = 0; step < 60; ++step) {
		twins.with_batches.simulate(Real(1) / 60);
		twins.without.simulate(Real(1) / 60);
		REQUIRE(twins.are_equal());
		if (!is_gone && twins.batches.soft_bodies()[0].touch_memory().touching && rising() > 0) {
			CHECK(rising() < 2);
			twins.in_both([](WorldData &world) { world.clear_environment(); });
			is_gone = true;
		}
	}
	CHECK(is_gone);
	CHECK(rising() > Real(2.2)); // what it lacked, as far as its losses until then pay for it
	CHECK(rising() <= Real(0.9 * 3 * 1.01));
}
