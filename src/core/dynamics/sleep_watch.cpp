// SPDX-License-Identifier: MIT
// Lets islands of bodies at rest fall asleep, and wakes them when their environment changes.
#include "core/dynamics/sleep_watch.h"

#include "core/base/constants.h"
#include "core/base/elementary.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace softbody {

namespace {

bool is_in(std::span<const Aabb> boxes, const Aabb &box) {
	return std::ranges::any_of(boxes, [&](const Aabb &b) { return b.overlaps(box); });
}

} // namespace

void SleepWatch::take_over(bool is_rearranged) {
	std::vector<WokenIsland> woken = world_.take_woken_islands();
	if (!is_rearranged && woken.empty()) {
		return;
	}
	std::ranges::sort(woken);
	for (std::uint32_t i = 0; i < bodies_.count(); ++i) {
		SoftBodyData &body = bodies_.data(i);
		RestState &rest = body.rest_state();
		if (rest.asleep && (!world_.has_sleeping() || std::ranges::binary_search(woken, WokenIsland{ rest.island, rest.restored }))) {
			body.wake();
		}
		rest.restored = 0;
		const bool rests = body.is_asleep() || body.is_frozen();
		if (rests != bodies_.is_resting(i)) {
			bodies_.set_resting(i, rests);
		}
	}
	world_.take_woken_islands(); // discards entries that this function has added
}

void SleepWatch::begin_step(bool is_rearranged) {
	take_over(is_rearranged);
	for (std::uint32_t i = 0; is_rearranged && bodies_.resting_count() > 0 && i < bodies_.count(); ++i) {
		// A body put to sleep from outside is compared with the environment of this moment.
		SoftBodyData &body = bodies_.data(i);
		RestState &rest = body.rest_state();
		if (rest.asleep && rest.surroundings == 0) {
			rest.surroundings = describe(i);
		}
		if (rest.asleep && body.fluids() == ANY_FLUIDS) {
			body.set_fluids(0); // nobody has named any
		}
	}
}

void SleepWatch::wake_by_environment() {
	if (world_.has_sleeping()) {
		wake_by_changes();
		wake_by_rigid_ends();
	}
	wake_by_frozen_bodies();
}

void SleepWatch::wake_by_changes() {
	watch_.update(surroundings_);
	const bool was_restored = std::exchange(seen_restores_, world_.change_counts().restores) != seen_restores_;
	const bool asks_all = was_restored || watch_.has_border_changed();
	if (!asks_all && watch_.changed_boxes().empty()) {
		return;
	}
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		SoftBodyData &body = bodies_.data(active_index);
		const Aabb box = rest_box(active_index);
		// A sleeping body is compared with the environment in which it fell asleep, not with that of the last step. So
		// the result depends only on the state. An awake body does not come to rest beside a moving collider.
		const bool has_changed = bodies_.is_resting(active_index) && (asks_all || is_in(watch_.changed_boxes(), box)) &&
				describe(active_index) != body.rest_state().surroundings;
		if (has_changed || is_in(watch_.moving_boxes(), box)) {
			body.wake();
		}
	}
	take_over();
}

// A joint may reach farther than the rest box, so the environment near the body need not have changed.
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

// The boxes are where a frozen body was, is now, or both.
void SleepWatch::wake_by_frozen_bodies() {
	const std::vector<Aabb> boxes = world_.take_disturbed_boxes();
	if (boxes.empty()) {
		return;
	}
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		if (is_in(boxes, rest_box(active_index))) { // an awake body does not come to rest beside a change either
			bodies_.data(active_index).wake();
		}
	}
	take_over();
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		if (bodies_.data(active_index).is_frozen()) {
			bodies_.set_resting(active_index, true); // updates the extent, as the body may have moved
		}
	}
}

// A neighbor that the body rests on may only touch the body's own box, so the box is grown.
Aabb SleepWatch::rest_box(std::uint32_t active_index) const {
	const SolverBody &body = bodies_.solver_body(active_index);
	return (bodies_.is_resting(active_index) ? body.box : bounding_box(body.hull())).grown(body.rest_radius / 8);
}

void SleepWatch::join(BodyPair pair) {
	const auto [a, b] = pair;
	const auto is_frozen = [&](std::uint32_t i) { return bodies_.is_resting(i) && bodies_.data(i).is_frozen(); };
	if (is_frozen(a) || is_frozen(b)) {
		return; // bodies that rest on one frozen body are no island
	}
	if (bodies_.is_resting(a) != bodies_.is_resting(b)) {
		bodies_.data(bodies_.is_resting(a) ? a : b).wake();
	}
	islands_.join(a, b);
}

