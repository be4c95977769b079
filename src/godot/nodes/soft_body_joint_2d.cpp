// SPDX-License-Identifier: MIT
// The node that ties a SoftBody2D to another one, to any other node, or to the world.
#include "godot/nodes/soft_body_joint_2d.h"

#include "godot/convert.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/server/soft_body_simulation_2d.h"

#include <godot_cpp/classes/collision_object2d.hpp>
#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/rigid_body2d.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <limits>

using softbody::JointAnchor;
using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

// Ticks without a node at the end of a path after which that is an error.
constexpr int PATIENCE = 60;

constexpr double INFINITE = std::numeric_limits<double>::infinity();

// Null for what no joint can move.
const RigidBody2D *as_free_rigid_body(Object *p_node) {
	const RigidBody2D *rigid = Object::cast_to<RigidBody2D>(p_node);
	return rigid != nullptr && rigid->is_inside_tree() && !rigid->is_freeze_enabled() ? rigid : nullptr;
}

} // namespace

SoftBodyJoint2D::~SoftBodyJoint2D() {
	leave_space();
}

// Properties.

namespace {

struct NumberRule {
	const char *name = "";
	softbody::ValueRange range;
};

// One for each number, filled when its property is bound.
template <double SoftBodyJoint2D::*VALUE>
NumberRule rule_of;

} // namespace

template <double SoftBodyJoint2D::*VALUE>
void SoftBodyJoint2D::set_number(double p_value) {
	const NumberRule &rule = rule_of<VALUE>;
	const softbody::Status status = rule.range.check(rule.name, p_value);
	ERR_FAIL_COND_MSG(status.has_value(), "SoftBodyJoint2D '" + String(get_name()) + "': " + rule.name + " refused: " + to_godot(*status) + ". The old value stays.");
	this->*VALUE = p_value;
	complained_ = false;
}

template <double SoftBodyJoint2D::*VALUE>
void SoftBodyJoint2D::bind_number(const char *p_name, const softbody::ValueRange &p_range, const char *p_hint_string) {
	rule_of<VALUE> = { p_name, p_range };
	softbody::bind_property(p_name, &SoftBodyJoint2D::set_number<VALUE>, &SoftBodyJoint2D::get_number<VALUE>, PROPERTY_HINT_RANGE, p_hint_string);
}

template <int END>
void SoftBodyJoint2D::set_node(const NodePath &p_path) {
	paths_[END] = p_path;
	forget_ends();
}

void SoftBodyJoint2D::set_rigid(bool p_rigid) {
	rigid_ = p_rigid;
	notify_property_list_changed();
}

PackedStringArray SoftBodyJoint2D::get_warnings() const {
	PackedStringArray warnings;
	const Node *a = paths_[0].is_empty() ? nullptr : get_node_or_null(paths_[0]);
	const Node *b = paths_[1].is_empty() ? nullptr : get_node_or_null(paths_[1]);
	if (Object::cast_to<SoftBody2D>(a) == nullptr && Object::cast_to<SoftBody2D>(b) == nullptr) {
		warnings.push_back("Neither end is a SoftBody2D. Choose one as node_a or node_b; an end that is left empty is the world.");
	} else if (a == b) {
		warnings.push_back("Both ends are the same body. Choose another node for one of them, or leave it empty for the world.");
	}
	for (int i = 0; i < 2; i++) {
		if (!paths_[i].is_empty() && Object::cast_to<Node2D>(i == 0 ? a : b) == nullptr) {
			warnings.push_back(missing_end(i));
		}
	}
	unfit_.append_warnings(warnings);
	return warnings;
}

String SoftBodyJoint2D::missing_end(int p_end) const {
	return String(p_end == 0 ? "node_a" : "node_b") + " is '" + String(paths_[p_end]) + "', and there is no Node2D of this world at that path. The joint joins nothing until there is one. Choose another node, or leave it empty for the world.";
}

// An end may come later than the joint, but not much later without a word.
void SoftBodyJoint2D::note_missing_end(bool p_has_first) {
	if (++missed_ticks_ > PATIENCE && !complained_) {
		complained_ = true;
		ERR_PRINT("SoftBodyJoint2D '" + String(get_name()) + "' (" + String(get_path()) + "): " + missing_end(p_has_first ? 1 : 0));
	}
}

