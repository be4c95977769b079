// SPDX-License-Identifier: MIT
// Lets bodies fall asleep, and wakes them when what is around them changes.
#include "core/dynamics/sleep_watch.h"

#include <algorithm>
#include <utility>

namespace softbody {

namespace {

bool is_in(std::span<const Aabb> boxes, const Aabb &box) {
	return std::ranges::any_of(boxes, [&](const Aabb &b) { return b.overlaps(box); });
}

} // namespace

void SleepWatch::take_over(bool is_rearranged) {
	sleepers_.take_over(world_, bodies_.places(), is_rearranged,
			[this](std::uint32_t row, bool awake) { bodies_.note_awake(row, awake); });
}

void SleepWatch::begin_step(bool is_rearranged) {
	if (is_rearranged) {
		sleepers_.reset(bodies_.count());
	}
	take_over(is_rearranged);
	for (std::uint32_t row = 0; is_rearranged && sleepers_.count() > 0 && row < bodies_.count(); ++row) {
		// Who was put to sleep sleeps amid what is there now.
		RestState &rest = bodies_.data(row).rest_state();
		if (rest.asleep && rest.surroundings == 0) {
			rest.surroundings = describe(row);
		}
	}
}

void SleepWatch::wake_by_surroundings() {
	if (world_.has_sleeping()) {
		wake_by_what_changed();
		wake_by_rigid_ends();
	}
	wake_by_frozen_bodies();
}

void SleepWatch::wake_by_what_changed() {
	watch_.update(surroundings_);
	const bool was_restored = std::exchange(seen_restores_, world_.change_counts().restores) != seen_restores_;
	const bool asks_all = was_restored || watch_.has_border_changed();
	if (!asks_all && watch_.changed_boxes().empty()) {
		return;
	}
	for (std::uint32_t row = 0; row < bodies_.count(); ++row) {
		SoftBodyData &body = bodies_.data(row);
		const Aabb box = rest_box(row);
		// Who sleeps goes by what was there when it fell asleep, not in the last step, so that it does not matter how
		// this state came about. Who is awake does not rest beside what moves.
		const bool has_changed = sleepers_[row] && (asks_all || is_in(watch_.changed_boxes(), box)) &&
				describe(row) != body.rest_state().surroundings;
		if (has_changed || is_in(watch_.moving_boxes(), box)) {
			body.wake();
		}
	}
	take_over();
}

// A joint may be longer than what is near, so that nothing has to have changed there.
void SleepWatch::wake_by_rigid_ends() {
	bool has_woken = false;
	for (const std::uint32_t row : joints_.held_to_rigid()) {
		SoftBodyData &body = bodies_.data(row);
		if (body.is_asleep() && describe(row) != body.rest_state().surroundings) {
			body.wake();
			has_woken = true;
		}
	}
	if (has_woken) {
		take_over();
	}
}

// Where one was, is now, or both.
void SleepWatch::wake_by_frozen_bodies() {
	const std::vector<Aabb> boxes = world_.take_disturbed_boxes();
	if (boxes.empty()) {
		return;
	}
	for (std::uint32_t row = 0; row < bodies_.count(); ++row) {
		if (is_in(boxes, rest_box(row))) { // who is awake does not rest either while that changes
			bodies_.data(row).wake();
		}
	}
	take_over();
	for (std::uint32_t row = 0; row < bodies_.count(); ++row) {
		if (bodies_.data(row).is_frozen()) {
			bodies_.note_awake(row, false); // it may lie elsewhere now
		}
	}
}

// What a body rests on touches its box at most.
Aabb SleepWatch::rest_box(std::uint32_t row) const {
	const TouchingBody &body = bodies_.touching(row);
	return (sleepers_[row] ? body.box : bounding_box(body.hull())).grown(body.rolling_radius / 8);
}

void SleepWatch::let_sleep(std::span<const BodyPair> pairs, std::span<const char> touched, std::span<const BodyPair> joined,
		std::span<const char> restless) {
	sleepers_.let_sleep(world_, bodies_.places(), pairs, touched, joined, restless, [this](std::uint32_t row, bool awake) {
		bodies_.note_awake(row, awake);
		bodies_.data(row).rest_state().surroundings = describe(row);
	});
}

} // namespace softbody
