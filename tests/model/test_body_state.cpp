// SPDX-License-Identifier: MIT
// A body's state goes into a value, into bytes and back; what is damaged or does not fit is refused by name.
#include "core/model/body_state.h"
#include "core/model/world_data.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>
#include <functional>

using namespace softbody;
using namespace softbody::testing;

namespace {

// Every field differs from its default.
BodyState full_state() {
	SoftBodyData body = jelly_circle({ 3, 4 });
	body.set_pinned(2, true);
	body.set_pinned(5, true);
	body.add_external_force(1, { 7, 8 });
	body.apply_impulse(3, { 1, -2 });
	BodyState state = body.save_state();
	state.rotation_memory = Rotation::from_angle(Real(0.3));
	state.touch = { true, 5, Real(0.5), { 0, 1 }, { 3, 2 }, 1.5 };
	state.pair_touches = { { { 3, 9 }, { true, 4 } }, { { 5, 1 }, { true, 2 } } };
	state.one_ways = { { 77, true }, { 78, false } };
	state.rest = { Real(0.25), { 1, 2 }, { 3, 4 }, true, 12, 0x123456789abcdefu, 0 };
	state.last_valid_hull.assign(body.hull().begin(), body.hull().end());
	state.placed = !state.placed;
	state.active = false;
	state.frozen = true;
	state.pin_targets = { { 5, { 3, 1 } } };
	state.load = { { 1, 2 }, 3 };
	state.acceleration = { 4, 5 };
	state.fluids = 0x123456789abcdefu;
	return state;
}

} // namespace

TEST_CASE("a state survives bytes, and a body holds the state that it was given") {
	const BodyState state = full_state();
	const std::vector<std::uint8_t> bytes = to_bytes(state);
	const Result<BodyState> again = body_state_from_bytes(bytes);
	REQUIRE(again);
	CHECK(again.value() == state);
	CHECK(to_bytes(again.value()) == bytes);
	SoftBodyData body = jelly_circle({});
	REQUIRE_FALSE(body.restore_state(state));
	CHECK(body.save_state() == state);
	CHECK(body.is_pinned(2));
	CHECK_FALSE(body.is_pinned(1));
	CHECK(body.inverse_masses()[1] == 0); // frozen
	REQUIRE_FALSE(body.restore_state(jelly_circle({}).save_state()));
	CHECK_FALSE(body.has_pins());
	CHECK(body.save_state() == jelly_circle({}).save_state());
}

TEST_CASE("the bytes are little-endian and begin with a name and a version") {
	const std::vector<std::uint8_t> bytes = to_bytes(BodyState{});
	const std::vector<std::uint8_t> head = { 'S', 'B', '2', 'S', 6, 0, 0, 0, std::uint8_t(sizeof(Real)), 0, 0, 0 };
	CHECK(std::equal(head.begin(), head.end(), bytes.begin()));
}

TEST_CASE("a state that does not fit or is not finite is refused by name, and the body stays as it was") {
	const std::vector<std::pair<const char *, std::function<void(BodyState &)>>> faults = {
		{ "state.positions", [](BodyState &s) { s.positions.pop_back(); } },
		{ "state.velocities", [](BodyState &s) { s.velocities.push_back({}); } },
		{ "state.previous_positions", [](BodyState &s) { s.previous_positions.clear(); } },
		{ "state.last_valid_hull", [](BodyState &s) { s.last_valid_hull.pop_back(); } },
		{ "state.positions[3]", [](BodyState &s) { s.positions[3].x = NOT_A_NUMBER; } },
		{ "state.velocities[0]", [](BodyState &s) { s.velocities[0].y = INFINITE; } },
		{ "state.previous_positions[1]", [](BodyState &s) { s.previous_positions[1].y = INFINITE; } },
		{ "state.last_valid_hull[0]", [](BodyState &s) { s.last_valid_hull[0].y = INFINITE; } },
		{ "state.pinned_points", [](BodyState &s) { s.pinned_points.back() = 17; } },
		{ "state.pinned_points", [](BodyState &s) { s.pinned_points = { 5, 2 }; } },
		{ "state.pinned_points", [](BodyState &s) { s.pinned_points = { 5, 5 }; } },
		{ "state.external_forces", [](BodyState &s) { s.external_forces[0].point = 17; } },
		{ "state.memory", [](BodyState &s) { s.external_forces[0].force.x = NOT_A_NUMBER; } },
		{ "state.pin_targets", [](BodyState &s) { s.pin_targets[0].point = 4; } },
		{ "state.memory", [](BodyState &s) { s.pin_targets[0].position.x = NOT_A_NUMBER; } },
		{ "state.memory", [](BodyState &s) { s.load.torque = NOT_A_NUMBER; } },
		{ "state.memory", [](BodyState &s) { s.acceleration.y = INFINITE; } },
		{ "state.memory", [](BodyState &s) { s.rotation_memory.s = NOT_A_NUMBER; } },
		{ "state.rotation_memory", [](BodyState &s) { s.rotation_memory = { Real(1e30), 0 }; } },
		{ "state.rotation_memory", [](BodyState &s) { s.rotation_memory = { 0, 0 }; } },
		{ "state.memory", [](BodyState &s) { s.touch.approach = NOT_A_NUMBER; } },
		{ "state.memory", [](BodyState &s) { s.touch.restitution = NOT_A_NUMBER; } },
		{ "state.memory", [](BodyState &s) { s.touch.normal.x = NOT_A_NUMBER; } },
		{ "state.memory", [](BodyState &s) { s.touch.surface_velocity.x = NOT_A_NUMBER; } },
		{ "state.memory", [](BodyState &s) { s.pair_touches[1].touch.approach = NOT_A_NUMBER; } },
		{ "state.memory", [](BodyState &s) { s.touch.account = std::numeric_limits<double>::infinity(); } },
		{ "state.rest.rest_time", [](BodyState &s) { s.rest.rest_time = NOT_A_NUMBER; } },
		{ "state.rest.rest_time", [](BodyState &s) { s.rest.rest_time = -1; } },
	};
	SoftBodyData body = jelly_circle({ 1, 1 });
	const BodyState before = body.save_state();
	for (const auto &[name, spoil] : faults) {
		BodyState state = full_state();
		spoil(state);
		const Status status = body.restore_state(state);
		REQUIRE_MESSAGE(status, name);
		CHECK(status->name == name);
		CHECK(body.save_state() == before);
	}
}

