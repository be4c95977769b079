// SPDX-License-Identifier: MIT
// Warns of Godot's own joints that name a SoftBody2D.
#include "godot/nodes/engine_joints.h"

#include "godot/nodes/soft_body_2d.h"

#include <godot_cpp/classes/scene_tree.hpp>
#include <godot_cpp/classes/window.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/variant/callable_method_pointer.hpp>

using namespace godot;

namespace softbody {

namespace {

// After the frame in which it came, when a script has named its ends.
void check_joint(uint64_t p_id) {
	const Node *joint = Object::cast_to<Node>(ObjectDB::get_instance(p_id));
	if (joint == nullptr || !joint->is_inside_tree()) {
		return;
	}
	for (const char *end : { "node_a", "node_b" }) {
		const NodePath path = joint->get(end);
		const SoftBody2D *body = path.is_empty() ? nullptr : Object::cast_to<SoftBody2D>(joint->get_node_or_null(path));
		if (body != nullptr) {
			WARN_PRINT(joint->get_class() + " '" + String(joint->get_name()) + "' (" + String(joint->get_path()) + ") joins nothing: its " + end + " is " + body->describe() + ", and Godot's joints take physics bodies only. Use a SoftBodyJoint2D.");
		}
	}
}

void note_node(Node *p_node) {
	if (p_node->is_class("Joint2D")) {
		callable_mp_static(&check_joint).call_deferred(p_node->get_instance_id());
	}
}

} // namespace

void watch_engine_joints(SceneTree *tree) {
	static uint64_t watched_tree = 0;
	if (watched_tree == tree->get_instance_id()) {
		return;
	}
	watched_tree = tree->get_instance_id();
	tree->connect("node_added", callable_mp_static(&note_node));
	const TypedArray<Node> present = tree->get_root()->find_children("*", "Joint2D", true, false);
	for (int64_t i = 0; i < present.size(); i++) {
		note_node(Object::cast_to<Node>(present[i]));
	}
}

} // namespace softbody
