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
	note_change();
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
	const bool wanted = collision_proxy_enabled_ && space_ != nullptr && body() != nullptr && is_inside_tree() && (enabled_ || disable_mode_ != DISABLE_MODE_REMOVE);
	if (wanted && !proxy_.is_in_space()) {
		proxy_.set_collider(get_instance_id());
		proxy_.set_layer(collision_layer_);
		proxy_.enter(get_world_2d()->get_space(), *body(), proxy_inset());
		engine_steps_ = 0;
	} else if (!wanted) {
		proxy_.leave();
	}
	note_change();
}

bool SoftBody2D::follow_with_proxy(bool p_may_detail) {
	return proxy_.is_in_space() && body() != nullptr && proxy_.follow(*body(), proxy_inset(), p_may_detail);
}

// Bodies that are left alone: by the engine's side through the proxy, by the core through tags (of Godot's bodies) and ids (of
// soft ones). The core forgets the latter with a body that leaves its world, so either of the two brings them again.

void SoftBody2D::add_collision_exception_with(Node *p_body) {
	ERR_FAIL_NULL(p_body);
	SoftBody2D *soft = Object::cast_to<SoftBody2D>(p_body);
	const CollisionObject2D *collision_object = Object::cast_to<CollisionObject2D>(p_body);
	ERR_FAIL_COND_MSG(soft == nullptr && collision_object == nullptr,
			describe() + ": no collision exception with '" + p_body->get_name() + "', which is neither a SoftBody2D nor a CollisionObject2D.");
	ERR_FAIL_COND_MSG(soft == this, describe() + ": no collision exception with itself. Switch self_collision off instead.");
	const uint64_t id = p_body->get_instance_id();
	if (std::find(collision_exceptions_.begin(), collision_exceptions_.end(), id) != collision_exceptions_.end()) {
		return;
	}
	collision_exceptions_.push_back(id);
	if (soft != nullptr) {
		soft->excepted_by_.push_back(get_instance_id());
	} else {
		proxy_.add_exception(collision_object->get_rid());
	}
	apply_exceptions();
}

void SoftBody2D::remove_collision_exception_with(Node *p_body) {
	ERR_FAIL_NULL(p_body);
	if (std::erase(collision_exceptions_, p_body->get_instance_id()) == 0) {
		return;
	}
	if (SoftBody2D *soft = Object::cast_to<SoftBody2D>(p_body)) {
		std::erase(soft->excepted_by_, get_instance_id());
		const bool is_wanted_by_other = std::find(excepted_by_.begin(), excepted_by_.end(), soft->get_instance_id()) != excepted_by_.end();
		if (space_ != nullptr && !is_wanted_by_other) {
			space_->world().remove_collision_exception(body_id_, soft->body_id_);
		}
	} else if (const CollisionObject2D *collision_object = Object::cast_to<CollisionObject2D>(p_body)) {
		proxy_.remove_exception(collision_object->get_rid());
	}
	apply_exceptions();
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

void SoftBody2D::add_joined(uint64_t p_id) {
	joined_.push_back(p_id);
	apply_exceptions();
}

void SoftBody2D::remove_joined(uint64_t p_id) {
	const auto found = std::find(joined_.begin(), joined_.end(), p_id); // one of several joints
	if (found != joined_.end()) {
		joined_.erase(found);
		apply_exceptions();
	}
}

// Brings the core's exceptions of this body up to date.
void SoftBody2D::apply_exceptions() {
	softbody::SoftBodyData *found = body();
	if (found == nullptr || (collision_exceptions_.empty() && excepted_by_.empty() && joined_.empty() && found->ignored_tags().empty())) {
		return;
	}
	std::vector<uint64_t> tags;
	for (const std::vector<uint64_t> *list : { &collision_exceptions_, &excepted_by_, &joined_ }) {
		for (const uint64_t id : *list) {
			const SoftBody2D *soft = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(id));
			if (soft == nullptr) {
				tags.push_back(id);
			} else if (space_ != nullptr && soft->space_ == space_ && soft->body() != nullptr) {
				accept("collision_exceptions", space_->world().add_collision_exception(body_id_, soft->body_id_));
			}
		}
	}
	found->set_ignored_tags(tags);
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
}

} // namespace godot
