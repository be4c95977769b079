// SPDX-License-Identifier: MIT
// Whether the node's body moves at all: sleep, freezing, and being seen.
#include "godot/nodes/soft_body_2d.h"

#include "godot/server/body_signals.h"

#include <godot_cpp/core/class_db.hpp>

namespace godot {

void SoftBody2D::set_sleeping(bool p_sleeping) {
	sleeping_ = p_sleeping;
	if (softbody::SoftBodyData *found = followed_body()) {
		if (p_sleeping) {
			found->put_to_sleep();
		} else {
			found->wake();
		}
	}
}

bool SoftBody2D::is_sleeping() const {
	const softbody::SoftBodyData *found = followed_body();
	return found != nullptr ? found->is_asleep() : sleeping_;
}

void SoftBody2D::set_can_sleep(bool p_able) {
	can_sleep_ = p_able;
	apply_settings();
}

void SoftBody2D::set_freeze_enabled(bool p_freeze) {
	freeze_ = p_freeze;
	if (softbody::SoftBodyData *found = followed_body()) {
		found->set_frozen(p_freeze);
	}
}

void SoftBody2D::take_sleep(softbody::BodySignals &r_signals) {
	const softbody::SoftBodyData *found = body();
	if (found != nullptr && found->is_asleep() != sleeping_) {
		sleeping_ = found->is_asleep();
		r_signals.add_sleep_changed(get_instance_id());
	}
}

void SoftBody2D::bind_sleep() {
	ClassDB::bind_method(D_METHOD("set_sleeping", "sleeping"), &SoftBody2D::set_sleeping);
	ClassDB::bind_method(D_METHOD("is_sleeping"), &SoftBody2D::is_sleeping);
	ClassDB::bind_method(D_METHOD("set_can_sleep", "able_to_sleep"), &SoftBody2D::set_can_sleep);
	ClassDB::bind_method(D_METHOD("is_able_to_sleep"), &SoftBody2D::is_able_to_sleep);
	ClassDB::bind_method(D_METHOD("set_simulate_off_screen", "enabled"), &SoftBody2D::set_simulate_off_screen);
	ClassDB::bind_method(D_METHOD("is_simulating_off_screen"), &SoftBody2D::is_simulating_off_screen);
	ClassDB::bind_method(D_METHOD("set_freeze_enabled", "freeze"), &SoftBody2D::set_freeze_enabled);
	ClassDB::bind_method(D_METHOD("is_freeze_enabled"), &SoftBody2D::is_freeze_enabled);

	ADD_GROUP("Deactivation", "");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "sleeping"), "set_sleeping", "is_sleeping");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "can_sleep"), "set_can_sleep", "is_able_to_sleep");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "freeze"), "set_freeze_enabled", "is_freeze_enabled");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "simulate_off_screen"), "set_simulate_off_screen", "is_simulating_off_screen");

	ADD_SIGNAL(MethodInfo("sleeping_state_changed"));
}

} // namespace godot
