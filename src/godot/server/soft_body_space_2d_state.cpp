// SPDX-License-Identifier: MIT
// States of everything in a space: of the core's world, and of what nodes remember beside it.
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/classes/os.hpp>

#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace godot;

namespace softbody {

namespace {

std::string text_of(const String &p_text) {
	return p_text.utf8().get_data();
}

std::span<const uint8_t> bytes_of(const PackedByteArray &p_bytes) {
	return { p_bytes.ptr(), std::size_t(p_bytes.size()) };
}

} // namespace

WorldState::Companion SoftBodySpace2D::companion() {
	if (token_ == 0) {
		token_ = uint64_t(OS::get_singleton()->get_entropy(8).decode_u64(0)) | 1;
	}
	WorldState::Companion companion;
	companion.world_token = token_;
	companion.write_body = [this](std::size_t p_body, StateWriter &r_to) {
		if (const SteppedNode *node = node_at(p_body)) {
			node->write_state(r_to);
		}
	};
	companion.write_world = [this](StateWriter &r_to) {
		r_to.visit(turn_to_tear_);
		r_to.visit(uint32_t(joints_.size()));
		for (const SteppedJoint *joint : joints_) {
			joint->write_state(r_to);
		}
	};
	companion.name_body = [this](std::size_t p_body) {
		const SteppedNode *node = node_at(p_body);
		return node != nullptr ? text_of(node->describe()) : "bodies[" + std::to_string(p_body) + "]";
	};
	return companion;
}

Result<PackedByteArray> SoftBodySpace2D::save_state(const PackedByteArray &p_base) {
	nodes_.for_each([](SteppedNode &r_node) { r_node.take_over_transform(); });
	auto saved = state_.save(simulator_, companion(), bytes_of(p_base), std::move(saved_));
	if (!saved) {
		return saved.error();
	}
	saved_ = std::move(saved.value());
	PackedByteArray bytes;
	bytes.resize(int64_t(saved_.size()));
	std::memcpy(bytes.ptrw(), saved_.data(), saved_.size());
	return bytes;
}

Status SoftBodySpace2D::read_joints(StateReader &r_from, bool p_is_foreign, bool p_takes) {
	const auto turn = r_from.read<uint64_t>();
	if (const auto count = r_from.read<uint32_t>(); count != joints_.size()) {
		return Error{ "state.joint nodes", std::to_string(count), "must be as many as the world has, " + std::to_string(joints_.size()),
			"keep joints in the tree: let them break, and mend them, instead of freeing them" };
	}
	for (SteppedJoint *joint : joints_) {
		if (Status refused = joint->read_state(r_from, p_is_foreign, p_takes)) {
			return refused;
		}
	}
	if (!r_from.is_at_end()) {
		return Error{ "state.length", "bytes beyond the joints", "must be what its lists say", "keep the bytes as they were saved" };
	}
	if (p_takes) {
		turn_to_tear_ = turn;
	}
	return {};
}

// What joints do to the exceptions of nodes wakes bodies, so it comes before the core's state, which says who sleeps.
Status SoftBodySpace2D::restore_state(const PackedByteArray &p_state, const PackedByteArray &p_base) {
	nodes_.for_each([](SteppedNode &r_node) { r_node.take_over_transform(); });
	if (Status refused = state_.read(simulator_, companion(), bytes_of(p_state), bytes_of(p_base))) {
		return refused;
	}
	StateReader joints(state_.companion());
	if (Status refused = read_joints(joints, state_.is_foreign(), false)) {
		return refused;
	}
	std::vector<std::pair<BodyId, std::span<const uint8_t>>> changed; // by id: moving nodes runs code of the user, which may free some
	for (const WorldState::Changed &each : state_.changed()) {
		const SteppedNode *node = node_at(each.body);
		if (Status refused = node != nullptr ? node->check_state(each.companion) : Status()) {
			refused->name = "state." + text_of(node->describe()) + "." + refused->name;
			return refused;
		}
		changed.push_back({ world_.id_at(each.body), each.companion });
	}
	joints = StateReader(state_.companion());
	read_joints(joints, state_.is_foreign(), true);
	const bool is_foreign = state_.is_foreign();
	state_.put_back(simulator_);
	for (SteppedJoint *joint : joints_) {
		joint->note_restored();
	}
	for (const auto &[body, memory] : changed) {
		if (SteppedNode *node = node_of(body)) {
			node->take_state(memory, is_foreign);
		}
	}
	return {};
}

uint64_t SoftBodySpace2D::hash_of_motion() {
	nodes_.for_each([](SteppedNode &r_node) { r_node.take_over_transform(); });
	return softbody::hash_of_motion(world_);
}

} // namespace softbody
