// SPDX-License-Identifier: MIT
// Validator of joints, and anchors on bodies.
#include "core/model/joint.h"

#include "core/geometry/polygon.h"
#include "core/model/soft_body_data.h"

#include <cmath>
#include <string>

namespace softbody {

namespace {

Status check_anchor(const std::string &name, const JointAnchor &anchor) {
	if (anchor.kind == JointAnchor::Kind::RIGID_BODY && anchor.tag == 0) {
		return Error{ name + ".tag", "0", "must name a rigid body", "give the rigid body a tag of its own and name that" };
	}
	return first_error({ check_finite(name + ".position", anchor.position), check_between(name + ".fraction", anchor.fraction, 0, 1, "") });
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
	if (!joint.first.is_soft() && !joint.second.is_soft()) {
		return Error{ "joint.first", "not on a soft body", "must be on a soft body, or the second anchor must be",
			"use the engine's own joints between rigid bodies" };
	}
	if (joint.first.is_soft() && joint.second.is_soft() && joint.first.body == joint.second.body) {
		return Error{ "joint.second", "on the body of the first anchor", "must be on another body",
			"put a spring into the body's shape" };
	}
	return first_error({ check_anchor("joint.first", joint.first), check_anchor("joint.second", joint.second),
			check_at_least("joint.rest_length", joint.rest_length, 0, "m"),
			check_up_to_infinity("joint.stiffness", joint.stiffness, true, "N/m"),
			check_at_least("joint.damping", joint.damping, 0, "N·s/m"),
			check_up_to_infinity("joint.break_force", joint.break_force, false, "N") });
}

JointAnchor nearest_anchor(const SoftBodyData &body, BodyId id, Vec2 place) {
	const OutlinePlace border = nearest_place(body.hull(), place);
	Real nearest = border.distance_squared;
	JointAnchor anchor = JointAnchor::on_edge(id, std::uint32_t(border.edge), border.t);
	for (std::uint32_t i = std::uint32_t(body.hull().size()); i < body.point_count(); ++i) {
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

} // namespace softbody