// Ends.

void SoftBodyJoint2D::forget_ends() {
	update_exception(false);
	ends_[0].reset();
	ends_[1].reset();
	former_ends_.clear();
	missed_ticks_ = 0;
	complained_ = false;
	if (space_ != nullptr) {
		space_->world().remove_joint(id_);
		id_ = {};
	}
	update_configuration_warnings();
}

std::optional<SoftBodyJoint2D::End> SoftBodyJoint2D::find_end(const NodePath &p_path) const {
	const Vector2 place = get_global_position();
	End end;
	end.position = place;
	if (p_path.is_empty()) {
		return end;
	}
	const Node2D *node = Object::cast_to<Node2D>(get_node_or_null(p_path));
	if (node == nullptr || !node->is_inside_tree()) {
		return std::nullopt;
	}
	end.node = node->get_instance_id();
	if (const SoftBody2D *soft = Object::cast_to<SoftBody2D>(node)) {
		const softbody::SoftBodyData *data = soft->get_body();
		if (data == nullptr || soft->get_space() != space_) {
			return std::nullopt;
		}
		end.anchor = softbody::nearest_anchor(*data, {}, to_core(place));
		return end;
	}
	end.position = to_godot(softbody::to_core_pose(node->get_global_transform()).apply_inverse(to_core(place)));
	return end;
}

std::optional<JointAnchor> SoftBodyJoint2D::present_anchor(const End &p_end) const {
	if (p_end.node == 0) {
		return JointAnchor::at_place(to_core(p_end.position));
	}
	Node2D *node = Object::cast_to<Node2D>(ObjectDB::get_instance(p_end.node));
	if (node == nullptr || !node->is_inside_tree()) {
		return std::nullopt;
	}
	if (const SoftBody2D *soft = Object::cast_to<SoftBody2D>(node)) {
		const softbody::SoftBodyData *data = soft->get_body();
		if (data == nullptr || soft->get_space() != space_ || p_end.anchor.point >= data->point_count()) {
			return std::nullopt;
		}
		JointAnchor anchor = p_end.anchor;
		anchor.body = soft->get_body_id();
		return anchor;
	}
	if (as_free_rigid_body(node) != nullptr) {
		return JointAnchor::on_rigid_body(p_end.node, to_core(p_end.position));
	}
	return JointAnchor::at_place(softbody::to_core_pose(node->get_global_transform()).apply(to_core(p_end.position)));
}

RID SoftBodyJoint2D::get_rigid_body() const {
	for (const std::optional<End> &end : ends_) {
		if (const RigidBody2D *rigid = end ? as_free_rigid_body(ObjectDB::get_instance(end->node)) : nullptr) {
			return rigid->get_rid();
		}
	}
	return RID();
}

Vector2 SoftBodyJoint2D::place_of(const std::optional<End> &p_end) const {
	if (!p_end) {
		return get_global_position();
	}
	const Node2D *node = Object::cast_to<Node2D>(ObjectDB::get_instance(p_end->node));
	if (node == nullptr) {
		return p_end->position;
	}
	if (const SoftBody2D *soft = Object::cast_to<SoftBody2D>(node)) {
		const softbody::SoftBodyData *data = soft->get_body();
		if (data == nullptr || p_end->anchor.point >= data->point_count()) {
			return get_global_position();
		}
		return to_godot(softbody::position_of(p_end->anchor, *data));
	}
	return to_godot(softbody::to_core_pose(node->get_global_transform()).apply(to_core(p_end->position)));
}

// Life.

void SoftBodyJoint2D::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE: {
			unfit_.tell(*this);
			enter_space();
		} break;
		case NOTIFICATION_EXIT_TREE: {
			leave_space();
		} break;
		case NOTIFICATION_WORLD_2D_CHANGED: {
			if (space_ != nullptr) {
				leave_space();
				enter_space();
			}
		} break;
		default:
			break;
	}
}

void SoftBodyJoint2D::enter_space() {
	if (!Engine::get_singleton()->is_editor_hint()) {
		space_ = &SoftBodySimulation2D::get_singleton()->space_of(this);
		space_->add_joint(*this);
	}
}

