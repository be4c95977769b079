// SPDX-License-Identifier: MIT
// Lists the contacts of a step, and reports when touches begin and end.
#include "core/collision/contact_monitor.h"

#include "core/base/constants.h"
#include "core/collision/distance_query.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace softbody {

namespace {

using OtherKind = ContactOther::Kind;

const Surface &surface_of(const WorldData &world, OtherKind kind, std::uint32_t index) {
	return kind == OtherKind::BORDER ? world.borders()[index].surface : world.colliders()[index].surface;
}

/// Sort key of touches. Of two bodies that used one slot, only one is alive.
using TouchName = std::pair<std::uint64_t, std::uint64_t>;

std::uint64_t body_name(BodyId body, bool is_other_soft) {
	return std::uint64_t(body.index) << 1 | std::uint64_t(!is_other_soft);
}

template <class Touching>
TouchName name_of(const Touching &touch) {
	const bool is_soft = touch.other.kind == OtherKind::SOFT_BODY;
	return { body_name(touch.body, is_soft), is_soft ? std::uint64_t(touch.other.body.index) : touch.other.tag };
}

bool is_there(const SoftBodyData *body) {
	return body != nullptr && body->is_active();
}

bool lies_still(const SoftBodyData &body) {
	return body.is_asleep() || body.is_frozen();
}

// Whether neither side was stepped, so that no contact could be found.
bool is_resting(const WorldData &world, const Touch &touch) {
	return lies_still(*world.find(touch.body)) &&
			(touch.other.kind != OtherKind::SOFT_BODY || lies_still(*world.find(touch.other.body)));
}

} // namespace

void ContactMonitor::begin_step() {
	contacts_.clear();
	events_.clear();
}

void ContactMonitor::end_step(const ColliderIndex &surroundings, Real dt) {
	const WorldData &world = surroundings.world();
	collect(world);
	begins_.clear();
	end_lost_touches(world);
	update_touches(surroundings, dt);
	events_.insert(events_.end(), begins_.begin(), begins_.end());
	for (ContactLog *log : logs_) {
		log->clear();
	}
	logs_.clear();
}

void ContactMonitor::collect(const WorldData &world) {
	entries_.clear();
	const std::span<const SoftBodyData> bodies = world.soft_bodies();
	for (const ContactLog *log : logs_) {
		for (const ContactPoint &seen : log->contact_points()) {
			if (!is_finite(seen.point) || !is_finite(seen.normal) || !std::isfinite(seen.normal_impulse) || !std::isfinite(seen.depth)) {
				continue; // the body has been reset
			}
			const BodyId body = world.id_at(seen.body);
			if (seen.kind != OtherKind::SOFT_BODY) {
				const std::uint64_t tag = surface_of(world, seen.kind, seen.other).tag;
				const std::uint64_t part = std::uint64_t(seen.kind) << 32 | seen.other;
				entries_.push_back({ body_name(body, false), tag, part, seen.feature, false, &seen });
				continue;
			}
			const BodyId other = world.id_at(seen.other);
			if (bodies[seen.body].settings().contact_monitor) {
				entries_.push_back({ body_name(body, true), other.index, 0, seen.feature, false, &seen });
			}
			if (bodies[seen.other].settings().contact_monitor) {
				entries_.push_back({ body_name(other, true), body.index, 0, seen.feature, true, &seen });
			}
		}
	}
	std::ranges::sort(entries_, {}, [](const Entry &entry) {
		return std::tuple(entry.body, entry.other, entry.part, entry.feature, entry.is_mirrored);
	});
	for (const Entry &entry : entries_) {
		add_contact(world, entry);
	}
}

void ContactMonitor::add_contact(const WorldData &world, const Entry &entry) {
	const ContactPoint &seen = *entry.contact_point;
	Contact &contact = contacts_.emplace_back();
	contact.body = world.id_at(entry.is_mirrored ? seen.other : seen.body);
	contact.hull_point = entry.is_mirrored ? seen.other_hull_point : seen.hull_point;
	contact.point = seen.point;
	contact.normal = entry.is_mirrored ? -seen.normal : seen.normal;
	contact.normal_impulse = seen.normal_impulse;
	contact.depth = seen.depth;
	contact.other.kind = seen.kind;
	if (seen.kind == OtherKind::SOFT_BODY) {
		contact.other.body = world.id_at(entry.is_mirrored ? seen.body : seen.other);
		return;
	}
	contact.other.index = seen.other;
	contact.other.tag = surface_of(world, seen.kind, seen.other).tag;
	if (seen.kind == OtherKind::COLLIDER) {
		contact.other.rigid_body = world.colliders()[seen.other].rigid_body;
	}
}

void ContactMonitor::end_lost_touches(const WorldData &world) {
	std::erase_if(touches_, [&](const Touch &touch) {
		const SoftBodyData *body = world.find(touch.body);
		const bool is_other_there =
				touch.other.kind != OtherKind::SOFT_BODY || is_there(world.find(touch.other.body));
		const bool is_ignored = touch.other.kind == OtherKind::SOFT_BODY
				? world.has_collision_exception(touch.body, touch.other.body)
				: body != nullptr && body->ignores_tag(touch.other.tag);
		if (is_there(body) && body->settings().contact_monitor && is_other_there && !is_ignored) {
			return false;
		}
		events_.push_back({ ContactEvent::Kind::END, touch.body, touch.other });
		return true;
	});
}

bool ContactMonitor::has_parted(const ColliderIndex &surroundings, const Touch &touch) {
	const SoftBodyData &body = *surroundings.world().find(touch.body);
	const Real gap = TOUCH_GAP * body.shape().radius();
	if (touch.other.kind != OtherKind::SOFT_BODY) {
		return !is_near_tag(surroundings, body, touch.other.tag, gap, near_colliders_);
	}
	const SoftBodyData &other = *surroundings.world().find(touch.other.body);
	return !are_near(body, other, std::min(gap, TOUCH_GAP * other.shape().radius()));
}

// Merges the sorted contacts and touches. A contact without a touch begins one. A touch without a contact may end.
void ContactMonitor::update_touches(const ColliderIndex &surroundings, Real dt) {
	next_touches_.clear();
	std::size_t known = 0;
	const auto pass_over_touch = [&] {
		Touch touch = touches_[known++];
		touch.apart += is_resting(surroundings.world(), touch) ? Real(0) : dt;
		if (touch.apart > TOUCH_MEMORY && has_parted(surroundings, touch)) {
			events_.push_back({ ContactEvent::Kind::END, touch.body, touch.other });
		} else {
			next_touches_.push_back(touch);
		}
	};
	for (std::size_t i = 0; i < contacts_.size(); ++i) {
		const TouchName name = name_of(contacts_[i]);
		if (i > 0 && name == name_of(contacts_[i - 1])) {
			continue;
		}
		while (known < touches_.size() && name_of(touches_[known]) < name) {
			pass_over_touch();
		}
		Touch touch{ contacts_[i].body, contacts_[i].other, 0 };
		touch.other.index = UINT32_MAX;
		touch.other.rigid_body = NO_RIGID_BODY;
		next_touches_.push_back(touch);
		if (known < touches_.size() && name_of(touches_[known]) == name) {
			++known;
		} else {
			begins_.push_back({ ContactEvent::Kind::BEGIN, touch.body, touch.other });
		}
	}
	while (known < touches_.size()) {
		pass_over_touch();
	}
	std::swap(touches_, next_touches_);
}

} // namespace softbody
