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
	sleepers_.take_over(world_, bodies_.body_indices(), is_rearranged,
			[this](std::uint32_t active_index, bool awake) { bodies_.note_awake(active_index, awake); });
}

void SleepWatch::begin_step(bool is_rearranged) {
	if (is_rearranged) {
		sleepers_.reset(bodies_.count());
	}
	take_over(is_rearranged);
	for (std::uint32_t active_index = 0; is_rearranged && sleepers_.count() > 0 && active_index < bodies_.count(); ++active_index) {
		// Who was put to sleep sleeps amid what is there now.
		RestState &rest = bodies_.data(active_index).rest_state();
		if (rest.asleep && rest.surroundings == 0) {
			rest.surroundings = describe(active_index);
		}
	}
}

void SleepWatch::wake_by_environment() {
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
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		SoftBodyData &body = bodies_.data(active_index);
		const Aabb box = rest_box(active_index);
		// Who sleeps goes by what was there when it fell asleep, not in the last step, so that it does not matter how
		// this state came about. Who is awake does not rest beside what moves.
		const bool has_changed = sleepers_[active_index] && (asks_all || is_in(watch_.changed_boxes(), box)) &&
				describe(active_index) != body.rest_state().surroundings;
		if (has_changed || is_in(watch_.moving_boxes(), box)) {
			body.wake();
		}
	}
	take_over();
}

// A joint may be longer than what is near, so that nothing has to have changed there.
void SleepWatch::wake_by_rigid_ends() {
	bool has_woken = false;
	for (const std::uint32_t active_index : joints_.held_to_rigid()) {
		SoftBodyData &body = bodies_.data(active_index);
		if (body.is_asleep() && describe(active_index) != body.rest_state().surroundings) {
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
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		if (is_in(boxes, rest_box(active_index))) { // who is awake does not rest either while that changes
			bodies_.data(active_index).wake();
		}
	}
	take_over();
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		if (bodies_.data(active_index).is_frozen()) {
			bodies_.note_awake(active_index, false); // it may lie elsewhere now
		}
	}
}

// What a body rests on touches its box at most.
Aabb SleepWatch::rest_box(std::uint32_t active_index) const {
	const SolverBody &body = bodies_.solver_body(active_index);
	return (sleepers_[active_index] ? body.box : bounding_box(body.hull())).grown(body.rolling_radius / 8);
}

void SleepWatch::let_sleep(std::span<const BodyPair> pairs, std::span<const char> touched, std::span<const BodyPair> joined,
		std::span<const char> restless) {
	sleepers_.let_sleep(world_, bodies_.body_indices(), pairs, touched, joined, restless, [this](std::uint32_t active_index, bool awake) {
		bodies_.note_awake(active_index, awake);
		bodies_.data(active_index).rest_state().surroundings = describe(active_index);
	});
}

} // namespace softbody
