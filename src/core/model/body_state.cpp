// SPDX-License-Identifier: MIT
// The state of a body as a value and as bytes.
#include "core/model/body_state.h"

#include "core/geometry/polygon.h"
#include "core/model/body_archive.h"
#include "core/model/soft_body_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

namespace softbody {

namespace {

constexpr std::array<std::uint8_t, 4> MAGIC = { 'S', 'B', '2', 'S' };
constexpr std::uint32_t VERSION = 6;
constexpr const char *DAMAGED = "keep the bytes as they were saved";

constexpr const char *UNSOUND = "restore a sound state";
constexpr const char *OTHER_SHAPE = "restore it into a body of the shape that it was saved from";

Error refused(const std::string &name, const std::string &value, const std::string &bound, const std::string &remedy) {
	return { "state." + name, value, bound, remedy };
}

Status check_count(const char *name, std::size_t count, std::size_t wanted) {
	if (count == wanted) {
		return {};
	}
	return refused(name, std::to_string(count) + " points", "must have the body's " + std::to_string(wanted), OTHER_SHAPE);
}

bool are_all_finite(std::span<const Vec2> values) {
	return std::ranges::all_of(values, [](Vec2 value) { return is_finite(value); });
}

// Checks that need no body. Names are made up where something is wrong only: whole worlds are checked in every tick.
Status check_values(const BodyState &state) {
	bool are_sound = true;
	for (const std::vector<Vec2> *list : { &state.positions, &state.velocities, &state.previous_positions, &state.last_valid_hull, &state.rest_positions }) {
		are_sound = are_sound && are_all_finite(*list);
	}
	if (Status status = are_sound ? Status() : first_error({ check_all_finite("state.positions", state.positions), check_all_finite("state.velocities", state.velocities),
				check_all_finite("state.previous_positions", state.previous_positions),
				check_all_finite("state.last_valid_hull", state.last_valid_hull), check_all_finite("state.rest_positions", state.rest_positions) })) {
		return status;
	}
	const TouchMemory &touch = state.touch;
	bool are_finite = std::isfinite(state.rotation_memory.c) && std::isfinite(state.rotation_memory.s);
	are_finite &= std::isfinite(touch.approach) && std::isfinite(touch.restitution) && std::isfinite(touch.account);
	are_finite &= is_finite(touch.normal) && is_finite(touch.surface_velocity);
	are_finite &= is_finite(state.load.force) && std::isfinite(state.load.torque) && is_finite(state.acceleration);
	are_finite &= std::ranges::all_of(state.pin_targets, [](const PinTarget &each) { return is_finite(each.position); });
	are_finite &= std::ranges::all_of(state.external_forces, [](const ExternalForce &each) { return is_finite(each.force); });
	are_finite &= std::ranges::all_of(state.pair_touches, [](const PairMemory &each) {
		return std::isfinite(each.touch.approach) && std::isfinite(each.touch.missing);
	});
	if (!are_finite) {
		return refused("memory", "non-finite", "must be finite", UNSOUND);
	}
	// Products of rotations leave a unit vector up to rounding, up to 1e-3 for each pose given by a user.
	const Real size = length(Vec2{ state.rotation_memory.c, state.rotation_memory.s });
	if (!(size > Real(0.5) && size < 2)) {
		return refused("rotation_memory", "length " + number_text(size), "must have unit length", UNSOUND);
	}
	if (state.rest.rest_time >= 0 && std::isfinite(state.rest.rest_time) && state.damage_pause >= 0 && std::isfinite(state.damage_pause)) {
		return {};
	}
	return first_error({ check_at_least("state.rest.rest_time", state.rest.rest_time, 0, "s"), check_at_least("state.damage_pause", state.damage_pause, 0, "s") });
}

// FNV-1a.
std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
	std::uint64_t sum = 0xcbf29ce484222325u;
	for (const std::uint8_t byte : bytes) {
		sum = (sum ^ byte) * 0x100000001b3u;
	}
	return sum;
}

} // namespace

Status check_body_state(const BodyState &state, std::size_t point_count, std::size_t hull_count) {
	const std::size_t valid_count = state.last_valid_hull.size();
	if (Status status = first_error({ check_count("positions", state.positions.size(), point_count),
				check_count("velocities", state.velocities.size(), point_count),
				check_count("previous_positions", state.previous_positions.size(), point_count),
				check_count("last_valid_hull", valid_count, valid_count == 0 ? 0 : hull_count),
				check_count("rest_positions", state.rest_positions.size(), state.rest_positions.empty() ? 0 : point_count) })) {
		return status;
	}
	if (!state.rest_positions.empty() && is_folded(std::span(state.rest_positions).first(hull_count))) {
		return refused("rest_positions", "a folded hull", "must be a simple polygon of positive area", UNSOUND);
	}
	for (const std::uint32_t point : state.pinned_points) {
		if (Status status = check_index("state.pinned_points", point, point_count, OTHER_SHAPE)) {
			return status;
		}
	}
	if (std::ranges::adjacent_find(state.pinned_points, std::ranges::greater_equal()) != state.pinned_points.end()) {
		return refused("pinned_points", "out of order", "must ascend", "sort them, each once");
	}
	for (const PinTarget &target : state.pin_targets) {
		if (!std::ranges::binary_search(state.pinned_points, target.point)) {
			return refused("pin_targets", std::to_string(target.point), "must be pinned points", "pin the point as well");
		}
	}
	for (const ExternalForce &external : state.external_forces) {
		if (Status status = check_index("state.external_forces", external.point, point_count, OTHER_SHAPE)) {
			return status;
		}
	}
	return check_values(state);
}

