// SPDX-License-Identifier: MIT
// The state of a body as a value and as bytes.
#include "core/model/body_state.h"

#include "core/model/soft_body_data.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

namespace softbody {

namespace {

constexpr std::array<std::uint8_t, 4> MAGIC = { 'S', 'B', '2', 'S' };
constexpr std::uint32_t VERSION = 1;
constexpr const char *DAMAGED = "keep the bytes as they were saved";

Error refused(const std::string &name, const std::string &value, const std::string &bound, const std::string &remedy) {
	return { "state." + name, value, bound, remedy };
}

Status check_count(const char *name, std::size_t count, std::size_t wanted) {
	if (count == wanted) {
		return {};
	}
	return refused(name, std::to_string(count) + " points", "must have the body's " + std::to_string(wanted),
			"restore it into a body of the shape that it was saved from");
}

Status check_points(const char *name, std::span<const Vec2> points) {
	for (std::size_t i = 0; i < points.size(); ++i) {
		if (!is_finite(points[i])) {
			return refused(std::string(name) + "[" + std::to_string(i) + "]", "non-finite", "must be finite", "restore a sound state");
		}
	}
	return {};
}

Status check_index(const char *name, std::size_t index, std::size_t count) {
	if (index < count) {
		return {};
	}
	return refused(name, std::to_string(index), "must be below " + std::to_string(count),
			"restore it into a body of the shape that it was saved from");
}

// Checks that need no body.
Status check_values(const BodyState &state) {
	using List = std::pair<const char *, const std::vector<Vec2> *>;
	for (const auto &[name, points] : { List{ "positions", &state.positions }, List{ "velocities", &state.velocities },
				 List{ "previous_positions", &state.previous_positions }, List{ "last_valid_hull", &state.last_valid_hull } }) {
		if (Status status = check_points(name, *points)) {
			return status;
		}
	}
	const TouchMemory &touch = state.touch;
	bool are_finite = std::isfinite(state.rotation_memory.c) && std::isfinite(state.rotation_memory.s);
	are_finite &= std::isfinite(touch.approach) && std::isfinite(touch.restitution);
	are_finite &= is_finite(touch.normal) && is_finite(touch.surface_velocity);
	are_finite &= is_finite(state.load.force) && std::isfinite(state.load.torque) && is_finite(state.acceleration);
	are_finite &= std::ranges::all_of(state.pin_targets, [](const PinTarget &each) { return is_finite(each.position); });
	are_finite &= std::ranges::all_of(state.external_forces, [](const ExternalForce &each) { return is_finite(each.force); });
	are_finite &= std::ranges::all_of(state.pair_touches, [](const PairMemory &each) {
		return std::isfinite(each.touch.approach) && std::isfinite(each.touch.energy);
	});
	if (!are_finite) {
		return refused("memory", "non-finite", "must be finite", "restore a sound state");
	}
	// Products of rotations leave a unit vector up to rounding, up to 1e-3 for each pose given by a user.
	const Real size = length(Vec2{ state.rotation_memory.c, state.rotation_memory.s });
	if (!(size > Real(0.5) && size < 2)) {
		return refused("rotation_memory", "length " + number_text(size), "must have unit length", "restore a sound state");
	}
	return check_at_least("state.rest.rest_time", state.rest.rest_time, 0, "s");
}

class Writer {
public:
	template <class Bits>
	void add_bits(Bits bits) {
		for (std::size_t i = 0; i < sizeof(Bits); ++i) {
			bytes.push_back(std::uint8_t(bits >> (8 * i)));
		}
	}
	void add(std::uint32_t value) { add_bits(value); }
	void add(std::uint64_t value) { add_bits(value); }
	void add(bool value) { bytes.push_back(value ? 1 : 0); }
	void add(float value) { add_bits(std::bit_cast<std::uint32_t>(value)); }
	void add(double value) { add_bits(std::bit_cast<std::uint64_t>(value)); }
	void add(Vec2 value) {
		add(value.x);
		add(value.y);
	}
	template <class Item>
	void add_list(const std::vector<Item> &items, const auto &add_item) {
		add(std::uint32_t(items.size()));
		for (const Item &item : items) {
			add_item(item);
		}
	}

	std::vector<std::uint8_t> bytes;
};

/// Past the end, or after invalid data, everything reads as 0 and `is_valid` stays false.
class Reader {
public:
	explicit Reader(std::span<const std::uint8_t> bytes) :
			rest_(bytes) {}

