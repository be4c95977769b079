// SPDX-License-Identifier: MIT
// Records the contacts of a step, one for each place however many substeps find it.
#pragma once

#include "core/model/contact.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// A contact as the contact solvers record it. Bodies are indices into `WorldData::soft_bodies()`.
struct ContactPoint {
	/// Flag in `feature`: the feature is a corner of the collider, not a hull point of the body.
	static constexpr std::uint32_t CORNER = 1u << 31;
	/// Value of `feature` for a contact of the bodies as wholes.
	static constexpr std::uint32_t WHOLE = CORNER - 1;

	std::uint32_t body = 0;
	ContactOther::Kind kind = ContactOther::Kind::SOFT_BODY;
	std::uint32_t other = 0; ///< soft body, border or collider
	std::uint32_t feature = 0; ///< hull point of `body` inside the other, or CORNER plus a corner of the collider
	std::uint32_t hull_point = 0; ///< nearest hull point of `body`
	std::uint32_t other_hull_point = 0; ///< nearest hull point of the other, if that is a soft body
	Vec2 point = {};
	Vec2 normal = {}; ///< unit, out of the other
	Real normal_impulse = 0;
	Real depth = 0;
};

/// Keeps contact points in the order in which their places were first recorded. A place recorded again adds its impulse
/// and replaces the other values. One object serves one thread. It owns scratch memory, which grows to the busiest
/// step.
class ContactLog {
public:
	/// Records a contact point. O(1) expected.
	void add(const ContactPoint &contact_point);
	std::span<const ContactPoint> contact_points() const { return contact_points_; }
	/// Removes all contact points. O(1) if nothing was added.
	void clear();

private:
	std::size_t slot_of(const ContactPoint &contact_point) const;
	void grow();

	std::vector<ContactPoint> contact_points_;
	std::vector<std::uint32_t> slots_; ///< hash table: index in `contact_points_` plus 1, 0 when free
};

} // namespace softbody
