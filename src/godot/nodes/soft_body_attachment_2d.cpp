// SPDX-License-Identifier: MIT
// The node that carries other nodes along with the surface of a SoftBody2D.
#include "godot/nodes/soft_body_attachment_2d.h"

#include "godot/convert.h"
#include "godot/drawing/drawing_frame.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/resources/property_binding.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

namespace godot {

SoftBody2D *SoftBodyAttachment2D::soft_body() const {
	return Object::cast_to<SoftBody2D>(get_parent());
}

PackedStringArray SoftBodyAttachment2D::get_warnings() const {
	PackedStringArray warnings;
	if (soft_body() == nullptr) {
		warnings.push_back("SoftBodyAttachment2D only works as a child of a SoftBody2D. Move it below the body that shall carry it.");
	}
	unfit_.append_warnings(warnings);
	return warnings;
}

void SoftBodyAttachment2D::attach_at(const Vector2 &p_position, double p_rotation) {
	ERR_FAIL_COND_MSG(!p_position.is_finite() || !Math::is_finite(p_rotation), "SoftBodyAttachment2D '" + String(get_name()) + "': position = " + String(p_position) + " and rotation = " + String::num(p_rotation) + " must be finite.");
	rest_position_ = p_position;
	rest_rotation_ = p_rotation;
	has_place_ = true;
	attachment_.reset();
}

Vector2 SoftBodyAttachment2D::get_rest_position() const {
	return has_place_ ? rest_position_ : get_position();
}

double SoftBodyAttachment2D::get_rest_rotation() const {
	return has_place_ ? rest_rotation_ : double(get_rotation());
}

// A node that is not in the tree of a running game gets its place by position and rotation, which a script may change.

void SoftBodyAttachment2D::set_rest_position(const Vector2 &p_position) {
	if (has_place_ && is_inside_tree()) {
		attach_at(p_position, rest_rotation_);
	} else {
		has_place_ = false;
		set_position(p_position);
	}
}

void SoftBodyAttachment2D::set_rest_rotation(double p_rotation) {
	if (has_place_ && is_inside_tree()) {
		attach_at(rest_position_, p_rotation);
	} else {
		has_place_ = false;
		set_rotation(real_t(p_rotation));
	}
}

// What is stored of a carried node, by duplicate() and in scenes, is where it belongs, not where the body has taken it.
void SoftBodyAttachment2D::_validate_property(PropertyInfo &p_property) const {
	static const StringName POSITION = "position", ROTATION = "rotation", REST_POSITION = "rest_position", REST_ROTATION = "rest_rotation";
	if (!has_place_) {
		return;
	}
	if (p_property.name == POSITION || (follow_rotation_ && p_property.name == ROTATION)) {
		p_property.usage &= ~uint32_t(PROPERTY_USAGE_STORAGE);
	} else if (p_property.name == REST_POSITION || (follow_rotation_ && p_property.name == REST_ROTATION)) {
		p_property.usage |= PROPERTY_USAGE_STORAGE;
	}
}

void SoftBodyAttachment2D::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE: {
			unfit_.tell(*this);
			const bool runs = soft_body() != nullptr && !Engine::get_singleton()->is_editor_hint();
			set_process_internal(runs);
			set_physics_process_internal(runs);
			update_configuration_warnings();
		} break;
		case NOTIFICATION_INTERNAL_PHYSICS_PROCESS: {
			follow(1); // the soft bodies have been stepped by now
		} break;
		case NOTIFICATION_INTERNAL_PROCESS: {
			// Where the engine blends transforms, it blends this one too.
			if (const SoftBody2D *body = soft_body(); body != nullptr && !is_physics_interpolated_and_enabled()) {
				follow(body->is_drawn_at_tick() ? 1 : softbody::present_fraction());
			}
		} break;
		default:
			break;
	}
}

void SoftBodyAttachment2D::follow_now() {
	if (const SoftBody2D *body = soft_body()) {
		follow(body->is_drawn_at_tick() || is_physics_interpolated_and_enabled() ? 1 : softbody::present_fraction());
	}
}

void SoftBodyAttachment2D::follow(double p_fraction) {
	const SoftBody2D *body = soft_body();
	if (body == nullptr) {
		return;
	}
	if (!has_place_) {
		rest_position_ = get_position();
		rest_rotation_ = get_rotation();
		has_place_ = true;
	}
	if (!attachment_ || rest_version_ != body->get_rest_version()) {
		auto made = softbody::Attachment::create(body->get_rest_positions(), softbody::to_core(rest_position_));
		ERR_FAIL_COND_MSG(!made, "SoftBodyAttachment2D '" + String(get_name()) + "': " + softbody::to_godot(made.error()) + ".");
		attachment_ = std::move(made.value());
		rest_version_ = body->get_rest_version();
	}
	const softbody::Pose pose = attachment_->follow(body->local_points(p_fraction));
	set_position(softbody::to_godot(pose.position));
	if (follow_rotation_) {
		set_rotation(real_t(rest_rotation_ + double(pose.rotation.angle())));
	}
}

void SoftBodyAttachment2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBodyAttachment2D::get_warnings);
	ClassDB::bind_method(D_METHOD("attach_at", "position", "rotation"), &SoftBodyAttachment2D::attach_at, DEFVAL(0.0));

	softbody::bind_property("follow_rotation", &SoftBodyAttachment2D::set_follow_rotation, &SoftBodyAttachment2D::is_following_rotation, PROPERTY_HINT_NONE, "", "is_following_rotation");
	softbody::bind_property("rest_position", &SoftBodyAttachment2D::set_rest_position, &SoftBodyAttachment2D::get_rest_position, PROPERTY_HINT_NONE, "suffix:px", nullptr, nullptr, PROPERTY_USAGE_NONE);
	softbody::bind_property("rest_rotation", &SoftBodyAttachment2D::set_rest_rotation, &SoftBodyAttachment2D::get_rest_rotation, PROPERTY_HINT_RANGE, "-360,360,0.1,or_less,or_greater,radians_as_degrees", nullptr, nullptr, PROPERTY_USAGE_NONE);
}

} // namespace godot
