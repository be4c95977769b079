// SPDX-License-Identifier: MIT
// The state of a whole world as bytes.
#include "core/dynamics/world_state.h"

#include "core/base/hash.h"
#include "core/model/body_archive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace softbody {

namespace {

// The bytes begin with these letters, the version, the size of `Real`, and a checksum of all that follows.
constexpr std::array<std::uint8_t, 4> MAGIC = { 'S', 'B', '2', 'W' };
constexpr std::uint32_t VERSION = 2;
constexpr std::size_t AT_CHECKSUM = 12;
constexpr std::size_t HEAD = 20;
constexpr std::uint32_t AS_IN_BASE = 0; // in the place of a record's size
constexpr const char *DAMAGED = "keep the bytes as they were saved";
constexpr const char *OTHER_STRUCTURE = "give it back the structure that it had then; of a body that was cut, restore its own state first";

// Four sums side by side over words of eight bytes, as one would wait for each product.
std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
	constexpr std::uint64_t FACTOR = 0x9e3779b97f4a7c15u; // odd: no product loses a bit of its factor
	std::array<std::uint64_t, 4> sums{ 1, 2, 3, 4 };
	StateReader reader(bytes);
	const auto add = [](std::uint64_t &sum, std::uint64_t word) { sum = std::rotl((sum ^ word) * FACTOR, 29); };
	std::size_t at = 0;
	if constexpr (std::endian::native == std::endian::little) {
		for (; at + 32 <= bytes.size(); at += 32) {
			std::array<std::uint64_t, 4> words;
			std::memcpy(words.data(), bytes.data() + at, 32);
			for (std::size_t i = 0; i < 4; ++i) {
				add(sums[i], words[i]);
			}
		}
	} else {
		for (; at + 32 <= bytes.size(); at += 32) {
			for (std::size_t i = 0; i < 4; ++i) {
				add(sums[i], reader.read<std::uint64_t>());
			}
		}
	}
	for (; at < bytes.size(); ++at) {
		add(sums[at % 4], bytes[at]);
	}
	Hash sum;
	for (const std::uint64_t each : sums) {
		sum.add(mixed(each));
	}
	sum.add(std::uint64_t(bytes.size()));
	return sum.value() | 1; // 0 stands for no base
}

Error refused(const std::string &name, const std::string &value, const std::string &bound, const std::string &remedy) {
	return { name, value, bound, remedy };
}

/// A body as `visit_state` shows it, without a copy.
struct BodyView {
	std::span<const Vec2> positions;
	std::span<const Vec2> velocities;
	std::span<const Vec2> rest_positions;
	std::vector<std::uint32_t> pinned_points;
	Rotation rotation_memory;
	const BodyMemory *of_body = nullptr;

	explicit BodyView(const SoftBodyData &body) :
			positions(body.positions()), velocities(body.velocities()), rest_positions(body.dents()),
			rotation_memory(body.rotation_memory()), of_body(&body.memory()) {
		for (std::uint32_t i = 0; body.has_pins() && i < body.point_count(); ++i) {
			if (body.is_pinned(i)) {
				pinned_points.push_back(i);
			}
		}
	}
	const BodyMemory &memory() const { return *of_body; }
};

// What says of which structure a body is.
struct Structure {
	std::uint32_t point_count = 0;
	std::uint32_t hull_count = 0;
	Real radius = 0;
	Vec2 origin_offset;

	Structure() = default;
	explicit Structure(const SoftBodyShape &shape) :
			point_count(std::uint32_t(shape.point_count())), hull_count(std::uint32_t(shape.hull_count())), radius(shape.radius()),
			origin_offset(shape.origin_offset()) {}
	friend bool operator==(const Structure &, const Structure &) = default;
};

void visit_structure(auto &structure, auto &archive) {
	archive.visit(structure.point_count);
	archive.visit(structure.hull_count);
	archive.visit(structure.radius);
	archive.visit(structure.origin_offset);
}

void visit_id(auto &id, auto &archive) {
	archive.visit(id.index);
	archive.visit(id.generation);
}

void visit_order(auto &order, auto &archive) {
	constexpr std::size_t INDEX = sizeof(std::uint32_t);
	const auto number = [&](auto &each) { archive.visit(each); };
	archive.visit_list(order.ids, 2 * INDEX, [&](auto &id) { visit_id(id, archive); });
	archive.visit_list(order.generations, INDEX, number);
	archive.visit_list(order.free, INDEX, number);
}

