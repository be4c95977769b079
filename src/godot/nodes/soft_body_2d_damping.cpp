// SPDX-License-Identifier: MIT
// The node's damping, its own and that of areas, and the gravity of areas.
#include "godot/nodes/soft_body_2d.h"

#include "godot/surroundings/area_effects.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/classes/scene_tree.hpp>
#include <godot_cpp/core/class_db.hpp>

namespace godot {

void SoftBody2D::set_linear_damp(double p_damp) {
	if (accept("linear_damp", softbody::check_at_least("linear_damp", p_damp, 0, "1/s"))) {
		linear_damp_ = p_damp;
		note_change();
	}
}

void SoftBody2D::set_angular_damp(double p_damp) {
	if (accept("angular_damp", softbody::check_at_least("angular_damp", p_damp, 0, "1/s"))) {
		angular_damp_ = p_damp;
		note_change();
	}
}

void SoftBody2D::set_linear_damp_mode(DampMode p_mode) {
	if (accept("linear_damp_mode", softbody::check_between("linear_damp_mode", p_mode, 0, 1, ""))) {
		linear_damp_mode_ = p_mode;
		note_change();
	}
}

void SoftBody2D::set_angular_damp_mode(DampMode p_mode) {
	if (accept("angular_damp_mode", softbody::check_between("angular_damp_mode", p_mode, 0, 1, ""))) {
		angular_damp_mode_ = p_mode;
		note_change();
	}
}

void SoftBody2D::stir_proxy() {
	if (proxy_.is_in_space()) {
		proxy_.stir();
	}
}

// What the engine has worked out holds from the second step on that it has seen the proxy in: its first one asks for gravity
// before it looks at areas. While the tree is paused the engine makes no steps, and what it last said goes on holding.
void SoftBody2D::feel_areas(const softbody::AreaEffects &p_space) {
	softbody::SoftBodyData *found = body();
	if (found == nullptr || !found->is_active()) {
		return;
	}
	softbody::AreaEffects effects = p_space;
	if (proxy_.is_in_space()) {
		if (!get_tree()->is_paused()) {
			engine_steps_++;
		}
		if (engine_steps_ > 1) {
			effects = softbody::read_area_effects(proxy_.rid());
		} else if (knows_areas_) {
			return; // It has just come back: until the engine knows, what held before it left.
		}
	}
	// A body that is made asleep is told of the project's damping for the first time; that is no reason to wake.
	const bool stays_asleep = !knows_areas_ && found->is_asleep();
	knows_areas_ = true;
	effects.linear_damp = softbody::DampChoice{ softbody::Real(linear_damp_), linear_damp_mode_ == DAMP_MODE_REPLACE }.combined_with(effects.linear_damp);
	effects.angular_damp = softbody::DampChoice{ softbody::Real(angular_damp_), angular_damp_mode_ == DAMP_MODE_REPLACE }.combined_with(effects.angular_damp);
	accept("areas", softbody::apply_area_effects(effects, p_space, *found));
	if (stays_asleep) {
		found->put_to_sleep();
	}
}

void SoftBody2D::bind_damping() {
	ClassDB::bind_method(D_METHOD("set_linear_damp_mode", "linear_damp_mode"), &SoftBody2D::set_linear_damp_mode);
	ClassDB::bind_method(D_METHOD("get_linear_damp_mode"), &SoftBody2D::get_linear_damp_mode);
	ClassDB::bind_method(D_METHOD("set_linear_damp", "linear_damp"), &SoftBody2D::set_linear_damp);
	ClassDB::bind_method(D_METHOD("get_linear_damp"), &SoftBody2D::get_linear_damp);
	ClassDB::bind_method(D_METHOD("set_angular_damp_mode", "angular_damp_mode"), &SoftBody2D::set_angular_damp_mode);
	ClassDB::bind_method(D_METHOD("get_angular_damp_mode"), &SoftBody2D::get_angular_damp_mode);
	ClassDB::bind_method(D_METHOD("set_angular_damp", "angular_damp"), &SoftBody2D::set_angular_damp);
	ClassDB::bind_method(D_METHOD("get_angular_damp"), &SoftBody2D::get_angular_damp);

	BIND_ENUM_CONSTANT(DAMP_MODE_COMBINE);
	BIND_ENUM_CONSTANT(DAMP_MODE_REPLACE);
}

} // namespace godot