void SoftBodyJoint2D::leave_space() {
	update_exception(false);
	if (space_ != nullptr) {
		space_->world().remove_joint(id_);
		id_ = {};
		space_->remove_joint(*this);
		space_ = nullptr;
		SoftBodySimulation2D::get_singleton()->drop_empty_spaces();
	}
}

softbody::Joint SoftBodyJoint2D::make_joint(const JointAnchor &p_first, const JointAnchor &p_second) const {
	softbody::Joint joint;
	joint.first = p_first;
	joint.second = p_second;
	joint.rest_length = softbody::Real(length_ < 0 ? bound_length_ : length_);
	joint.stiffness = softbody::Real(rigid_ ? INFINITE : stiffness_);
	joint.damping = softbody::Real(rigid_ ? 0 : damping_);
	joint.break_force = softbody::Real(break_force_ > 0 ? break_force_ : INFINITE);
	joint.collide_joined = !disable_collision_;
	return joint;
}

void SoftBodyJoint2D::prepare_step() {
	if (broken_ || space_ == nullptr) {
		return;
	}
	if (!ends_[0] || !ends_[1]) {
		std::optional<End> a = find_end(paths_[0]);
		std::optional<End> b = find_end(paths_[1]);
		if (!a || !b) {
			note_missing_end(a.has_value());
			return;
		}
		ends_[0] = a;
		ends_[1] = b;
		bound_length_ = double(get_anchor<0>().distance_to(get_anchor<1>()));
	}
	const std::optional<JointAnchor> first = present_anchor(*ends_[0]);
	const std::optional<JointAnchor> second = present_anchor(*ends_[1]);
	const bool exists = space_->world().find_joint(id_) != nullptr;
	update_exception(first && second);
	if (!first || !second) {
		if (exists) {
			space_->world().remove_joint(id_);
		}
		id_ = {};
		return;
	}
	const softbody::Joint joint = make_joint(*first, *second);
	if (exists && joint == known_) {
		return;
	}
	softbody::Status refused;
	if (exists) {
		refused = space_->world().set_joint(id_, joint);
	} else if (auto made = space_->world().add_joint(joint)) {
		id_ = made.value();
	} else {
		refused = made.error();
	}
	if (!refused) {
		known_ = joint;
	} else if (!complained_) {
		complained_ = true;
		ERR_PRINT("SoftBodyJoint2D '" + String(get_name()) + "' joins nothing: " + to_godot(*refused) + ".");
	}
}

// Two soft bodies are kept apart by the core, which knows the joint.
void SoftBodyJoint2D::update_exception(bool p_joins) {
	std::pair<uint64_t, uint64_t> wanted{ 0, 0 };
	if (p_joins && disable_collision_) {
		const bool is_first = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(ends_[0]->node)) != nullptr;
		wanted = { ends_[is_first ? 0 : 1]->node, ends_[is_first ? 1 : 0]->node };
		if (Object::cast_to<CollisionObject2D>(ObjectDB::get_instance(wanted.second)) == nullptr) {
			wanted = { 0, 0 };
		}
	}
	if (wanted == excepted_) {
		return;
	}
	if (SoftBody2D *soft = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(excepted_.first))) {
		soft->remove_joined(excepted_.second);
	}
	if (SoftBody2D *soft = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(wanted.first))) {
		soft->add_joined(wanted.second);
	}
	excepted_ = wanted;
}

void SoftBodyJoint2D::note_break(softbody::StepSignals &r_signals) {
	id_ = {};
	broken_ = true;
	update_exception(false);
	r_signals.add(get_instance_id(), [this] { emit_signal("broken"); });
}