template <class Archive>
void visit_kind(auto &kind, std::uint8_t most, Archive &archive) {
	if constexpr (std::is_same_v<Archive, StateReader>) {
		const auto number = archive.template read<std::uint8_t>();
		if (number > most) {
			archive.fail();
			return;
		}
		kind = std::remove_reference_t<decltype(kind)>(number);
	} else {
		archive.visit(std::uint8_t(kind));
	}
}

void visit_anchor(auto &anchor, auto &archive) {
	visit_kind(anchor.kind, std::uint8_t(JointAnchor::Kind::RIGID_BODY), archive);
	visit_id(anchor.body, archive);
	archive.visit(anchor.point);
	archive.visit(anchor.fraction);
	archive.visit(anchor.position);
	archive.visit(anchor.tag);
}

void visit_joint(auto &joint, auto &archive) {
	visit_anchor(joint.first, archive);
	visit_anchor(joint.second, archive);
	archive.visit(joint.rest_length);
	archive.visit(joint.stiffness);
	archive.visit(joint.damping);
	archive.visit(joint.break_force);
	archive.visit(joint.collide_joined);
}

/// Shows what a world remembers to a `StateWriter` or `StateReader`.
void visit_memory(auto &memory, auto &archive) {
	constexpr std::size_t ID = 2 * sizeof(std::uint32_t);
	constexpr std::size_t JOINT = 2 * (1 + ID + sizeof(std::uint32_t) + 3 * sizeof(Real) + sizeof(std::uint64_t)) + 4 * sizeof(Real) + 1;
	visit_order(memory.bodies, archive);
	archive.visit_list(memory.exceptions, 2 * ID, [&](auto &exception) {
		visit_id(exception.a, archive);
		visit_id(exception.b, archive);
	});
	visit_order(memory.joint_order, archive);
	archive.visit_list(memory.joints, JOINT, [&](auto &joint) { visit_joint(joint, archive); });
	archive.visit(memory.put_to_sleep);
	archive.visit_list(memory.woken_islands, sizeof(std::uint64_t) + sizeof(std::uint32_t), [&](auto &woken) {
		archive.visit(woken.island);
		archive.visit(woken.restored);
	});
	archive.visit_list(memory.disturbed_boxes, 4 * sizeof(Real), [&](auto &box) {
		archive.visit(box.min);
		archive.visit(box.max);
	});
}

void visit_touches(auto &touches, auto &archive) {
	constexpr std::size_t TOUCH = 4 * sizeof(std::uint32_t) + 1 + sizeof(std::uint64_t) + sizeof(Real);
	archive.visit_list(touches, TOUCH, [&](auto &touch) {
		visit_id(touch.body, archive);
		visit_kind(touch.other.kind, std::uint8_t(ContactOther::Kind::COLLIDER), archive);
		visit_id(touch.other.body, archive);
		archive.visit(touch.other.tag);
		archive.visit(touch.apart);
	});
}

// Whether the points of a record are others, for sure. Most bodies that differ do so there, which is found without a record of them.
bool has_moved(std::span<const std::uint8_t> record, const SoftBodyData &body) {
	constexpr std::size_t AT_POSITIONS = 3 * sizeof(std::uint32_t) + 3 * sizeof(Real); // after structure and count
	const std::span<const Vec2> positions = body.positions();
	return POINTS_ARE_BYTES && record.size() >= AT_POSITIONS + positions.size_bytes() &&
			std::memcmp(record.data() + AT_POSITIONS, positions.data(), positions.size_bytes()) != 0;
}

} // namespace

// Saving.

void WorldState::write_record(const SoftBodyData &body, std::size_t index, const Companion &companion, StateWriter &to) {
	const Structure structure(*body.shared_shape());
	visit_structure(structure, to);
	const BodyView view(body);
	visit_state(view, to);
	to.visit(body.memory().rest.restored);
	if (companion.write_body) {
		companion.write_body(index, to);
	}
}

void WorldState::write_world(const Simulator &simulator, const Companion &companion, StateWriter &to) const {
	const WorldData::Memory memory = simulator.world().memory();
	visit_memory(memory, to);
	const std::span<const Touch> touches = simulator.touches();
	visit_touches(touches, to);
	if (companion.write_world) {
		companion.write_world(to);
	}
}

