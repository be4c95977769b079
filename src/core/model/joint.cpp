// SPDX-License-Identifier: MIT
// Validator and storage of joints, and anchors on bodies.
#include "core/model/joint.h"

#include "core/geometry/segment.h"
#include "core/model/soft_body_data.h"

#include <cmath>
#include <string>
#include <utility>

namespace softbody {

namespace {

Status check_anchor(const std::string &name, const JointAnchor &anchor) {
	if (!is_finite(anchor.position)) {
		return Error{ name + ".position", "non-finite", "must be finite", "check the computation that produced this value" };
	}
	if (anchor.kind == JointAnchor::Kind::RIGID_BODY && anchor.tag == 0) {
		return Error{ name + ".tag", "0", "must name a rigid body", "give the rigid body a tag of its own and name that" };
	}
	return check_between(name + ".fraction", anchor.fraction, 0, 1, "");
}

// Refuses values below 0 (or equal, unless `may_be_zero`) and NaN; infinity has a meaning here.
Status check_up_to_infinity(const std::string &name, Real value, bool may_be_zero, const std::string &unit) {
	if (std::isinf(value) && value > 0) {
		return {};
	}
	return may_be_zero ? check_at_least(name, value, 0, unit) : check_above(name, value, 0, unit);
}

} // namespace

Status check_joint(const Joint &joint) {
	if (Status status = check_anchor("joint.first", joint.first)) {
		return status;
	}
	if (Status status = check_anchor("joint.second", joint.second)) {
		return status;
	}
	if (!joint.first.is_soft() && !joint.second.is_soft()) {
		return Error{ "joint.first", "not on a soft body", "must be on a soft body, or the second anchor must be",
			"use the engine's own joints between rigid bodies" };
	}
	if (joint.first.is_soft() && joint.second.is_soft() && joint.first.body == joint.second.body) {
		return Error{ "joint.second", "on the body of the first anchor", "must be on another body",
			"put a spring into the body's shape" };
	}
	if (Status status = check_at_least("joint.rest_length", joint.rest_length, 0, "m")) {
		return status;
	}
	if (Status status = check_up_to_infinity("joint.stiffness", joint.stiffness, true, "N/m")) {
		return status;
	}
	if (Status status = check_at_least("joint.damping", joint.damping, 0, "N·s/m")) {
		return status;
	}
	return check_up_to_infinity("joint.break_force", joint.break_force, false, "N");
}

JointAnchor nearest_anchor(const SoftBodyData &body, BodyId id, Vec2 place) {
	const auto hull = body.hull();
	Real nearest = std::numeric_limits<Real>::infinity();
	JointAnchor anchor;
	for (std::uint32_t i = 0; i < hull.size(); ++i) {
		const Vec2 a = hull[i];
		const Vec2 b = hull[(i + 1) % hull.size()];
		const Real fraction = closest_parameter_on_segment(place, a, b);
		const Real distance = length_squared(place - a - (b - a) * fraction);
		if (distance < nearest) {
			nearest = distance;
			anchor = JointAnchor::on_edge(id, i, fraction);
		}
	}
	for (std::uint32_t i = std::uint32_t(hull.size()); i < body.point_count(); ++i) {
		const Real distance = length_squared(place - body.positions()[i]);
		if (distance < nearest) {
			nearest = distance;
			anchor = JointAnchor::on_point(id, i);
		}
	}
	return anchor;
}

Vec2 position_of(const JointAnchor &anchor, const SoftBodyData &body) {
	const Vec2 a = body.positions()[anchor.point];
	const Vec2 b = anchor.fraction > 0 ? body.hull()[(anchor.point + 1) % body.hull().size()] : a;
	return a + (b - a) * anchor.fraction;
}

JointId JointList::add(const Joint &joint) {
	if (free_slots_.empty()) {
		free_slots_.push_back(std::uint32_t(slots_.size()));
		slots_.emplace_back();
	}
	const std::uint32_t slot = free_slots_.back();
	free_slots_.pop_back();
	slots_[slot].dense = std::uint32_t(joints_.size());
	joints_.push_back(joint);
	return ids_.emplace_back(JointId{ slot, slots_[slot].generation });
}

bool JointList::remove(JointId id) {
	if (!find(id)) {
		return false;
	}
	const std::uint32_t dense = slots_[id.index].dense;
	joints_[dense] = joints_.back();
	ids_[dense] = ids_.back();
	slots_[ids_[dense].index].dense = dense;
	joints_.pop_back();
	ids_.pop_back();
	slots_[id.index].dense = UINT32_MAX;
	slots_[id.index].generation++;
	free_slots_.push_back(id.index);
	return true;
}

Joint *JointList::find(JointId id) {
	if (id.index >= slots_.size() || slots_[id.index].dense == UINT32_MAX || slots_[id.index].generation != id.generation) {
		return nullptr;
	}
	return &joints_[slots_[id.index].dense];
}

} // namespace softbody
