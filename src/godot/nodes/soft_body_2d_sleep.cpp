// SPDX-License-Identifier: MIT
// Whether the node's body moves at all: sleep, freezing, being seen, and having failed.
#include "godot/nodes/soft_body_2d.h"

#include "godot/server/step_signals.h"

#include <godot_cpp/classes/scene_tree.hpp>
#include <godot_cpp/core/class_db.hpp>

namespace godot {

namespace {

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
	if (followed_body() != nullptr) {
		apply_freeze();
	}
}

// A frozen body is what Godot calls static.
void SoftBody2D::apply_freeze() {
	if (softbody::SoftBodyData *found = body()) {
		found->set_frozen(freeze_ || is_held_static());
		note_change();
	}
}

void SoftBody2D::set_disable_mode(DisableMode p_mode) {
	if (accept("disable_mode", softbody::check_between("disable_mode", p_mode, DISABLE_MODE_REMOVE, DISABLE_MODE_KEEP_ACTIVE, ""))) {
		disable_mode_ = p_mode;
		apply_freeze();
		update_proxy_presence();
	}
}

void SoftBody2D::note_enabled() {
	enabled_ = is_enabled(this);
	note_change();
	apply_freeze();
	update_proxy_presence();
}

// While the tree is paused Godot's physics rests, whatever the disable mode.
bool SoftBody2D::takes_part() const {
	return enabled_ || disable_mode_ == DISABLE_MODE_REMOVE ? can_process() : !get_tree()->is_paused();
}

void SoftBody2D::set_simulate_off_screen(bool p_enabled) {
	simulate_off_screen_ = p_enabled;
	note_change();
}

void SoftBody2D::set_failure_mode(FailureMode p_mode) {
	if (accept("failure_mode", softbody::check_between("failure_mode", p_mode, FAILURE_MODE_RESET, FAILURE_MODE_FREEZE, ""))) {
		failure_mode_ = p_mode;
		apply_settings();
	}
}

void SoftBody2D::note_failure(softbody::StepSignals &r_signals) {
	r_signals.add(get_instance_id(), [this] { emit_signal("failed"); });
	String consequence = "it has its rest shape again, where it was before this tick";
	if (failure_mode_ == FAILURE_MODE_FREEZE) {
		freeze_ = true;
		consequence += ", and is frozen";
	}
	ERR_PRINT(describe() + ": its motion became non-finite or tore it apart; " + consequence + ". Lower the stiffness or the forces, or raise the substeps.");
}

void SoftBody2D::take_sleep(softbody::StepSignals &r_signals) {
	const softbody::SoftBodyData *found = body();
	if (found != nullptr && found->is_asleep() != sleeping_) {
		sleeping_ = found->is_asleep();
		r_signals.add(get_instance_id(), [this] { emit_signal("sleeping_state_changed"); });
	}
}

void SoftBody2D::bind_sleep() {
	ClassDB::bind_method(D_METHOD("set_sleeping", "sleeping"), &SoftBody2D::set_sleeping);
	ClassDB::bind_method(D_METHOD("is_sleeping"), &SoftBody2D::is_sleeping);
	ClassDB::bind_method(D_METHOD("set_can_sleep", "able_to_sleep"), &SoftBody2D::set_can_sleep);
	ClassDB::bind_method(D_METHOD("is_able_to_sleep"), &SoftBody2D::is_able_to_sleep);
	ClassDB::bind_method(D_METHOD("set_failure_mode", "mode"), &SoftBody2D::set_failure_mode);
	ClassDB::bind_method(D_METHOD("get_failure_mode"), &SoftBody2D::get_failure_mode);
	ClassDB::bind_method(D_METHOD("set_disable_mode", "mode"), &SoftBody2D::set_disable_mode);
	ClassDB::bind_method(D_METHOD("get_disable_mode"), &SoftBody2D::get_disable_mode);
	ClassDB::bind_method(D_METHOD("set_simulate_off_screen", "enabled"), &SoftBody2D::set_simulate_off_screen);
	ClassDB::bind_method(D_METHOD("is_simulating_off_screen"), &SoftBody2D::is_simulating_off_screen);
	ClassDB::bind_method(D_METHOD("set_freeze_enabled", "freeze"), &SoftBody2D::set_freeze_enabled);
	ClassDB::bind_method(D_METHOD("is_freeze_enabled"), &SoftBody2D::is_freeze_enabled);

	ADD_SIGNAL(MethodInfo("sleeping_state_changed"));
	ADD_SIGNAL(MethodInfo("failed"));

	BIND_ENUM_CONSTANT(DISABLE_MODE_REMOVE);
	BIND_ENUM_CONSTANT(DISABLE_MODE_MAKE_STATIC);
	BIND_ENUM_CONSTANT(DISABLE_MODE_KEEP_ACTIVE);
	BIND_ENUM_CONSTANT(FAILURE_MODE_RESET);
	BIND_ENUM_CONSTANT(FAILURE_MODE_FREEZE);
}

} // namespace godot
