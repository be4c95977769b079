// SPDX-License-Identifier: MIT
// Tells a SoftBody2D of the mouse and of touches.
#include "godot/nodes/body_picker.h"

#include "godot/nodes/soft_body_2d.h"

#include <godot_cpp/classes/input.hpp>
#include <godot_cpp/classes/viewport.hpp>

namespace godot {

SoftBodyPicker::SoftBodyPicker() {
	set_process_unhandled_input(true);
	set_physics_process_internal(true);
}

SoftBody2D *SoftBodyPicker::soft_body() const {
	return Object::cast_to<SoftBody2D>(get_parent());
}

// The engine picks under the same conditions.
bool SoftBodyPicker::is_asked() const {
	const SoftBody2D *body = soft_body();
	return body != nullptr && body->is_visible_in_tree() && body->get_value<&SoftBody2D::Values::collision_layer>() != 0 &&
			get_viewport()->get_physics_object_picking() && Input::get_singleton()->get_mouse_mode() != Input::MOUSE_MODE_CAPTURED;
}

bool SoftBodyPicker::is_at(const Vector2 &p_place) const {
	const SoftBody2D *body = soft_body();
	return body->has_point(body->get_canvas_transform().affine_inverse().xform(p_place));
}

void SoftBodyPicker::_unhandled_input(const Ref<InputEvent> &p_event) {
	const bool is_mouse = p_event->is_class("InputEventMouse");
	if (!is_mouse && !p_event->is_class("InputEventScreenTouch") && !p_event->is_class("InputEventScreenDrag")) {
		return;
	}
	if (!is_asked()) {
		forget_mouse();
		return;
	}
	const Vector2 place = p_event->get("position");
	const bool is_hit = is_at(place);
	const uint64_t id = get_instance_id();
	if (is_mouse) {
		mouse_ = place;
		set_over(is_hit);
	}
	// A listener may have freed the body, or taken it out of the tree.
	if (is_hit && ObjectDB::get_instance(id) != nullptr && is_inside_tree()) {
		soft_body()->emit_signal("input_event", get_viewport(), p_event, 0);
	}
}

void SoftBodyPicker::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_INTERNAL_PHYSICS_PROCESS: { // the body may have moved to the mouse, or away from it
			if (mouse_ && is_asked()) {
				set_over(is_at(*mouse_));
			} else if (mouse_) {
				forget_mouse();
			}
		} break;
		case NOTIFICATION_VP_MOUSE_EXIT:
		case NOTIFICATION_DISABLED:
		case NOTIFICATION_EXIT_TREE: {
			forget_mouse();
		} break;
		default:
			break;
	}
}

void SoftBodyPicker::forget_mouse() {
	mouse_.reset();
	set_over(false);
}

void SoftBodyPicker::set_over(bool p_over) {
	if (is_over_ == p_over) {
		return;
	}
	is_over_ = p_over;
	if (SoftBody2D *body = soft_body()) {
		body->emit_signal(p_over ? "mouse_entered" : "mouse_exited");
	}
}

} // namespace godot