	template <class Bits>
	Bits bits() {
		if (rest_.size() < sizeof(Bits)) {
			is_valid_ = false;
			rest_ = {};
			return 0;
		}
		Bits bits = 0;
		for (std::size_t i = 0; i < sizeof(Bits); ++i) {
			bits = Bits(bits | Bits(rest_[i]) << (8 * i));
		}
		rest_ = rest_.subspan(sizeof(Bits));
		return bits;
	}
	void read(std::uint32_t &value) { value = bits<std::uint32_t>(); }
	void read(std::uint64_t &value) { value = bits<std::uint64_t>(); }
	void read(bool &value) {
		const std::uint8_t byte = bits<std::uint8_t>();
		is_valid_ &= byte <= 1;
		value = byte == 1;
	}
	void read(float &value) { value = std::bit_cast<float>(bits<std::uint32_t>()); }
	void read(double &value) { value = std::bit_cast<double>(bits<std::uint64_t>()); }
	void read(Vec2 &value) {
		read(value.x);
		read(value.y);
	}
	/// Every item has at least `item_size` bytes: a count beyond the remaining bytes is refused before any allocation.
	template <class Item>
	void read_list(std::vector<Item> &items, std::size_t item_size, const auto &read_item) {
		const std::uint32_t count = bits<std::uint32_t>();
		if (count > rest_.size() / item_size) {
			is_valid_ = false;
			rest_ = {};
			return;
		}
		items.resize(count);
		for (Item &item : items) {
			read_item(item);
		}
	}
	bool is_valid() const { return is_valid_; }
	bool is_at_end() const { return rest_.empty(); }
	std::span<const std::uint8_t> rest() const { return rest_; }

private:
	std::span<const std::uint8_t> rest_;
	bool is_valid_ = true;
};

// FNV-1a.
std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
	std::uint64_t sum = 0xcbf29ce484222325u;
	for (const std::uint8_t byte : bytes) {
		sum = (sum ^ byte) * 0x100000001b3u;
	}
	return sum;
}

/// Calls `each` for every value, in the order of the bytes.
template <class State>
void visit_values(State &state, const auto &each) {
	each(state.rotation_memory.c);
	each(state.rotation_memory.s);
	each(state.touch.touching);
	each(state.touch.approach);
	each(state.touch.restitution);
	each(state.touch.normal);
	each(state.touch.surface_velocity);
	each(state.rest.rest_time);
	each(state.rest.asleep);
	each(state.rest.island);
	each(state.rest.surroundings);
	each(state.active);
	each(state.frozen);
	each(state.load.force);
	each(state.load.torque);
	each(state.acceleration);
}

template <class Memory>
void visit_pair(Memory &memory, const auto &each) {
	each(memory.other.index);
	each(memory.other.generation);
	each(memory.touch.touching);
	each(memory.touch.approach);
	each(memory.touch.energy);
}

} // namespace

Status check_body_state(const BodyState &state, std::size_t point_count, std::size_t hull_count) {
	if (Status status = check_count("positions", state.positions.size(), point_count)) {
		return status;
	}
	if (Status status = check_count("velocities", state.velocities.size(), point_count)) {
		return status;
	}
	if (Status status = check_count("previous_positions", state.previous_positions.size(), point_count)) {
		return status;
	}
	if (!state.last_valid_hull.empty()) {
		if (Status status = check_count("last_valid_hull", state.last_valid_hull.size(), hull_count)) {
			return status;
		}
	}
	for (std::size_t i = 0; i < state.pinned_points.size(); ++i) {
		if (Status status = check_index("pinned_points", state.pinned_points[i], point_count)) {
			return status;
		}
		if (i > 0 && state.pinned_points[i] <= state.pinned_points[i - 1]) {
			return refused("pinned_points", "out of order", "must ascend", "sort them, each once");
		}
	}
	for (const PinTarget &target : state.pin_targets) {
		if (!std::ranges::binary_search(state.pinned_points, target.point)) {
			return refused("pin_targets", std::to_string(target.point), "must be pinned points", "pin the point as well");
		}
	}
	for (const ExternalForce &external : state.external_forces) {
		if (Status status = check_index("external_forces", external.point, point_count)) {
			return status;
		}
	}
	return check_values(state);
}

std::vector<std::uint8_t> to_bytes(const BodyState &state) {
	Writer body;
	const auto add = [&](const auto &value) { body.add(value); };
	for (const auto *points : { &state.positions, &state.velocities, &state.previous_positions, &state.last_valid_hull }) {
		body.add_list(*points, add);
	}
	body.add_list(state.pinned_points, add);
	body.add_list(state.external_forces, [&](const ExternalForce &external) {
		body.add(external.point);
		body.add(external.force);
	});
	body.add_list(state.pin_targets, [&](const PinTarget &target) {
		body.add(target.point);
		body.add(target.position);
	});
	body.add_list(state.pair_touches, [&](const PairMemory &memory) { visit_pair(memory, add); });
	body.add_list(state.one_ways, [&](const OneWayMemory &memory) {
		body.add(memory.collider);
		body.add(memory.held);
	});
	visit_values(state, add);

	Writer all;
	all.bytes.assign(MAGIC.begin(), MAGIC.end());
	all.add(VERSION);
	all.add(std::uint32_t(sizeof(Real)));
	all.add(checksum_of(body.bytes));
	all.bytes.insert(all.bytes.end(), body.bytes.begin(), body.bytes.end());
	return all.bytes;
}

