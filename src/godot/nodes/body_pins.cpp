// SPDX-License-Identifier: MIT
// Points of a node that are held in place, or at another node.
#include "godot/nodes/body_pins.h"

#include <set>
#include <string>

using namespace godot;

namespace softbody {

namespace {

Node2D *find_target(const Node &p_owner, const NodePath &p_path) {
	return p_path.is_empty() ? nullptr : Object::cast_to<Node2D>(p_owner.get_node_or_null(p_path));
}

} // namespace

Status BodyPins::check(const PackedInt32Array &p_points) {
	std::set<int32_t> seen;
	for (const int32_t point : p_points) {
		if (point < 0) {
			return Error{ "point", std::to_string(point), "must be at least 0", "give the index of a point" };
		}
		if (!seen.insert(point).second) {
			return Error{ "point", std::to_string(point), "is in it twice", "remove one of the two" };
		}
	}
	return {};
}

NodePath BodyPins::target_of(int p_point) const {
	const int64_t place = points_.find(p_point);
	return place >= 0 && place < targets_.size() ? NodePath(targets_[place]) : NodePath();
}

void BodyPins::set_points(const PackedInt32Array &p_points) {
	points_ = p_points;
	targets_.resize(p_points.size());
	places_.clear();
}

void BodyPins::set_targets(const TypedArray<NodePath> &p_targets) {
	targets_ = p_targets.duplicate();
	places_.clear();
}

bool BodyPins::pin(int p_point, const NodePath &p_target) {
	if (has(p_point) && target_of(p_point) == p_target) {
		return false;
	}
	unpin(p_point);
	points_.push_back(p_point);
	targets_.push_back(p_target);
	return true;
}

void BodyPins::unpin(int p_point) {
	targets_.resize(points_.size());
	const int64_t place = points_.find(p_point);
	if (place >= 0) {
		points_.remove_at(place);
		targets_.remove_at(place);
	}
	places_.clear();
}

void BodyPins::take_over(const SoftBodyData &p_body, PointOrder p_order) {
	const auto is_pinned = [&](int p_point) { return p_point < int(p_body.point_count()) && p_body.is_pinned(uint32_t(p_order.mirror(p_point))); };
	for (const int32_t point : PackedInt32Array(points_)) {
		if (!is_pinned(point)) {
			unpin(point);
		}
	}
	for (int point = 0; point < int(p_body.point_count()); point++) {
		if (is_pinned(point) && !has(point)) {
			pin(point, NodePath());
		}
	}
}

void BodyPins::take_part(const BodyPins &p_whole, std::span<const std::pair<int, int>> p_points) {
	BodyPins part;
	for (const auto &[point, source] : p_points) {
		const int64_t found = p_whole.points_.find(source);
		part.points_.push_back(point);
		part.targets_.push_back(p_whole.target_of(source));
		part.places_.push_back(found >= 0 && found < int64_t(p_whole.places_.size()) ? p_whole.places_[size_t(found)] : Place());
	}
	*this = std::move(part);
}

Status BodyPins::apply(SoftBodyData &r_body, PointOrder p_order) const {
	Status status;
	for (int i = 0; i < int(r_body.point_count()); i++) {
		const uint32_t point = uint32_t(p_order.mirror(i));
		if (r_body.is_pinned(point) != has(i)) {
			if (Status refused = r_body.set_pinned(point, has(i))) {
				status = refused;
			}
		}
	}
	return status;
}

Status BodyPins::follow(const Node &p_owner, SoftBodyData &r_body, PointOrder p_order) {
	Status status;
	places_.resize(size_t(points_.size()));
	for (int64_t i = 0; i < MIN(points_.size(), targets_.size()); i++) {
		Place &place = places_[size_t(i)];
		if (points_[i] >= int(r_body.point_count())) {
			continue; // the hull has become smaller; a warning says so
		}
		const uint32_t point = uint32_t(p_order.mirror(points_[i]));
		Node2D *target = Object::cast_to<Node2D>(ObjectDB::get_instance(place.target));
		if (target == nullptr) {
			target = find_target(p_owner, targets_[i]);
			if (target == nullptr || !target->is_inside_tree()) {
				continue; // held where it is
			}
			place.target = target->get_instance_id();
			place.position = target->get_global_transform().affine_inverse().xform(to_godot(r_body.positions()[point]));
		}
		if (!target->is_inside_tree()) {
			continue;
		}
		const Vec2 position = to_core(target->get_global_transform().xform(place.position));
		if (!(position == r_body.positions()[point])) {
			if (Status refused = r_body.set_pin_target(point, position)) {
				status = refused;
			}
		}
	}
	return status;
}

void BodyPins::append_warnings(const Node &p_owner, int p_point_count, PackedStringArray &r_warnings) const {
	for (int64_t i = 0; i < points_.size(); i++) {
		if (points_[i] >= p_point_count) {
			r_warnings.push_back("Point " + itos(points_[i]) + " is pinned, but the body has " + itos(p_point_count) + " points. Take it out of pinned_points.");
		}
		const NodePath path = i < targets_.size() ? NodePath(targets_[i]) : NodePath();
		if (!path.is_empty() && p_owner.is_inside_tree() && find_target(p_owner, path) == nullptr) {
			r_warnings.push_back("Point " + itos(points_[i]) + " is pinned to '" + String(path) + "', which is no Node2D in the scene. It is held in place instead. Choose another node, or none.");
		}
	}
	if (targets_.size() > points_.size()) {
		r_warnings.push_back("There are more pin_targets than pinned_points. Those beyond are not used.");
	}
}

} // namespace softbody
