// SPDX-License-Identifier: MIT
// Points of the node that are held in place, or at another node.
#include "godot/nodes/soft_body_2d.h"

#include "godot/convert.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <set>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

// A pin's target is looked up until it is there; then the pin keeps its place in the target's frame.
Node2D *target_of(const Node *p_owner, const NodePath &p_path) {
	return p_path.is_empty() ? nullptr : Object::cast_to<Node2D>(p_owner->get_node_or_null(p_path));
}

} // namespace

void SoftBody2D::set_pinned_points(const PackedInt32Array &p_points) {
	std::set<int32_t> seen;
	for (const int32_t point : p_points) {
		ERR_FAIL_COND_MSG(point < 0, describe() + ": pinned_points refused: point = " + itos(point) + " must be at least 0. The old value stays.");
		ERR_FAIL_COND_MSG(!seen.insert(point).second, describe() + ": pinned_points refused: point " + itos(point) + " is in it twice. The old value stays.");
	}
	pinned_points_ = p_points;
	pin_targets_.resize(p_points.size());
	pins_.clear();
	apply_pins();
	update_configuration_warnings();
}

void SoftBody2D::set_pin_targets(const TypedArray<NodePath> &p_targets) {
	pin_targets_ = p_targets.duplicate();
	pins_.clear();
	note_change();
	update_configuration_warnings();
}

bool SoftBody2D::is_point_pinned(int p_index) const {
	return pinned_points_.has(p_index);
}

void SoftBody2D::set_point_pinned(int p_index, bool p_pinned, const NodePath &p_target) {
	ERR_FAIL_COND_MSG(p_index < 0 || p_index >= get_point_count(), describe() + ": point index " + itos(p_index) + " must be between 0 and " + itos(get_point_count() - 1) + ".");
	const int64_t place = pinned_points_.find(p_index);
	pin_targets_.resize(pinned_points_.size());
	if (place >= 0) {
		if (p_pinned && NodePath(pin_targets_[place]) == p_target) {
			return;
		}
		pinned_points_.remove_at(place);
		pin_targets_.remove_at(place);
		pins_.clear();
	}
	if (p_pinned) {
		pinned_points_.push_back(p_index);
		pin_targets_.push_back(p_target);
	}
	pins_.clear();
	apply_pins();
	update_configuration_warnings();
}

NodePath SoftBody2D::get_pin_target(int p_index) const {
	const int64_t place = pinned_points_.find(p_index);
	return place >= 0 && place < pin_targets_.size() ? NodePath(pin_targets_[place]) : NodePath();
}

// Which points of the core's body are pinned follows the list; where they are stays.
void SoftBody2D::apply_pins() {
	softbody::SoftBodyData *found = body();
	note_change();
	if (found == nullptr) {
		return;
	}
	for (int i = 0; i < int(found->point_count()); i++) {
		const uint32_t point = uint32_t(core_index(i));
		const bool pinned = pinned_points_.has(i);
		if (found->is_pinned(point) != pinned) {
			accept("pinned_points", found->set_pinned(point, pinned));
		}
	}
}

// Before a step: pins on nodes go where those are now.
void SoftBody2D::follow_pin_targets() {
	softbody::SoftBodyData *found = body();
	if (found == nullptr || pinned_points_.is_empty()) {
		return;
	}
	pins_.resize(size_t(pinned_points_.size()));
	for (int64_t i = 0; i < MIN(pinned_points_.size(), pin_targets_.size()); i++) {
		Pin &pin = pins_[size_t(i)];
		if (pinned_points_[i] >= get_point_count()) {
			continue; // the hull has become smaller; a warning says so
		}
		const uint32_t point = uint32_t(core_index(pinned_points_[i]));
		Node2D *target = Object::cast_to<Node2D>(ObjectDB::get_instance(pin.target));
		if (target == nullptr) {
			target = target_of(this, pin_targets_[i]);
			if (target == nullptr || !target->is_inside_tree()) {
				continue; // held where it is
			}
			pin.target = target->get_instance_id();
			pin.place = target->get_global_transform().affine_inverse().xform(to_godot(found->positions()[point]));
		}
		if (!target->is_inside_tree()) {
			continue;
		}
		const softbody::Vec2 place = to_core(target->get_global_transform().xform(pin.place));
		if (!(place == found->positions()[point])) {
			accept("pin_targets", found->set_pin_target(point, place));
		}
	}
}

void SoftBody2D::append_pin_warnings(PackedStringArray &r_warnings) const {
	for (int64_t i = 0; i < pinned_points_.size(); i++) {
		if (pinned_points_[i] >= get_point_count()) {
			r_warnings.push_back("Point " + itos(pinned_points_[i]) + " is pinned, but the body has " + itos(get_point_count()) + " points. Take it out of pinned_points.");
		}
		const NodePath path = i < pin_targets_.size() ? NodePath(pin_targets_[i]) : NodePath();
		if (!path.is_empty() && is_inside_tree() && target_of(this, path) == nullptr) {
			r_warnings.push_back("Point " + itos(pinned_points_[i]) + " is pinned to '" + String(path) + "', which is no Node2D in the scene. It is held in place instead. Choose another node, or none.");
		}
	}
	if (pin_targets_.size() > pinned_points_.size()) {
		r_warnings.push_back("There are more pin_targets than pinned_points. Those beyond are not used.");
	}
}

void SoftBody2D::bind_pins() {
	ClassDB::bind_method(D_METHOD("set_pinned_points", "points"), &SoftBody2D::set_pinned_points);
	ClassDB::bind_method(D_METHOD("get_pinned_points"), &SoftBody2D::get_pinned_points);
	ClassDB::bind_method(D_METHOD("set_pin_targets", "targets"), &SoftBody2D::set_pin_targets);
	ClassDB::bind_method(D_METHOD("get_pin_targets"), &SoftBody2D::get_pin_targets);
	ClassDB::bind_method(D_METHOD("set_point_pinned", "point_index", "pinned", "target"), &SoftBody2D::set_point_pinned, DEFVAL(NodePath()));
	ClassDB::bind_method(D_METHOD("is_point_pinned", "point_index"), &SoftBody2D::is_point_pinned);
	ClassDB::bind_method(D_METHOD("get_pin_target", "point_index"), &SoftBody2D::get_pin_target);
}

} // namespace godot
