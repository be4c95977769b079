// SPDX-License-Identifier: MIT
// The state of the node's body as bytes, for rollback, replays and saved games.
#include "godot/nodes/soft_body_2d.h"

#include "core/model/body_state.h"
#include "godot/convert.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>

#include <cstring>

namespace godot {

PackedByteArray SoftBody2D::get_state() const {
	PackedByteArray bytes;
	const softbody::SoftBodyData *found = followed_body();
	ERR_FAIL_NULL_V_MSG(found, bytes, describe() + ": has no body yet; add the node to the scene tree first.");
	const std::vector<uint8_t> state = softbody::to_bytes(found->save_state());
	bytes.resize(int64_t(state.size()));
	std::memcpy(bytes.ptrw(), state.data(), state.size());
	return bytes;
}

Error SoftBody2D::set_state(const PackedByteArray &p_state) {
	softbody::SoftBodyData *found = followed_body();
	ERR_FAIL_NULL_V_MSG(found, ERR_UNCONFIGURED, describe() + ": has no body yet; add the node to the scene tree first.");
	const auto state = softbody::body_state_from_bytes({ p_state.ptr(), std::size_t(p_state.size()) });
	softbody::Status status = state ? found->restore_state(state.value()) : softbody::Status(state.error());
	ERR_FAIL_COND_V_MSG(status, ERR_INVALID_DATA, describe() + ": state refused: " + softbody::to_godot(*status) + ". The body goes on as it was.");
	follow_body();
	found->set_rotation_memory(state.value().rotation_memory); // which the node's following measured anew
	if (!is_held_static()) {
		freeze_ = found->is_frozen();
	}
	apply_freeze();
	sleeping_ = found->is_asleep();
	take_over_pins();
	return OK;
}

// The state holds which points are pinned, but not their targets: a point that stays pinned keeps its target.
void SoftBody2D::take_over_pins() {
	const softbody::SoftBodyData &data = *body();
	PackedInt32Array points;
	TypedArray<NodePath> targets;
	for (int64_t i = 0; i < pinned_points_.size(); i++) {
		const int32_t point = pinned_points_[i];
		if (point < get_point_count() && data.is_pinned(uint32_t(core_index(point)))) {
			points.push_back(point);
			targets.push_back(get_pin_target(point));
		}
	}
	for (int point = 0; point < get_point_count(); point++) {
		if (data.is_pinned(uint32_t(core_index(point))) && !points.has(point)) {
			points.push_back(point);
			targets.push_back(NodePath());
		}
	}
	if (points != pinned_points_) {
		pinned_points_ = points;
		pin_targets_ = targets;
		pins_.clear();
	}
}

void SoftBody2D::bind_state() {
	ClassDB::bind_method(D_METHOD("get_state"), &SoftBody2D::get_state);
	ClassDB::bind_method(D_METHOD("set_state", "state"), &SoftBody2D::set_state);
}

} // namespace godot
