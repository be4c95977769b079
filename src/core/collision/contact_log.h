// SPDX-License-Identifier: MIT
// Notes of the contacts that are found during a step, one for each place however many substeps find it.
#pragma once

#include "core/model/contact.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// A contact as those who solve contacts know it: bodies are indices into `WorldData::soft_bodies()`.
struct ContactPoint {
	/// Set in `feature` when it counts the corners of a collider instead of the body's hull points.
	static constexpr std::uint32_t CORNER = 1u << 31;
	/// As a `feature`: the bodies as wholes.
	static constexpr std::uint32_t WHOLE = CORNER - 1;

	std::uint32_t body = 0;
	ContactOther::Kind kind = ContactOther::Kind::SOFT_BODY;
	std::uint32_t other = 0; ///< soft body, border or collider
	std::uint32_t feature = 0; ///< hull point of `body` that is in the other, or CORNER plus a corner of the collider
	std::uint32_t hull_point = 0; ///< of `body`, the nearest
	std::uint32_t other_hull_point = 0; ///< likewise, if the other is a soft body
	Vec2 point = {};
	Vec2 normal = {}; ///< unit, out of the other
	Real normal_impulse = 0;
	Real depth = 0;
};

/// Keeps contact_points in the order in which their places were first seen; a place that is seen again adds its impulse and
/// replaces the rest. One object serves one thread. It owns scratch memory, which grows to the busiest step.
class ContactLog {
public:
	/// O(1) expected.
	void add(const ContactPoint &contact_point);
	std::span<const ContactPoint> contact_points() const { return contact_points_; }
	/// O(1) if nothing was added.
	void clear();

private:
	std::size_t slot_of(const ContactPoint &contact_point) const;
	void grow();

	std::vector<ContactPoint> contact_points_;
	std::vector<std::uint32_t> slots_; ///< hash table: place in `contact_points_` plus 1, 0 when free
};

} // namespace softbody
