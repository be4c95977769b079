// SPDX-License-Identifier: MIT
// What the node of a joint remembers besides the core's joint, for the state of a whole space.
#include "godot/nodes/soft_body_joint_2d.h"

#include "core/model/state_archive.h"
#include "godot/convert.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/server/soft_body_space_2d.h"

#include <cmath>

namespace godot {

// In the order of the bytes. An end without a node has id 0; so has one that is still to be found, whose flag says so.
template <class Archive>
void SoftBodyJoint2D::visit_state(State &r_state, Archive &r_archive) {
	r_archive.visit(r_state.node);
	r_archive.visit(r_state.id.index);
	r_archive.visit(r_state.id.generation);
	r_archive.visit(r_state.bound_length);
	r_archive.visit(r_state.broken);
	r_archive.visit(r_state.is_bound);
	for (End &end : r_state.ends) {
		r_archive.visit(end.node);
		r_archive.visit(end.anchor.point);
		r_archive.visit(end.anchor.fraction);
		r_archive.visit(end.position.x);
		r_archive.visit(end.position.y);
	}
}

void SoftBodyJoint2D::write_state(softbody::StateWriter &r_to) const {
	State state{ get_instance_id(), id_, bound_length_, broken_, ends_[0] && ends_[1], {} };
	for (int i = 0; state.is_bound && i < 2; i++) {
		state.ends[i] = *ends_[i];
	}
	visit_state(state, r_to);
}

softbody::Status SoftBodyJoint2D::read_state(softbody::StateReader &r_from, bool p_is_foreign, bool p_takes) {
	State state;
	visit_state(state, r_from);
	const std::string name = "joint '" + std::string(String(get_name()).utf8().get_data()) + "'";
	if (!r_from.is_valid() || !std::isfinite(state.bound_length)) {
		return softbody::Error{ "state." + name, "no values of a joint", "must be what was saved", "keep the bytes as they were saved" };
	}
	if (!p_is_foreign && state.node != get_instance_id()) {
		return softbody::Error{ "state." + name, "another node", "must be the one that the world has there",
			"keep joints in the tree: let them break, and mend them, instead of freeing them" };
	}
	for (int i = 0; state.is_bound && i < 2; i++) {
		End &end = state.ends[i];
		if (p_is_foreign) { // the node at the same path
			const Node *node = paths_[i].is_empty() ? nullptr : get_node_or_null(paths_[i]);
			end.node = node != nullptr ? node->get_instance_id() : 0;
		}
		end.anchor.kind = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(end.node)) != nullptr ? softbody::JointAnchor::Kind::SOFT_BODY : softbody::JointAnchor::Kind::WORLD;
		if (!std::isfinite(end.anchor.fraction) || end.anchor.fraction < 0 || end.anchor.fraction > 1 || !end.position.is_finite()) {
			return softbody::Error{ "state." + name, "an end without a place", "must be finite", "keep the bytes as they were saved" };
		}
	}
	if (!p_takes) {
		return {};
	}
	id_ = state.id;
	bound_length_ = state.bound_length;
	broken_ = state.broken;
	for (int i = 0; i < 2; i++) {
		ends_[i] = state.is_bound ? std::optional(state.ends[i]) : std::nullopt;
	}
	missed_ticks_ = 0;
	complained_ = false;
	update_exception(state.is_bound && !broken_ && present_anchor(*ends_[0]) && present_anchor(*ends_[1]));
	return {};
}

void SoftBodyJoint2D::note_restored() {
	const softbody::Joint *joint = space_ != nullptr ? space_->world().find_joint(id_) : nullptr;
	known_ = joint != nullptr ? *joint : softbody::Joint();
	if (joint == nullptr) {
		id_ = {};
	}
}

} // namespace godot