Result<std::vector<std::uint8_t>> WorldState::save(const Simulator &simulator, const Companion &companion,
		std::span<const std::uint8_t> base, std::vector<std::uint8_t> bytes) {
	const std::span<const SoftBodyData> bodies = simulator.world().soft_bodies();
	if (!base.empty()) {
		if (Status status = open("base", base, base_)) {
			return *status;
		}
		if (base_.base != 0) {
			return refused("base", "a state with a base of its own", "must be a whole one", "save the base without a base");
		}
	}
	bytes.clear();
	StateWriter to(std::move(bytes));
	to.write(MAGIC);
	to.visit(VERSION);
	to.visit(std::uint32_t(sizeof(Real)));
	to.visit(std::uint64_t(0)); // the checksum
	to.visit(base.empty() ? std::uint64_t(0) : base_.checksum);
	to.visit(companion.world_token);
	const auto sized = [&](const auto &write) {
		const std::size_t begin = to.size();
		to.visit(std::uint32_t(0));
		write();
		to.put(begin, std::uint32_t(to.size() - begin - sizeof(std::uint32_t)));
	};
	sized([&] { write_world(simulator, companion, to); });
	to.visit(std::uint32_t(bodies.size()));
	for (std::size_t i = 0; i < bodies.size(); ++i) {
		const std::size_t begin = to.size();
		sized([&] { write_record(bodies[i], i, companion, to); });
		if (!base.empty() && i < base_.records.size() && std::ranges::equal(to.written(begin + sizeof(std::uint32_t)), base_.records[i])) {
			to.shrink(begin);
			to.visit(AS_IN_BASE);
		}
	}
	to.put(AT_CHECKSUM, checksum_of(to.written(HEAD)));
	return to.take();
}

// Restoring.

Status WorldState::open(const char *name, std::span<const std::uint8_t> bytes, Table &table) {
	const std::string prefix = std::string(name) + ".";
	if (bytes.size() < MAGIC.size() || !std::ranges::equal(MAGIC, bytes.first(MAGIC.size()))) {
		return refused(prefix + "magic", std::to_string(bytes.size()) + " bytes", "must begin with SB2W", "give the state of a world");
	}
	StateReader reader(bytes.subspan(MAGIC.size()));
	if (const auto version = reader.read<std::uint32_t>(); version != VERSION) {
		return refused(prefix + "version", std::to_string(version), "must be " + std::to_string(VERSION), "save it again with this version");
	}
	if (const auto size = reader.read<std::uint32_t>(); size != sizeof(Real)) {
		return refused(prefix + "precision", std::to_string(size) + " bytes", "must be " + std::to_string(sizeof(Real)) + " bytes a number",
				"restore it with the build that saved it");
	}
	table.checksum = reader.read<std::uint64_t>();
	if (!reader.is_valid() || table.checksum != checksum_of(reader.rest())) {
		return refused(prefix + "checksum", "another", "must be that of the data", DAMAGED);
	}
	table.base = reader.read<std::uint64_t>();
	table.token = reader.read<std::uint64_t>();
	table.world = reader.read_bytes(reader.read<std::uint32_t>());
	const auto count = reader.read<std::uint32_t>();
	table.records.clear();
	for (std::uint32_t i = 0; i < count && reader.is_valid(); ++i) {
		table.records.push_back(reader.read_bytes(reader.read<std::uint32_t>()));
	}
	if (!reader.is_valid() || !reader.is_at_end()) {
		return refused(prefix + "length", std::to_string(bytes.size()) + " bytes", "must be what its lists say", DAMAGED);
	}
	return {};
}

Status WorldState::read_world(std::span<const std::uint8_t> bytes, const WorldData &world) {
	StateReader reader(bytes);
	visit_memory(memory_, reader);
	visit_touches(touches_, reader);
	if (!reader.is_valid()) {
		return refused("state.length", std::to_string(bytes.size()) + " bytes of the world", "must be what its lists say", DAMAGED);
	}
	companion_ = reader.rest();
	if (Status status = world.check_memory(memory_)) {
		return status;
	}
	for (const Touch &touch : touches_) {
		const bool is_there = world.find(touch.body) && (touch.other.kind != ContactOther::Kind::SOFT_BODY || world.find(touch.other.body));
		if (!is_there || !std::isfinite(touch.apart)) {
			return refused("state.touches", "one of a missing body", "must be of bodies that the world has", DAMAGED);
		}
	}
	return {};
}

