// SPDX-License-Identifier: MIT
// What the node remembers besides its body, for the state of a whole space.
#include "godot/nodes/soft_body_2d.h"

#include "core/model/state_archive.h"

#include <cmath>

namespace godot {

namespace {

/// In the order of the bytes.
struct NodeMemory {
	Transform2D transform;
	double locked_rotation = 0;
	softbody::Real calm_time = 0;
	bool awaits_modes = false;
	bool freeze = false;
	bool sleeping = false;
	bool moving = false;
	bool has_stopped = false;
	std::vector<uint64_t> touched; ///< instance ids

	void visit(auto &r_archive) {
		for (Vector2 &column : transform.columns) {
			r_archive.visit(column.x);
			r_archive.visit(column.y);
		}
		r_archive.visit(locked_rotation);
		r_archive.visit(calm_time);
		r_archive.visit(awaits_modes);
		r_archive.visit(freeze);
		r_archive.visit(sleeping);
		r_archive.visit(moving);
		r_archive.visit(has_stopped);
		r_archive.visit_list(touched, sizeof(uint64_t), [&](auto &r_id) { r_archive.visit(r_id); });
	}
};

} // namespace

void SoftBody2D::write_state(softbody::StateWriter &r_to) const {
	NodeMemory memory{ known_transform_, locked_rotation_, growth_.calm_time(), awaited_modes_ != 0, freeze_, sleeping_, moving_, has_stopped_,
		contacts_.touched() };
	memory.visit(r_to);
}

softbody::Status SoftBody2D::check_state(std::span<const uint8_t> p_state) const {
	softbody::StateReader reader(p_state);
	NodeMemory memory;
	memory.visit(reader);
	if (!reader.is_valid() || !reader.is_at_end()) {
		return softbody::Error{ "node", std::to_string(p_state.size()) + " bytes", "must be what its lists say", "keep the bytes as they were saved" };
	}
	if (memory.awaits_modes || awaited_modes_ != 0) {
		return softbody::Error{ "structure", "one whose elastic modes are still to be found", "must be known",
			"save and restore worlds some ticks after a cut, or choose an elastic_model without modes" };
	}
	if (!memory.transform.is_finite() || memory.transform.determinant() == 0 || !std::isfinite(memory.locked_rotation) || !std::isfinite(memory.calm_time)) {
		return softbody::Error{ "node", "a transform that is not finite or has no inverse", "must be a place", "keep the bytes as they were saved" };
	}
	return {};
}

void SoftBody2D::take_state(std::span<const uint8_t> p_state, bool p_is_foreign) {
	softbody::StateReader reader(p_state);
	NodeMemory memory;
	memory.visit(reader);
	locked_rotation_ = memory.locked_rotation;
	growth_.set_calm_time(memory.calm_time);
	moving_ = memory.moving;
	has_stopped_ = memory.has_stopped;
	told_sleep_.note_restore(sleeping_);
	sleeping_ = memory.sleeping;
	contacts_.restore(p_is_foreign ? std::vector<uint64_t>() : std::move(memory.touched));
	if (memory.transform != known_transform_) {
		place_node(memory.transform);
		known_transform_ = get_global_transform();
	}
	settled_ = false;
	area_checked_ = false;
	interpolation_.end();
	freeze_ = memory.freeze;
	if (softbody::SoftBodyData *found = body()) {
		pins_.take_over(*found, order());
		if (found->is_frozen() != (freeze_ || is_held_static())) {
			apply_freeze();
		}
	}
	note_change();
}

} // namespace godot