std::vector<std::uint8_t> to_bytes(const BodyState &state) {
	StateWriter body;
	visit_state(state, body);
	StateWriter all;
	all.write(MAGIC);
	all.visit(VERSION);
	all.visit(std::uint32_t(sizeof(Real)));
	all.visit(checksum_of(body.written()));
	all.write(body.written());
	return all.take();
}

Result<BodyState> body_state_from_bytes(std::span<const std::uint8_t> bytes) {
	if (bytes.size() < MAGIC.size() || !std::ranges::equal(MAGIC, bytes.first(MAGIC.size()))) {
		return refused("magic", std::to_string(bytes.size()) + " bytes", "must begin with SB2S", "give what to_bytes made");
	}
	StateReader reader(bytes.subspan(MAGIC.size()));
	if (const auto version = reader.read<std::uint32_t>(); version != VERSION) {
		return refused("version", std::to_string(version), "must be " + std::to_string(VERSION), "save it again with this version");
	}
	if (const auto size = reader.read<std::uint32_t>(); size != sizeof(Real)) {
		return refused("precision", std::to_string(size) + " bytes", "must be " + std::to_string(sizeof(Real)) + " bytes a number",
				"restore it with the build that saved it");
	}
	const auto checksum = reader.read<std::uint64_t>();
	if (!reader.is_valid() || checksum != checksum_of(reader.rest())) {
		return refused("checksum", "another", "must be that of the data", DAMAGED);
	}
	BodyState state;
	visit_state(state, reader);
	if (!reader.is_valid() || !reader.is_at_end()) {
		return refused("length", std::to_string(bytes.size()) + " bytes", "must be what its lists say", DAMAGED);
	}
	if (Status status = check_values(state)) {
		return *status;
	}
	return state;
}

BodyState SoftBodyData::save_state() const {
	BodyState state;
	state.positions.assign(positions().begin(), positions().end());
	state.velocities.assign(velocities().begin(), velocities().end());
	static_cast<BodyMemory &>(state) = memory_;
	state.rest.restored = 0;
	for (std::uint32_t i = 0; i < pinned_inverse_masses_.size(); ++i) {
		if (pinned_inverse_masses_[i] == 0) {
			state.pinned_points.push_back(i);
		}
	}
	state.rotation_memory = rotation_memory();
	state.rest_positions.assign(dents().begin(), dents().end());
	return state;
}

Status SoftBodyData::restore_state(const BodyState &state) {
	if (Status status = check_body_state(state, point_count(), shape_->hull_count())) {
		return status;
	}
	const std::uint32_t restored = memory_.rest.restored + 1;
	wake(); // for bodies that fell asleep with it
	// Bodies that rest on a frozen body wake when it changes.
	const bool is_other = memory_.frozen != state.frozen || !std::ranges::equal(state.positions, positions());
	if (is_other) {
		disturb();
	}
	BodyState copy = state;
	put_back(copy);
	memory_.rest.restored = restored;
	if (is_other && is_frozen()) {
		disturb();
	}
	for (const auto changes : { &ChangeCounts::arrangement, &ChangeCounts::forces, &ChangeCounts::pin_targets, &ChangeCounts::restores }) {
		count(changes);
	}
	return {};
}

void SoftBodyData::put_back(BodyState &state) {
	std::ranges::copy(state.positions, mutable_positions().begin());
	std::ranges::copy(state.velocities, mutable_velocities().begin());
	set_rotation_memory(state.rotation_memory);
	if (!std::ranges::equal(state.rest_positions, dents())) {
		restore_dents(state.rest_positions);
	}
	std::swap(memory_, state.memory());
	pinned_inverse_masses_.clear();
	if (!state.pinned_points.empty()) {
		pinned_inverse_masses_.assign(shape_->inverse_masses().begin(), shape_->inverse_masses().end());
	}
	for (const std::uint32_t point : state.pinned_points) {
		pinned_inverse_masses_[point] = 0;
	}
	frozen_inverse_masses_.assign(is_frozen() ? point_count() : 0, Real(0));
}

} // namespace softbody