// An end that has not been found yet stands where the joint does.
void SoftBodyJoint2D::follow_cut(uint64_t p_cut, uint64_t p_node, const softbody::SoftBodyData &p_whole, std::span<const uint64_t> p_pieces) {
	for (int i = 0; i < 2; i++) {
		std::optional<End> &end = ends_[i];
		const Node *named = end || paths_[i].is_empty() ? nullptr : get_node_or_null(paths_[i]);
		if (end ? end->node != p_node : named == nullptr || named->get_instance_id() != p_node) {
			continue;
		}
		const softbody::Vec2 place = end && end->anchor.point < p_whole.point_count() ? softbody::position_of(end->anchor, p_whole) : to_core(get_global_position());
		SoftBody2D *nearest = nullptr;
		JointAnchor anchor;
		softbody::Real least = std::numeric_limits<softbody::Real>::infinity();
		for (const uint64_t id : p_pieces) {
			SoftBody2D *piece = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(id));
			if (piece == nullptr || piece->get_body() == nullptr) {
				continue;
			}
			const JointAnchor found = softbody::nearest_anchor(*piece->get_body(), {}, place);
			if (const softbody::Real distance = length_squared(softbody::position_of(found, *piece->get_body()) - place); distance < least) {
				least = distance;
				nearest = piece;
				anchor = found;
			}
		}
		if (nearest == nullptr) {
			continue;
		}
		former_ends_.push_back({ p_cut, p_node, i, end });
		if (end) {
			end->node = nearest->get_instance_id();
			end->anchor = anchor;
		}
		if (is_inside_tree() && nearest->is_inside_tree()) {
			paths_[i] = get_path_to(nearest);
		}
	}
}

void SoftBodyJoint2D::undo_cuts(uint64_t p_first_cut, uint64_t p_node) {
	for (std::size_t k = former_ends_.size(); k-- > 0;) {
		const FormerEnd former = former_ends_[k];
		if (former.cut < p_first_cut || former.node != p_node) {
			continue;
		}
		former_ends_.erase(former_ends_.begin() + std::ptrdiff_t(k));
		ends_[former.index] = former.end;
		Node2D *node = Object::cast_to<Node2D>(ObjectDB::get_instance(p_node));
		if (node != nullptr && is_inside_tree() && node->is_inside_tree()) {
			paths_[former.index] = get_path_to(node);
		}
	}
}

void SoftBodyJoint2D::mend() {
	broken_ = false;
	forget_ends();
}

void SoftBodyJoint2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBodyJoint2D::get_warnings);
	ClassDB::bind_method(D_METHOD("is_broken"), &SoftBodyJoint2D::is_broken);
	ClassDB::bind_method(D_METHOD("mend"), &SoftBodyJoint2D::mend);
	ClassDB::bind_method(D_METHOD("get_anchor_a"), &SoftBodyJoint2D::get_anchor<0>);
	ClassDB::bind_method(D_METHOD("get_anchor_b"), &SoftBodyJoint2D::get_anchor<1>);

	using softbody::bind_property;
	using Range = softbody::ValueRange;
	bind_property("node_a", &SoftBodyJoint2D::set_node<0>, &SoftBodyJoint2D::get_node<0>, PROPERTY_HINT_NODE_PATH_VALID_TYPES, "Node2D");
	bind_property("node_b", &SoftBodyJoint2D::set_node<1>, &SoftBodyJoint2D::get_node<1>, PROPERTY_HINT_NODE_PATH_VALID_TYPES, "Node2D");
	bind_number<&SoftBodyJoint2D::length_>("length", Range::at_least(-1, "px"), "-1,1000,0.1,or_greater,suffix:px");
	bind_property("rigid", &SoftBodyJoint2D::set_rigid, &SoftBodyJoint2D::is_rigid, PROPERTY_HINT_NONE, "", "is_rigid");
	bind_number<&SoftBodyJoint2D::stiffness_>("stiffness", Range::at_least(0, "N/m"), "0,10000,0.1,or_greater,exp,suffix:N/m");
	bind_number<&SoftBodyJoint2D::damping_>("damping", Range::at_least(0, "N·s/m"), "0,20,0.001,or_greater,suffix:N·s/m");
	bind_number<&SoftBodyJoint2D::break_force_>("break_force", Range::at_least(0, "kg px/s²"), "0,100000,1,or_greater,exp,suffix:kg px/s²");
	bind_property("disable_collision", &SoftBodyJoint2D::set_disable_collision, &SoftBodyJoint2D::is_collision_disabled, PROPERTY_HINT_NONE, "", "is_collision_disabled");

	ADD_SIGNAL(MethodInfo("broken"));
}

} // namespace godot
