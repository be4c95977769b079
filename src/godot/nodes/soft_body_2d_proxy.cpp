// SPDX-License-Identifier: MIT
// The node as the engine sees it: its proxy, and which bodies it does not collide with.
#include "godot/nodes/soft_body_2d.h"

#include "godot/convert.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/classes/collision_object2d.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <algorithm>

namespace godot {

namespace {

// The automatic margin, in parts of the radius of a disk of the body's area: deep enough to be seen, and to give a walking
// character the force to push, without changing where a body seems to end.
constexpr double AUTOMATIC_MARGIN = 0.06;

// Whether the node takes part in physics at all; a paused one does.
bool is_enabled(const Node *p_node) {
	for (const Node *node = p_node; node != nullptr; node = node->get_parent()) {
		if (node->get_process_mode() != Node::PROCESS_MODE_INHERIT) {
			return node->get_process_mode() != Node::PROCESS_MODE_DISABLED;
		}
	}
	return true;
}

} // namespace

void SoftBody2D::set_collision_proxy_enabled(bool p_enabled) {
	collision_proxy_enabled_ = p_enabled;
	update_proxy_presence();
}

void SoftBody2D::set_collision_proxy_margin(double p_margin) {
	if (!accept("collision_proxy_margin", softbody::check_at_least("collision_proxy_margin", p_margin, -1, "px"))) {
		return;
	}
	collision_proxy_margin_ = p_margin;
}

RID SoftBody2D::get_rid() const {
	return proxy_.rid();
}

softbody::Real SoftBody2D::proxy_inset() const {
	if (collision_proxy_margin_ >= 0) {
		return softbody::Real(collision_proxy_margin_);
	}
	return softbody::Real(AUTOMATIC_MARGIN * Math::sqrt(double(body()->shape().rest_area()) / Math_PI));
}

// The proxy is in the space while the body is, unless it is switched off or the node is.
void SoftBody2D::update_proxy_presence() {
	const bool wanted = collision_proxy_enabled_ && space_ != nullptr && body() != nullptr && is_inside_tree() && is_enabled(this);
	if (wanted && !proxy_.is_in_space()) {
		proxy_.set_collider(get_instance_id());
		proxy_.set_layer(collision_layer_);
		proxy_.enter(get_world_2d()->get_space(), *body(), proxy_inset());
		engine_steps_ = 0;
	} else if (!wanted) {
		proxy_.leave();
	}
}

bool SoftBody2D::follow_with_proxy(bool p_may_detail) {
	return proxy_.is_in_space() && body() != nullptr &&
			proxy_.follow(*body(), softbody::measure_frame(*body()), proxy_inset(), p_may_detail);
}

// Bodies that are left alone.

void SoftBody2D::add_collision_exception_with(Node *p_body) {
	ERR_FAIL_NULL(p_body);
	const bool is_ours = Object::cast_to<SoftBody2D>(p_body) != nullptr;
	ERR_FAIL_COND_MSG(!is_ours && Object::cast_to<CollisionObject2D>(p_body) == nullptr,
			describe() + ": no collision exception with '" + p_body->get_name() + "', which is neither a SoftBody2D nor a CollisionObject2D.");
	if (!collision_exceptions_.has(p_body->get_instance_id())) {
		collision_exceptions_.push_back(p_body->get_instance_id());
		apply_collision_exception(p_body, true);
	}
}

void SoftBody2D::remove_collision_exception_with(Node *p_body) {
	ERR_FAIL_NULL(p_body);
	if (collision_exceptions_.erase(p_body->get_instance_id())) {
		apply_collision_exception(p_body, false);
	}
}

TypedArray<Node2D> SoftBody2D::get_collision_exceptions() const {
	TypedArray<Node2D> found;
	for (const uint64_t id : collision_exceptions_) {
		if (Node2D *node = Object::cast_to<Node2D>(ObjectDB::get_instance(id))) {
			found.push_back(node);
		}
	}
	return found;
}

// The engine's side. The list of ids is what the core is to leave out: surfaces carry the id as their tag.
void SoftBody2D::apply_collision_exception(Node *p_body, bool p_excepted) {
	RID rid;
	if (const SoftBody2D *soft = Object::cast_to<SoftBody2D>(p_body)) {
		rid = soft->get_rid();
	} else if (const CollisionObject2D *collision_object = Object::cast_to<CollisionObject2D>(p_body)) {
		rid = collision_object->get_rid();
	}
	if (p_excepted) {
		proxy_.add_exception(rid);
	} else {
		proxy_.remove_exception(rid);
	}
}

void SoftBody2D::bind_proxy() {
	ClassDB::bind_method(D_METHOD("set_collision_proxy_enabled", "enabled"), &SoftBody2D::set_collision_proxy_enabled);
	ClassDB::bind_method(D_METHOD("is_collision_proxy_enabled"), &SoftBody2D::is_collision_proxy_enabled);
	ClassDB::bind_method(D_METHOD("set_collision_proxy_margin", "margin"), &SoftBody2D::set_collision_proxy_margin);
	ClassDB::bind_method(D_METHOD("get_collision_proxy_margin"), &SoftBody2D::get_collision_proxy_margin);
	ClassDB::bind_method(D_METHOD("get_rid"), &SoftBody2D::get_rid);
	ClassDB::bind_method(D_METHOD("add_collision_exception_with", "body"), &SoftBody2D::add_collision_exception_with);
	ClassDB::bind_method(D_METHOD("remove_collision_exception_with", "body"), &SoftBody2D::remove_collision_exception_with);
	ClassDB::bind_method(D_METHOD("get_collision_exceptions"), &SoftBody2D::get_collision_exceptions);

	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "collision_proxy_enabled"), "set_collision_proxy_enabled", "is_collision_proxy_enabled");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "collision_proxy_margin", PROPERTY_HINT_RANGE, "-1,32,0.1,or_greater,suffix:px"), "set_collision_proxy_margin", "get_collision_proxy_margin");
}

} // namespace godot
