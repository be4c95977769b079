// SPDX-License-Identifier: MIT
// Signals of a step, kept until every node is up to date.
#include "godot/server/body_signals.h"

#include "godot/nodes/soft_body_2d.h"
#include "godot/nodes/soft_body_joint_2d.h"

#include <godot_cpp/core/object.hpp>

#include <utility>

using namespace godot;

namespace softbody {

namespace {

template <class Class>
Class *find(uint64_t p_id) {
	return p_id == 0 ? nullptr : Object::cast_to<Class>(ObjectDB::get_instance(p_id));
}

} // namespace

void BodySignals::emit() {
	if (pending_.empty()) {
		return;
	}
	// A listener must not step anything, but it may add to this list: the loop works on a list of its own.
	std::vector<Pending> now = std::exchange(pending_, {});
	for (const Pending &each : now) {
		if (each.kind == Kind::SLEEP_CHANGED || each.kind == Kind::FAILED) {
			if (SoftBody2D *body = find<SoftBody2D>(each.body)) {
				body->emit_signal(each.kind == Kind::FAILED ? "failed" : "sleeping_state_changed");
			}
			continue;
		}
		if (each.kind == Kind::BROKEN) {
			if (SoftBodyJoint2D *joint = find<SoftBodyJoint2D>(each.body)) {
				joint->emit_signal("broken");
			}
			continue;
		}
		SoftBody2D *body = find<SoftBody2D>(each.body);
		Node *collider = find<Node>(each.collider);
		if (body == nullptr || collider == nullptr || !body->watches_contacts()) {
			continue;
		}
		body->watch_collider(collider, each.kind == Kind::ENTERED);
		body->emit_signal(each.kind == Kind::ENTERED ? "body_entered" : "body_exited", collider);
		// A listener of the first signal may have freed either.
		body = find<SoftBody2D>(each.body);
		collider = find<Node>(each.collider);
		if (each.kind == Kind::ENTERED && body != nullptr && collider != nullptr) {
			body->emit_signal("contact_started", collider, each.impact.point, each.impact.normal, each.impact.impulse);
		}
	}
	now.clear();
	if (pending_.empty()) {
		pending_ = std::move(now); // keeps its memory
	}
}

} // namespace softbody
