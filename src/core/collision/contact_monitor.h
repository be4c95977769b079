// SPDX-License-Identifier: MIT
// Lists the contacts of a step, and reports when touches begin and end.
#pragma once

#include "core/collision/contact_log.h"
#include "core/collision/collider_index.h"
#include "core/model/contact.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Contacts and touches of all monitored bodies (BodySettings::contact_monitor), each from that body's side. The lists
/// are sorted by body and by the other side, so they do not depend on which thread found a contact.
///
/// A touch begins with the first contact. It ends when there has been no contact for TOUCH_MEMORY and the two are apart
/// by TOUCH_GAP: a body at rest trembles, and its points touch in some steps only. A touch lasts while both sides
/// sleep. It ends at once when a side is removed or deactivated, when one side no longer notices the other (collision
/// exceptions, ignored tags), or when the body is no longer monitored. Owns scratch memory, which grows with the
/// contacts.
class ContactMonitor {
public:
	/// Clears the contacts and events of the last step.
	void begin_step();
	/// Whether any touch exists that may have to end.
	bool has_touches() const { return !touches_.empty(); }
	/// Adds a log for the coming `end_step`, which clears it.
	void add(ContactLog &log) { logs_.push_back(&log); }
	/// Makes the lists after a step of `dt` [s] in this environment. Call it before bodies fall asleep or wake. O(n log
	/// n) in the number of contacts of monitored bodies.
	void end_step(const ColliderIndex &surroundings, Real dt);

	/// Contacts of the step, sorted by body, other side and place.
	std::span<const Contact> contacts() const { return contacts_; }
	/// Events of the step: first ends, then beginnings.
	std::span<const ContactEvent> events() const { return events_; }
	/// Present touches, sorted by body and other side.
	std::span<const Touch> touches() const { return touches_; }
	/// Puts earlier touches back, sorted as they were. The contacts and events of the last step are forgotten.
	void put_back(std::vector<Touch> touches) {
		begin_step();
		touches_ = std::move(touches);
	}

private:
	/// Sort key: ids, for the environment tags, then the features that distinguish contacts of one touch.
	struct Entry {
		std::uint64_t body = 0;
		std::uint64_t other = 0;
		std::uint64_t part = 0;
		std::uint32_t feature = 0;
		bool is_mirrored = false; ///< seen from the other body of the contact point
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
