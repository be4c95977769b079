// SPDX-License-Identifier: MIT
// The node that ties a SoftBody2D to another one, to any other node, or to the world.
#include "godot/nodes/soft_body_joint_2d.h"

#include "core/geometry/segment.h"
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

constexpr double INFINITE = std::numeric_limits<double>::infinity();

// The place of the body nearest to `p_place`: on an edge of its hull, or one of its inner points.
JointAnchor nearest_anchor(const softbody::SoftBodyData &p_body, softbody::Vec2 p_place) {
	const auto hull = p_body.hull();
	softbody::Real nearest = std::numeric_limits<softbody::Real>::infinity();
	JointAnchor anchor;
	for (uint32_t i = 0; i < hull.size(); i++) {
		const softbody::Vec2 a = hull[i];
		const softbody::Vec2 b = hull[(i + 1) % hull.size()];
		const softbody::Real fraction = softbody::closest_parameter_on_segment(p_place, a, b);
		const softbody::Real distance = length_squared(p_place - a - (b - a) * fraction);
		if (distance < nearest) {
			nearest = distance;
			anchor = JointAnchor::on_edge({}, i, fraction);
		}
	}
	for (uint32_t i = uint32_t(hull.size()); i < p_body.point_count(); i++) {
		const softbody::Real distance = length_squared(p_place - p_body.positions()[i]);
		if (distance < nearest) {
			nearest = distance;
			anchor = JointAnchor::on_point({}, i);
		}
	}
	return anchor;
}

// Null for what no joint can move.
const RigidBody2D *as_free_rigid_body(Object *p_node) {
	const RigidBody2D *rigid = Object::cast_to<RigidBody2D>(p_node);
	return rigid != nullptr && rigid->is_inside_tree() && !rigid->is_freeze_enabled() ? rigid : nullptr;
}

bool same_anchor(const JointAnchor &p_a, const JointAnchor &p_b) {
	return p_a.kind == p_b.kind && p_a.body == p_b.body && p_a.point == p_b.point && p_a.fraction == p_b.fraction && p_a.position == p_b.position && p_a.tag == p_b.tag;
}

bool same_joint(const softbody::Joint &p_a, const softbody::Joint &p_b) {
	return same_anchor(p_a.first, p_b.first) && same_anchor(p_a.second, p_b.second) && p_a.rest_length == p_b.rest_length && p_a.stiffness == p_b.stiffness && p_a.damping == p_b.damping && p_a.break_force == p_b.break_force && p_a.collide_joined == p_b.collide_joined;
}

} // namespace

SoftBodyJoint2D::~SoftBodyJoint2D() {
	leave_space();
}

// Properties.

bool SoftBodyJoint2D::change(const char *p_name, double &r_member, double p_value, const softbody::Status &p_status) {
	ERR_FAIL_COND_V_MSG(p_status.has_value(), false, "SoftBodyJoint2D '" + String(get_name()) + "': " + String(p_name) + " refused: " + to_godot(*p_status) + ". The old value stays.");
	r_member = p_value;
	complained_ = false;
	return true;
}

void SoftBodyJoint2D::set_node_a(const NodePath &p_path) {
	node_a_ = p_path;
	forget_ends();
}

void SoftBodyJoint2D::set_node_b(const NodePath &p_path) {
	node_b_ = p_path;
	forget_ends();
}

void SoftBodyJoint2D::set_length(double p_length) {
	change("length", length_, p_length, softbody::check_at_least("length", p_length, -1, "px"));
}

void SoftBodyJoint2D::set_rigid(bool p_rigid) {
	rigid_ = p_rigid;
	notify_property_list_changed();
}

void SoftBodyJoint2D::set_stiffness(double p_stiffness) {
	change("stiffness", stiffness_, p_stiffness, softbody::check_at_least("stiffness", p_stiffness, 0, "N/m"));
}

void SoftBodyJoint2D::set_damping(double p_damping) {
	change("damping", damping_, p_damping, softbody::check_at_least("damping", p_damping, 0, "N·s/m"));
}

void SoftBodyJoint2D::set_break_force(double p_force) {
	change("break_force", break_force_, p_force, softbody::check_at_least("break_force", p_force, 0, "kg px/s²"));
}

void SoftBodyJoint2D::set_disable_collision(bool p_disable) {
	disable_collision_ = p_disable;
}

PackedStringArray SoftBodyJoint2D::get_warnings() const {
	PackedStringArray warnings;
	const Node *a = node_a_.is_empty() ? nullptr : get_node_or_null(node_a_);
	const Node *b = node_b_.is_empty() ? nullptr : get_node_or_null(node_b_);
	if (Object::cast_to<SoftBody2D>(a) == nullptr && Object::cast_to<SoftBody2D>(b) == nullptr) {
		warnings.push_back("Neither end is a SoftBody2D. Choose one as node_a or node_b; an end that is left empty is the world.");
	} else if (a == b) {
		warnings.push_back("Both ends are the same body. Choose another node for one of them, or leave it empty for the world.");
	}
	unfit_.append_warnings(warnings);
	return warnings;
}

