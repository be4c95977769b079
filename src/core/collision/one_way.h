// SPDX-License-Identifier: MIT
// Colliders that hold from one side only: which contacts count, and which bodies pass.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/collider_contact.h"
#include "core/model/soft_body_data.h"
#include "core/model/surroundings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Name by which a body remembers a one-way collider. It stays valid when the list of colliders is rebuilt.
/// O(vertices).
std::uint64_t one_way_name(const Collider &collider);

/// Depth of a hull, given in the collider's frame, in a one-way collider along its direction [length]. It is the
/// largest depth of a place of the collider's front, moved out by `raised`, inside the hull, or of a hull point inside
/// the collider. 0 if they do not overlap. O(hull points² + hull points × vertices).
Real one_way_depth(std::span<const Vec2> hull, const Collider &collider, Real raised = 0);

/// One body and one one-way collider in one substep. All arguments must outlive it.
class OneWay {
public:
	OneWay(SoftBodyData &body, const Collider &collider, const ColliderMotion &motion, Real length_unit);

	/// Decides whether the body passes, by the hull at the start of the substep and by the body's memory. A body passes
	/// until it is clear of the collider. It is held until it is farther away than the margin. Call it once a substep,
	/// before any collider is solved.
	void begin_substep(std::span<const Vec2> hull_before, std::vector<Vec2> &scratch);
	bool passes() const { return passes_; }
	bool is_held() const { return is_held_; }

	/// Start position of a hull point for the contact test. A point that is no deeper than the margin, or than 4
	/// margins for a held body, counts as coming from the front.
	Vec2 start_of(Vec2 before) const;
	/// Whether a contact counts. It must face the front. At a corner or round end of a collider that does not hold the
	/// body yet, the body must come down on it rather than from the side.
	bool counts(const SurfaceContact &contact, const HullMotion &hull) const;
	/// Marks the body as held, unless the collider is still deep inside it. Call it after the contacts of the substep
	/// if one of them pressed.
	void hold(std::span<const Vec2> hull_now, std::vector<Vec2> &scratch);

private:
	OneWayMemory *memory() const;
	void recall();
	Real depth_of(std::span<const Vec2> hull, const Pose &pose, Real raised, std::vector<Vec2> &scratch) const;

	SoftBodyData &body_;
	const Collider &collider_;
	const ColliderMotion &motion_;
	std::uint64_t name_ = 0;
	Real margin_ = 0;
	bool passes_ = false;
	bool is_held_ = false;
};

/// Whether a body is passing through the collider, by its memory.
bool is_passing(const SoftBodyData &body, const Collider &collider);

} // namespace softbody
