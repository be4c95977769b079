// SPDX-License-Identifier: MIT
// Joints of a soft body with another one, a place in the world, or a rigid body.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/id_list.h"

#include <cstdint>
#include <limits>

namespace softbody {

class SoftBodyData;

/// The id of a joint.
using JointId = Id<struct Joint>;

/// One end of a joint.
struct JointAnchor {
	enum class Kind : std::uint8_t {
		WORLD,
		SOFT_BODY,
		RIGID_BODY,
	};
	Kind kind = Kind::WORLD;
	BodyId body; ///< the soft body
	/// On a soft body: any of its points; or, where `fraction` is not 0, the hull point at which the edge begins.
	std::uint32_t point = 0;
	Real fraction = 0; ///< of the way along that edge to the next hull point [1], 0..1
	Vec2 position; ///< in the world, or in the frame of the rigid body [length]
	std::uint64_t tag = 0; ///< of the rigid body (RigidBody::tag), not 0

	static JointAnchor at_place(Vec2 position) { return { Kind::WORLD, {}, 0, 0, position, 0 }; }
	static JointAnchor on_point(BodyId body, std::uint32_t point) { return { Kind::SOFT_BODY, body, point, 0, {}, 0 }; }
	static JointAnchor on_edge(BodyId body, std::uint32_t edge, Real fraction) {
		return { Kind::SOFT_BODY, body, edge, fraction, {}, 0 };
	}
	static JointAnchor on_rigid_body(std::uint64_t tag, Vec2 position) {
		return { Kind::RIGID_BODY, {}, 0, 0, position, tag };
	}
	bool is_soft() const { return kind == Kind::SOFT_BODY; }

	friend bool operator==(const JointAnchor &, const JointAnchor &) = default;
};

/// Keeps two anchors at a distance, or in one place. At least one anchor is on a soft body, and both are not on the
/// same body. A joint to a rigid body that is not in the environment stays, and does nothing in that step. Joined
/// bodies fall asleep and wake together.
struct Joint {
	JointAnchor first;
	JointAnchor second;
	/// Distance that the joint keeps [length], >= 0. 0: the anchors share one place, about which both may turn.
	Real rest_length = 0;
	/// Stiffness of the joint as a spring [force/length], >= 0. Infinite, the default: rigid.
	Real stiffness = std::numeric_limits<Real>::infinity();
	/// Damping of the speed along the line between the anchors [force·s/length], >= 0; a rigid joint needs none.
	Real damping = 0;
	/// Force, averaged over a step, beyond which the joint breaks [force], > 0: it is listed in
	/// StepReport::broken_joints and removed. Infinite, the default: never. A blow counts more the shorter the step is.
	Real break_force = std::numeric_limits<Real>::infinity();
	/// Whether two soft bodies that it joins still collide with each other.
	bool collide_joined = false;

	friend bool operator==(const Joint &, const Joint &) = default;
};

/// Refuses, by name, values outside their range, non-finite anchors, two anchors of which none is on a soft body or
/// both are on one body, and an anchor on a rigid body without a tag. Does not check that the bodies exist.
Status check_joint(const Joint &joint);

/// The place on a body that is nearest to `place`: on an edge of its hull, or one of its inner points. O(points).
JointAnchor nearest_anchor(const SoftBodyData &body, BodyId id, Vec2 place);
/// Where an anchor on this body is now. Precondition: its point is one of the body's.
Vec2 position_of(const JointAnchor &anchor, const SoftBodyData &body);

} // namespace softbody
