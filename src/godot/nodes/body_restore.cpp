// SPDX-License-Identifier: MIT
// States of a node that was cut since they were saved, or is yet to be.
#include "godot/nodes/body_cuts.h"
#include "godot/nodes/cut_history.h"
#include "godot/nodes/soft_body_attachment_2d.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/object.hpp>

#include <optional>
#include <utility>
#include <vector>

using namespace godot;

namespace softbody {

CutStructure BodyCuts::structure_of(const SoftBody2D &p_node) {
	const SkinStyle &style = p_node.skin_.style();
	return { p_node.structure_.values(), style.uv, style.vertex_colors, style.cut_edges, p_node.values_.mass, p_node.values_.elastic_model,
		p_node.awaited_modes_ != 0 };
}

Status BodyCuts::restore_body(Piece &r_piece, const CutHistory::Entry *p_former, const NodeState &p_state) {
	const BodyDesign *former = p_former != nullptr && p_former->design && node_.awaited_modes_ == 0 ? &*p_former->design : nullptr;
	if (former != nullptr && former->scale == node_.built_scale_ && former->wanted.model == node_.choose_model().model &&
			former->mass == node_.mass_of_area(former->area)) {
		r_piece.design = *former; // whose elastic modes are found
	} else {
		auto design = node_.make_design(node_.built_scale_);
		if (!design) {
			return design.error();
		}
		r_piece.design = std::move(design.value());
	}
	auto body = create_body(r_piece.design, node_);
	if (!body) {
		return body.error();
	}
	r_piece.body = std::move(body.value());
	return r_piece.body->restore_state(p_state.body);
}

Status BodyCuts::become(const NodeState &p_state) {
	const CutStructure present = structure_of(node_);
	const CutStructure &uncut = node_.cuts_.is_empty() ? present : node_.cuts_.first().structure;
	const CutStructure wanted = p_state.structure ? *p_state.structure : uncut;
	if (wanted.is_same(present) && wanted.awaits_modes == present.awaits_modes) {
		return {};
	}
	const CutHistory::Entry *found = node_.cuts_.find(wanted);
	const std::optional<CutHistory::Entry> former = found != nullptr ? std::optional(*found) : std::nullopt;
	const BodyStructure old_structure = node_.structure_;
	const SoftBody2D::Values old_values = node_.values_;
	const std::optional<BodyDesign> old_design = node_.design_;
	const uint64_t old_task = node_.awaited_modes_;
	node_.structure_.exchange_all(wanted.values);
	node_.values_.elastic_model = SoftBody2D::ElasticModel(wanted.elastic_model);
	if (node_.values_.mass_mode == SoftBody2D::MASS_MODE_CUSTOM) {
		node_.values_.mass = wanted.mass;
	}
	node_.design_.reset();
	node_.awaited_modes_ = 0;
	if (wanted.awaits_modes) {
		await_modes(node_);
	}
	Piece &piece = pieces_.emplace_back();
	piece.uv = wanted.uv;
	piece.vertex_colors = wanted.vertex_colors;
	piece.cut_edges = wanted.cut_edges;
	if (Status refused = restore_body(piece, found, p_state)) {
		node_.structure_ = old_structure;
		node_.values_ = old_values;
		node_.design_ = old_design;
		node_.awaited_modes_ = old_task;
		return refused;
	}
	std::vector<CutHistory::Entry> gone;
	if (former) {
		gone = node_.cuts_.take_from(former->cut);
	} else if (node_.cuts_.is_empty()) {
		node_.cuts_.add({ CutHistory::next_cut(), present, old_design, node_.pins_, {} });
	}
	node_.pins_ = former ? former->pins : BodyPins();
	if (node_.space_ != nullptr) {
		keep_first();
		find_modes(node_);
	} else {
		node_.stored_body_ = std::make_unique<SoftBodyData>(std::move(*piece.body));
		node_.design_ = piece.design;
		node_.polygon_reversed_ = piece.design.is_reversed;
		SkinStyle &style = node_.skin_.change_style();
		style.uv = piece.uv;
		style.vertex_colors = piece.vertex_colors;
		style.cut_edges = piece.cut_edges;
		node_.update_topology();
	}
	take_back(gone);
	return {};
}

// What went to other pieces at these cuts, as far as it still exists.
void BodyCuts::take_back(const std::vector<CutHistory::Entry> &p_gone) {
	for (const CutHistory::Entry &entry : p_gone) {
		for (const uint64_t id : entry.attachments) {
			SoftBodyAttachment2D *attachment = Object::cast_to<SoftBodyAttachment2D>(ObjectDB::get_instance(id));
			if (attachment == nullptr || attachment->get_parent() == &node_ || attachment->get_parent() == nullptr) {
				continue;
			}
			attachment->attach_at(attachment->get_rest_position(), attachment->get_rest_rotation());
			attachment->reparent(&node_, false);
			attachment->follow_now();
		}
	}
	if (!p_gone.empty() && node_.space_ != nullptr) {
		for (SteppedJoint *joint : node_.space_->joints()) {
			joint->undo_cuts(p_gone.front().cut, node_.get_instance_id());
		}
	}
}

} // namespace softbody