// The constant acceleration that has moved a body from where it became drowsy to where it is. Its velocity decays
// within d, so that in a time t it goes v0 d s + a d (t - d s), where s = 1 - exp(-t/d). None along its weight, or across
// it, if its velocity there is another than such an acceleration leaves: then it wobbles. A body that bounces up and down
// may yet be pulled aside.
Vec2 SleepWatch::pull_on(std::uint32_t active_index) const {
	SoftBodyData &body = bodies_.data(active_index);
	const RestState &rest = body.rest_state();
	const Real time = rest.rest_time - DROWSY_TIME;
	const Real share = 1 - Real(exponential(double(-time / DROWSY_DECAY)));
	const Real coasted = DROWSY_DECAY * share;
	const Real gained = DROWSY_DECAY * (time - coasted);
	const BodyFrame frame = measure_frame(body);
	const Vec2 pull = (frame.center - rest.drowsy_center - rest.drowsy_velocity * coasted) * (1 / gained);
	const Vec2 left = rest.drowsy_velocity * (1 - share);
	const Vec2 faster = pull * coasted;
	const Vec2 other = frame.velocity - left - faster;
	const Vec2 weight = body.total_acceleration(world_.gravity());
	const Real heavy = length(weight);
	if (!(heavy > 0)) {
		return length(other) <= length(faster) / 2 ? pull : Vec2{};
	}
	Vec2 steady;
	for (const Vec2 axis : { weight * (1 / heavy), perpendicular(weight * (1 / heavy)) }) {
		if (std::abs(dot(other, axis)) <= std::abs(dot(faster, axis)) / 2) {
			steady += axis * dot(pull, axis);
		}
	}
	return steady;
}

// Whether an island is about to move. A pile sinks while it settles, so a larger bound counts for it along the weight.
bool SleepWatch::is_pulled(std::uint32_t island) const {
	const Real scale = masses_[island] * world_.length_unit();
	const Vec2 weight = world_.gravity();
	const Real across = weight != Vec2{} ? std::abs(cross(pulls_[island], weight * (1 / length(weight)))) : Real(0);
	return across > FREE_PULL * scale || length(pulls_[island]) > (bodies_in_[island] == 1 ? FREE_PULL : FREE_PULL_OF_MANY) * scale;
}

// Keeps the islands awake that are pulled as a whole. Their bodies get the velocity that they would have without
// drowsiness.
void SleepWatch::release_pulled() {
	pulls_.assign(bodies_.count(), {});
	masses_.assign(bodies_.count(), 0);
	bodies_in_.assign(bodies_.count(), 0);
	for (const std::uint32_t i : bodies_.awake()) {
		const std::uint32_t island = islands_.find(i);
		const bool is_held = bodies_.data(i).has_pins() || joints_.holds(i);
		if (least_rest_[island] >= SLEEP_TIME && !is_held) {
			const Real mass = bodies_.data(i).shape().total_mass();
			pulls_[island] += pull_on(i) * mass;
			masses_[island] += mass;
			++bodies_in_[island];
		}
	}
	for (const std::uint32_t i : bodies_.awake()) {
		const std::uint32_t island = islands_.find(i);
		RestState &rest = bodies_.data(i).rest_state();
		if (least_rest_[island] < SLEEP_TIME || !is_pulled(island)) {
			continue;
		}
		// What a fluid bears bobs about a place, and would be driven on by the speed that drowsiness has taken.
		if (bodies_.data(i).is_free() && bodies_.data(i).fluids() == 0) {
			const Vec2 velocity = rest.drowsy_velocity + pull_on(i) * (rest.rest_time - DROWSY_TIME);
			const Vec2 missing = velocity - measure_frame(bodies_.data(i)).velocity;
			for (Vec2 &v : bodies_.data(i).mutable_velocities()) {
				v += missing;
			}
		}
		rest.rest_time = 0;
	}
	for (const std::uint32_t i : bodies_.awake()) {
		Real &least = least_rest_[islands_.find(i)];
		least = std::min(least, bodies_.data(i).rest_time());
	}
}

void SleepWatch::let_sleep(std::span<const BodyPair> pairs, std::span<const char> touched, std::span<const BodyPair> joined,
		std::span<const char> restless) {
	if (bodies_.awake().empty()) {
		return;
	}
	islands_.reset(bodies_.count());
	for (std::size_t i = 0; i < pairs.size(); ++i) {
		if (touched[i]) {
			join(pairs[i]);
		}
	}
	for (const BodyPair pair : joined) {
		join(pair);
	}
	least_rest_.assign(bodies_.count(), std::numeric_limits<Real>::max());
	bool any_may_sleep = false;
	for (const std::uint32_t i : bodies_.awake()) {
		const SoftBodyData &body = bodies_.data(i);
		Real &least = least_rest_[islands_.find(i)];
		const bool may_sleep = body.settings().can_sleep && (restless.empty() || !restless[i]);
		least = std::min(least, may_sleep ? body.rest_time() : Real(0));
		any_may_sleep |= may_sleep && body.rest_time() >= SLEEP_TIME;
	}
	if (!any_may_sleep) {
		return;
	}
	release_pulled();
	names_.assign(bodies_.count(), 0);
	for (std::uint32_t i = 0; i < bodies_.count(); ++i) {
		const std::uint32_t island = islands_.find(i);
		if (bodies_.is_resting(i) || least_rest_[island] < SLEEP_TIME) {
			continue;
		}
		// An island is named after its first body, which is part of no other sleeping island. So the name does not
		// depend on the past.
		if (names_[island] == 0) {
			names_[island] = world_.id_at(bodies_.body_indices()[i]).index + std::uint64_t(1);
		}
		bodies_.set_resting(i, true);
		RestState &rest = bodies_.data(i).rest_state();
		rest.asleep = true;
		rest.island = names_[island];
		rest.surroundings = describe(i);
	}
}

} // namespace softbody