// Ends.

void SoftBodyJoint2D::forget_ends() {
	update_exception(false);
	ends_[0].reset();
	ends_[1].reset();
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
		end.anchor = nearest_anchor(*data, to_core(place));
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
		const softbody::Vec2 a = data->positions()[p_end->anchor.point];
		const softbody::Vec2 b = p_end->anchor.fraction > 0 ? data->hull()[(p_end->anchor.point + 1) % data->hull().size()] : a;
		return to_godot(a + (b - a) * p_end->anchor.fraction);
	}
	return to_godot(softbody::to_core_pose(node->get_global_transform()).apply(to_core(p_end->position)));
}

Vector2 SoftBodyJoint2D::get_anchor_a() const {
	return place_of(ends_[0]);
}

Vector2 SoftBodyJoint2D::get_anchor_b() const {
	return place_of(ends_[1]);
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
		std::optional<End> a = find_end(node_a_);
		std::optional<End> b = find_end(node_b_);
		if (!a || !b) {
			return;
		}
		ends_[0] = a;
		ends_[1] = b;
		bound_length_ = double(get_anchor_a().distance_to(get_anchor_b()));
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
	if (exists && same_joint(joint, known_)) {
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

void SoftBodyJoint2D::mend() {
	broken_ = false;
	forget_ends();
}

void SoftBodyJoint2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBodyJoint2D::get_warnings);
	ClassDB::bind_method(D_METHOD("set_node_a", "path"), &SoftBodyJoint2D::set_node_a);
	ClassDB::bind_method(D_METHOD("get_node_a"), &SoftBodyJoint2D::get_node_a);
	ClassDB::bind_method(D_METHOD("set_node_b", "path"), &SoftBodyJoint2D::set_node_b);
	ClassDB::bind_method(D_METHOD("get_node_b"), &SoftBodyJoint2D::get_node_b);
	ClassDB::bind_method(D_METHOD("set_length", "length"), &SoftBodyJoint2D::set_length);
	ClassDB::bind_method(D_METHOD("get_length"), &SoftBodyJoint2D::get_length);
	ClassDB::bind_method(D_METHOD("set_rigid", "rigid"), &SoftBodyJoint2D::set_rigid);
	ClassDB::bind_method(D_METHOD("is_rigid"), &SoftBodyJoint2D::is_rigid);
	ClassDB::bind_method(D_METHOD("set_stiffness", "stiffness"), &SoftBodyJoint2D::set_stiffness);
	ClassDB::bind_method(D_METHOD("get_stiffness"), &SoftBodyJoint2D::get_stiffness);
	ClassDB::bind_method(D_METHOD("set_damping", "damping"), &SoftBodyJoint2D::set_damping);
	ClassDB::bind_method(D_METHOD("get_damping"), &SoftBodyJoint2D::get_damping);
	ClassDB::bind_method(D_METHOD("set_break_force", "force"), &SoftBodyJoint2D::set_break_force);
	ClassDB::bind_method(D_METHOD("get_break_force"), &SoftBodyJoint2D::get_break_force);
	ClassDB::bind_method(D_METHOD("set_disable_collision", "disable"), &SoftBodyJoint2D::set_disable_collision);
	ClassDB::bind_method(D_METHOD("is_collision_disabled"), &SoftBodyJoint2D::is_collision_disabled);
	ClassDB::bind_method(D_METHOD("is_broken"), &SoftBodyJoint2D::is_broken);
	ClassDB::bind_method(D_METHOD("mend"), &SoftBodyJoint2D::mend);
	ClassDB::bind_method(D_METHOD("get_anchor_a"), &SoftBodyJoint2D::get_anchor_a);
	ClassDB::bind_method(D_METHOD("get_anchor_b"), &SoftBodyJoint2D::get_anchor_b);

	ADD_PROPERTY(PropertyInfo(Variant::NODE_PATH, "node_a", PROPERTY_HINT_NODE_PATH_VALID_TYPES, "Node2D"), "set_node_a", "get_node_a");
	ADD_PROPERTY(PropertyInfo(Variant::NODE_PATH, "node_b", PROPERTY_HINT_NODE_PATH_VALID_TYPES, "Node2D"), "set_node_b", "get_node_b");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "length", PROPERTY_HINT_RANGE, "-1,1000,0.1,or_greater,suffix:px"), "set_length", "get_length");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "rigid"), "set_rigid", "is_rigid");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "stiffness", PROPERTY_HINT_RANGE, "0,10000,0.1,or_greater,exp,suffix:N/m"), "set_stiffness", "get_stiffness");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "damping", PROPERTY_HINT_RANGE, String::utf8("0,20,0.001,or_greater,suffix:N·s/m")), "set_damping", "get_damping");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "break_force", PROPERTY_HINT_RANGE, String::utf8("0,100000,1,or_greater,exp,suffix:kg px/s²")), "set_break_force", "get_break_force");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "disable_collision"), "set_disable_collision", "is_collision_disabled");

	ADD_SIGNAL(MethodInfo("broken"));
}

} // namespace godot