TEST_CASE("damaged bytes are refused by name, wherever the damage is") {
	const std::vector<std::uint8_t> bytes = to_bytes(full_state());
	const auto name_of = [](std::vector<std::uint8_t> data) {
		const Result<BodyState> result = body_state_from_bytes(data);
		return result ? std::string("accepted") : result.error().name;
	};
	for (std::size_t length = 0; length < bytes.size(); ++length) {
		CHECK(name_of({ bytes.begin(), bytes.begin() + std::ptrdiff_t(length) }) != "accepted");
	}
	std::vector<std::uint8_t> longer = bytes;
	longer.push_back(0);
	CHECK(name_of(longer) == "state.checksum");
	for (std::size_t i = 0; i < bytes.size(); ++i) {
		std::vector<std::uint8_t> flipped = bytes;
		flipped[i] ^= 0x40;
		const std::string wanted = i < 4 ? "state.magic" : i < 8 ? "state.version" : i < 12 ? "state.precision" : "state.checksum";
		CHECK(name_of(flipped) == wanted);
	}
}

// FNV-1a, written here again: whoever makes bytes on purpose can have the checksum right.
TEST_CASE("bytes with a right checksum but wrong lists or values are refused too, and allocate no more than they hold") {
	const auto signed_again = [](std::vector<std::uint8_t> data) {
		std::uint64_t sum = 0xcbf29ce484222325u;
		for (std::size_t i = 20; i < data.size(); ++i) {
			sum = (sum ^ data[i]) * 0x100000001b3u;
		}
		for (std::size_t i = 0; i < 8; ++i) {
			data[12 + i] = std::uint8_t(sum >> (8 * i));
		}
		return data;
	};
	const std::vector<std::uint8_t> bytes = to_bytes(full_state());
	REQUIRE(body_state_from_bytes(signed_again(bytes)));
	std::vector<std::uint8_t> huge = bytes;
	for (std::size_t i = 20; i < 24; ++i) {
		huge[i] = 0xff; // positions: 4 billion
	}
	REQUIRE_FALSE(body_state_from_bytes(signed_again(huge)));
	CHECK(body_state_from_bytes(signed_again(huge)).error().name == "state.length");
	std::vector<std::uint8_t> no_bool = bytes;
	no_bool[no_bool.size() - 1 - 5 * sizeof(Real) - sizeof(std::uint64_t)] = 2; // whether it is frozen, before load, acceleration and fluids
	CHECK(body_state_from_bytes(signed_again(no_bool)).error().name == "state.length");
	Random random(3);
	int accepted = 0;
	for (int round = 0; round < 3000; ++round) {
		std::vector<std::uint8_t> data = bytes;
		for (int k = random.integer(1, 4); k > 0; --k) {
			data[std::size_t(random.integer(20, int(data.size()) - 1))] = std::uint8_t(random.integer(0, 255));
		}
		if (const Result<BodyState> result = body_state_from_bytes(signed_again(data))) {
			++accepted;
			SoftBodyData body = jelly_circle({});
			body.restore_state(result.value()); // must not crash, whatever it says
			for (const Vec2 p : body.positions()) {
				CHECK(is_finite(p));
			}
		}
	}
	CHECK(accepted > 100); // other numbers are as good
}