Status WorldState::read_record(std::span<const std::uint8_t> record, const SoftBodyData &body, std::size_t index,
		const Companion &companion) {
	const auto name = [&] { return companion.name_body ? companion.name_body(index) : "bodies[" + std::to_string(index) + "]"; };
	StateReader reader(record);
	Structure structure;
	visit_structure(structure, reader);
	if (reader.is_valid() && structure != Structure(*body.shared_shape())) {
		return refused("state." + name() + ".structure",
				std::to_string(structure.point_count) + " points, " + number_text(double(structure.radius)) + " wide",
				"must be the body's " + std::to_string(body.point_count()) + " points, " + number_text(double(body.shared_shape()->radius())) + " wide",
				OTHER_STRUCTURE);
	}
	if (states_.size() <= changed_.size()) {
		states_.emplace_back();
	}
	BodyState &state = states_[changed_.size()];
	state.touch = {}; // what is of one step only is not in the bytes
	state.rest = {};
	state.pair_touches.clear();
	visit_state(state, reader);
	reader.visit(state.rest.restored);
	if (!reader.is_valid()) {
		return refused("state." + name(), std::to_string(record.size()) + " bytes", "must be what its lists say", DAMAGED);
	}
	if (Status status = check_body_state(state, body.point_count(), body.shape().hull_count())) {
		status->name = "state." + name() + status->name.substr(5); // "state" comes first in it, too
		return status;
	}
	changed_.push_back({ index, reader.rest() });
	return {};
}

Status WorldState::read(const Simulator &simulator, const Companion &companion, std::span<const std::uint8_t> bytes,
		std::span<const std::uint8_t> base) {
	const WorldData &world = simulator.world();
	changed_.clear();
	if (Status status = open("state", bytes, state_)) {
		return status;
	}
	is_foreign_ = state_.token != companion.world_token;
	base_.records.clear();
	if (state_.base != 0) {
		if (base.empty()) {
			return refused("base", "none", "must be the state that this one was saved with", "give that one, too");
		}
		if (Status status = open("base", base, base_)) {
			return status;
		}
		if (base_.checksum != state_.base) {
			return refused("base", "another", "must be the state that this one was saved with", "give that one");
		}
	}
	if (Status status = read_world(state_.world, world)) {
		return status;
	}
	if (state_.records.size() != world.soft_bodies().size()) {
		return refused("state.length", std::to_string(state_.records.size()) + " records", "must be one a body", DAMAGED);
	}
	for (std::size_t i = 0; i < state_.records.size(); ++i) {
		std::span<const std::uint8_t> record = state_.records[i];
		if (record.empty() && i < base_.records.size()) {
			record = base_.records[i];
		}
		const SoftBodyData &body = world.soft_bodies()[i];
		if (!has_moved(record, body)) {
			present_.shrink(0);
			write_record(body, i, companion, present_);
			if (std::ranges::equal(record, present_.written())) {
				continue;
			}
		}
		if (Status status = read_record(record, body, i, companion)) {
			changed_.clear();
			return status;
		}
	}
	return {};
}

// Hashes and tags of another world's environment.
void WorldState::forget_environment() {
	for (std::size_t i = 0; i < changed_.size(); ++i) {
		states_[i].one_ways.clear();
		states_[i].rest.surroundings = 0;
	}
	std::erase_if(touches_, [](const Touch &touch) { return touch.other.kind != ContactOther::Kind::SOFT_BODY; });
}

void WorldState::put_back(Simulator &simulator) {
	WorldData &world = simulator.world();
	if (is_foreign_) {
		forget_environment();
	}
	for (std::size_t i = 0; i < changed_.size(); ++i) {
		world.soft_bodies()[changed_[i].body].put_back(states_[i]);
	}
	world.put_back(std::move(memory_));
	simulator.put_back_touches(std::exchange(touches_, {}));
	changed_.clear();
}

std::uint64_t hash_of_motion(const WorldData &world) {
	StateWriter to;
	for (const SoftBodyData &body : world.soft_bodies()) {
		const BodyMemory &memory = body.memory();
		to.visit_points(body.positions());
		to.visit_points(body.velocities());
		to.visit_points(body.dents());
		to.visit(body.rotation_memory().c);
		to.visit(body.rotation_memory().s);
		to.visit(memory.touch.touching);
		to.visit(memory.touch.account);
		to.visit(memory.rest.rest_time);
		to.visit(memory.rest.asleep);
		to.visit(memory.active);
		to.visit(memory.frozen);
		to.visit(memory.damage_pause);
	}
	for (const Joint &joint : world.joints()) {
		to.visit(joint.rest_length);
	}
	to.visit(std::uint32_t(world.joints().size()));
	return checksum_of(to.written());
}

} // namespace softbody
