// SPDX-License-Identifier: MIT
// Whether the node's body moves at all: sleep, freezing, being seen, and having failed.
#include "godot/nodes/soft_body_2d.h"

#include "godot/server/step_signals.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/scene_tree.hpp>

#include <utility>

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

void SoftBody2D::note_enabled() {
	enabled_ = is_enabled(this);
	note_change();
	apply_freeze();
	update_proxy_presence();
}

// While the tree is paused Godot's physics rests, whatever the disable mode.
bool SoftBody2D::takes_part() const {
	return enabled_ || values_.disable_mode == DISABLE_MODE_REMOVE ? can_process() : !get_tree()->is_paused();
}

void SoftBody2D::note_failure(softbody::StepSignals &r_signals) {
	r_signals.add(get_instance_id(), [this] { emit_signal("failed"); });
	String consequence = "it has its rest shape again, where it was before this tick";
	if (values_.failure_mode == FAILURE_MODE_FREEZE) {
		freeze_ = true;
		consequence += ", and is frozen";
	}
	// A body that fails in every tick says so once a second.
	unsaid_failures_++;
	const uint64_t now = Engine::get_singleton()->get_physics_frames();
	if (last_said_failure_ != 0 && now - last_said_failure_ < uint64_t(Engine::get_singleton()->get_physics_ticks_per_second())) {
		return;
	}
	const String count = unsaid_failures_ > 1 ? " (" + itos(unsaid_failures_) + " times since this was last said)" : "";
	last_said_failure_ = now;
	unsaid_failures_ = 0;
	ERR_PRINT(describe() + ": its motion became non-finite or tore it apart; " + consequence + count + ". Lower the stiffness or the forces, or raise the substeps.");
}

void SoftBody2D::take_sleep(softbody::StepSignals &r_signals) {
	const softbody::SoftBodyData *found = body();
	if (found == nullptr) {
		return;
	}
	const bool before = std::exchange(sleeping_, found->is_asleep());
	if (r_signals.is_quiet()) {
		told_sleep_.note_silence(before);
	} else if (told_sleep_.take(before) != sleeping_) {
		r_signals.add(get_instance_id(), [this] { emit_signal("sleeping_state_changed"); });
	}
}

} // namespace godot
