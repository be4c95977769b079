// SPDX-License-Identifier: MIT
// The loader of saved states.
#include "core/dynamics/simulator.h"
#include "fuzz/bytes.h"
#include "fuzz/targets.h"
#include "scenes/thesis_body.h"

#include <algorithm>
#include <vector>

namespace softbody::fuzzing {

namespace {

constexpr std::size_t CHECKSUM_AT = 12; // after the magic, the version and the size of a number
constexpr std::size_t PAYLOAD_AT = 20;

SoftBodyData small_body() {
	static const auto shape = testing::thesis_shape();
	BodySettings settings;
	settings.shape_stiffness = 40;
	return testing::thesis_body(shape, settings);
}

// A state that was really saved, with some bytes of it changed, and a checksum that says that all is well.
std::vector<std::uint8_t> damaged_state(Bytes &bytes) {
	SoftBodyData body = small_body();
	if (bytes.chance()) {
		body.set_pinned(2, true);
		body.set_pin_target(2, { 1, 1 });
		body.add_external_force(1, { 1, 2 });
	}
	std::vector<std::uint8_t> state = to_bytes(body.save_state());
	for (int i = bytes.integer(0, 7); i > 0; --i) {
		const std::size_t place = std::size_t(bytes.byte()) * 256 + bytes.byte();
		if (bytes.integer(0, 15) == 0) {
			state.resize(PAYLOAD_AT + place % (2 * state.size()));
		} else {
			state[place % state.size()] = bytes.byte();
		}
	}
	std::uint64_t sum = 0xcbf29ce484222325u; // FNV-1a, as the format has it
	for (std::size_t i = PAYLOAD_AT; i < state.size(); ++i) {
		sum = (sum ^ state[i]) * 0x100000001b3u;
	}
	for (std::size_t i = 0; i < 8 && bytes.integer(0, 7) != 0; ++i) {
		state[CHECKSUM_AT + i] = std::uint8_t(sum >> (8 * i));
	}
	return state;
}

} // namespace

void fuzz_state(std::span<const std::uint8_t> data) {
	Bytes bytes(data);
	const bool is_raw = bytes.chance();
	const std::vector<std::uint8_t> saved =
			is_raw ? std::vector<std::uint8_t>(bytes.rest().begin(), bytes.rest().end()) : damaged_state(bytes);
	const Result<BodyState> state = body_state_from_bytes(saved);
	if (!state) {
		require(!state.error().name.empty() && !state.error().remedy.empty(), "a refusal names the value and a remedy");
		return;
	}
	const std::vector<std::uint8_t> again = to_bytes(state.value());
	const Result<BodyState> twice = body_state_from_bytes(again);
	require(twice.has_value(), "what was read can be written and read again");
	require(to_bytes(twice.value()) == again, "and is the same then");

	SoftBodyData other = small_body();
	const std::vector<std::uint8_t> before = to_bytes(other.save_state());
	if (other.restore_state(state.value())) {
		require(to_bytes(other.save_state()) == before, "a state that is refused changes nothing");
		return;
	}
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	world.add_soft_body(small_body());
	world.add_soft_body(small_body());
	require(!world.soft_bodies()[0].restore_state(state.value()), "what fits one body fits another like it");
	Simulator simulator(world);
	for (int tick = 0; tick < 2; ++tick) {
		simulator.simulate(Real(1) / 60);
		for (const SoftBodyData &each : world.soft_bodies()) {
			require(std::ranges::all_of(each.positions(), [](Vec2 p) { return is_finite(p); }), "what was put back can be stepped");
		}
	}
}

} // namespace softbody::fuzzing
