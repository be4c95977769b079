// SPDX-License-Identifier: MIT
// Colliders that hold from one side only: which contacts count, and who passes.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/collider_contact.h"
#include "core/model/soft_body_data.h"
#include "core/model/surroundings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// By what a body remembers a one-way collider, however often the list of colliders is made anew. O(vertices).
std::uint64_t one_way_name(const Collider &collider);

/// How deep a hull, given in the collider's frame, is in a one-way collider, along its direction [length]: the most that a
/// place of its front, moved out by `raised`, is inside the hull, or a hull point inside the collider. 0 where they do not
/// overlap. O(hull points² + hull points × vertices).
Real one_way_depth(std::span<const Vec2> hull, const Collider &collider, Real raised = 0);

/// One body and one collider that holds from one side, in one substep. All must outlive it.
class OneWay {
public:
	OneWay(SoftBodyData &body, const Collider &collider, const ColliderMotion &motion, Real length_unit);

	/// Once a substep, before any collider is solved: decides by where the hull is when the substep begins, and by what
	/// the body remembers. It passes until it is clear, and is held until it is farther away than the margin.
	void begin_substep(std::span<const Vec2> hull_before, std::vector<Vec2> &scratch);
	bool passes() const { return passes_; }
	bool is_held() const { return is_held_; }

	/// Where a hull point came from: what has sunk in by no more than the margin (or, of a body that is held, at all) counts
	/// as come from the front.
	Vec2 start_of(Vec2 before) const;
	/// Whether a contact counts: it faces the front, and at a corner or round end of a collider by which the body is not
	/// held yet, the body comes down on it rather than from the side.
	bool counts(const SurfaceContact &contact, const HullMotion &hull) const;
	/// After the contacts of the substep, if one of them pressed: the body is held, unless the collider is deep inside it all
	/// the same.
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

/// Whether a body is on its way through the collider, as it remembers.
bool is_passing(const SoftBodyData &body, const Collider &collider);

} // namespace softbody