Result<BodyState> body_state_from_bytes(std::span<const std::uint8_t> bytes) {
	if (bytes.size() < MAGIC.size() || !std::ranges::equal(MAGIC, bytes.first(MAGIC.size()))) {
		return refused("magic", std::to_string(bytes.size()) + " bytes", "must begin with SB2S", "give what to_bytes made");
	}
	Reader reader(bytes.subspan(MAGIC.size()));
	if (const std::uint32_t version = reader.bits<std::uint32_t>(); version != VERSION) {
		return refused("version", std::to_string(version), "must be " + std::to_string(VERSION), "save it again with this version");
	}
	if (const std::uint32_t size = reader.bits<std::uint32_t>(); size != sizeof(Real)) {
		return refused("precision", std::to_string(size) + " bytes", "must be " + std::to_string(sizeof(Real)) + " bytes a number",
				"restore it with the build that saved it");
	}
	const std::uint64_t checksum = reader.bits<std::uint64_t>();
	if (!reader.is_valid() || checksum != checksum_of(reader.rest())) {
		return refused("checksum", "another", "must be that of the data", DAMAGED);
	}
	BodyState state;
	const auto read = [&](auto &value) { reader.read(value); };
	for (auto *points : { &state.positions, &state.velocities, &state.previous_positions, &state.last_valid_hull }) {
		reader.read_list(*points, 2 * sizeof(Real), read);
	}
	reader.read_list(state.pinned_points, sizeof(std::uint32_t), read);
	reader.read_list(state.external_forces, sizeof(std::uint32_t) + 2 * sizeof(Real), [&](ExternalForce &external) {
		reader.read(external.point);
		reader.read(external.force);
	});
	reader.read_list(state.pin_targets, sizeof(std::uint32_t) + 2 * sizeof(Real), [&](PinTarget &target) {
		reader.read(target.point);
		reader.read(target.position);
	});
	reader.read_list(state.pair_touches, 2 * sizeof(std::uint32_t) + 1 + sizeof(Real) + sizeof(double),
			[&](PairMemory &memory) { visit_pair(memory, read); });
	reader.read_list(state.one_ways, sizeof(std::uint64_t) + 1, [&](OneWayMemory &memory) {
		reader.read(memory.collider);
		reader.read(memory.held);
	});
	visit_values(state, read);
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
	state.previous_positions = previous_positions_;
	for (std::uint32_t i = 0; i < pinned_inverse_masses_.size(); ++i) {
		if (pinned_inverse_masses_[i] == 0) {
			state.pinned_points.push_back(i);
		}
	}
	state.pin_targets = pin_targets_;
	state.external_forces = external_forces_;
	state.load = load_;
	state.acceleration = acceleration_;
	state.rotation_memory = rotation_memory();
	state.touch = touch_memory_;
	state.pair_touches = pair_memories_;
	state.one_ways = one_ways_;
	state.rest = rest_state_;
	state.rest.restored = 0;
	state.last_valid_hull = last_valid_hull_;
	state.active = active_;
	state.frozen = frozen_;
	return state;
}

Status SoftBodyData::restore_state(const BodyState &state) {
	if (Status status = check_body_state(state, point_count(), shape_->hull_count())) {
		return status;
	}
	const std::uint32_t restored = rest_state_.restored + 1;
	wake(); // for bodies that fell asleep with it
	// Bodies that rest on a frozen body wake when it changes.
	const bool is_other = frozen_ != state.frozen || !std::ranges::equal(state.positions, positions());
	if (is_other) {
		disturb();
	}
	std::ranges::copy(state.positions, mutable_positions().begin());
	std::ranges::copy(state.velocities, mutable_velocities().begin());
	previous_positions_ = state.previous_positions;
	pinned_inverse_masses_.clear();
	if (!state.pinned_points.empty()) {
		pinned_inverse_masses_.assign(shape_->inverse_masses().begin(), shape_->inverse_masses().end());
	}
	for (const std::uint32_t point : state.pinned_points) {
		pinned_inverse_masses_[point] = 0;
	}
	external_forces_ = state.external_forces;
	set_rotation_memory(state.rotation_memory);
	touch_memory_ = state.touch;
	pair_memories_ = state.pair_touches;
	one_ways_ = state.one_ways;
	rest_state_ = state.rest;
	rest_state_.restored = restored;
	last_valid_hull_ = state.last_valid_hull;
	active_ = state.active;
	frozen_ = state.frozen;
	frozen_inverse_masses_.assign(frozen_ ? point_count() : 0, Real(0));
	if (is_other && frozen_) {
		disturb();
	}
	pin_targets_ = state.pin_targets;
	load_ = state.load;
	acceleration_ = state.acceleration;
	if (changes_) {
		++changes_->arrangement;
		++changes_->forces;
		++changes_->pin_targets;
		++changes_->restores;
	}
	return {};
}

} // namespace softbody
