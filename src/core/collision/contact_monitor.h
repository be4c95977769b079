// SPDX-License-Identifier: MIT
// Makes the list of a step's contacts, and tells when touches begin and end.
#pragma once

#include "core/collision/contact_log.h"
#include "core/collision/collider_index.h"
#include "core/model/contact.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Contacts and touches of all bodies that monitor (BodySettings::contact_monitor), each as that body sees it. The lists
/// are sorted by bodies and what they touch, so they do not depend on which thread found what.
///
/// A touch begins with the first contact and ends when there has been none for TOUCH_MEMORY and the two have parted by
/// TOUCH_GAP: a body at rest trembles, and its points touch in some steps and not in others. While both sides sleep a
/// touch lasts. It ends at once when a side is removed or deactivated, when one no longer exists
/// for the other (collision exceptions, ignored tags), or the body no longer monitors. Owns scratch
/// memory, which grows with the contacts.
class ContactMonitor {
public:
	/// Forgets contacts and events of the last step.
	void begin_step();
	/// Whether a touch is under way, which may have to be ended.
	bool has_touches() const { return !touches_.empty(); }
	/// Takes the log into the coming `end_step`, which clears it.
	void add(ContactLog &log) { logs_.push_back(&log); }
	/// Makes the lists after a step of `dt` [s] amid these surroundings. Bodies must still sleep, or not, as they did during the step.
	/// O(n log n) in the number of contacts of bodies that monitor.
	void end_step(const ColliderIndex &surroundings, Real dt);

	/// Sorted by body, other, and place.
	std::span<const Contact> contacts() const { return contacts_; }
	/// Ends, then begins.
	std::span<const ContactEvent> events() const { return events_; }
	/// Sorted by body and other.
	std::span<const Touch> touches() const { return touches_; }

private:
	/// What lists are sorted by: ids, and for surroundings tags, then what tells contacts of one touch apart.
	struct Entry {
		std::uint64_t body = 0;
		std::uint64_t other = 0;
		std::uint64_t part = 0;
		std::uint32_t feature = 0;
		bool is_mirrored = false; ///< seen from the other body of the contact_point
		const ContactPoint *contact_point = nullptr;
	};

	void collect(const WorldData &world);
	void add_contact(const WorldData &world, const Entry &entry);
	void end_lost_touches(const WorldData &world);
	void update_touches(const ColliderIndex &surroundings, Real dt);
	bool has_parted(const ColliderIndex &surroundings, const Touch &touch);

	std::vector<ContactLog *> logs_;
	std::vector<Entry> entries_;
	std::vector<Contact> contacts_;
	std::vector<ContactEvent> events_;
	std::vector<Touch> touches_;
	std::vector<Touch> next_touches_;
	std::vector<ContactEvent> begins_;
	std::vector<std::uint32_t> near_colliders_;
};

} // namespace softbody
