// SPDX-License-Identifier: MIT
// Creation and checked changes of a soft body's state.
#include "core/model/soft_body_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace softbody {

namespace {

Status check_pose(const Pose &pose) {
	if (is_finite(pose.position) && std::isfinite(pose.rotation.c) && std::isfinite(pose.rotation.s)) {
		return {};
	}
	return Error{ "pose", "non-finite", "must be finite", "check the computation that produced this value" };
}

} // namespace

Result<SoftBodyData> SoftBodyData::create(std::shared_ptr<const SoftBodyShape> shape, const BodySettings &settings,
		const Pose &pose) {
	if (!shape) {
		return Error{ "shape", "null", "must be a shape", "create one with SoftBodyCreator" };
	}
	if (Status status = check_settings(settings)) {
		return *status;
	}
	if (Status status = check_pose(pose)) {
		return *status;
	}
	SoftBodyData body;
	body.settings_ = settings;
	const std::size_t count = shape->point_count();
	body.previous_positions_.reserve(count);
	for (const Vec2 rest : shape->rest_positions()) {
		body.previous_positions_.push_back(pose.apply(rest + shape->origin_offset()));
	}
	body.state_.assign(2 * count + 1, Vec2{});
	std::ranges::copy(body.previous_positions_, body.state_.begin());
	body.set_rotation_memory(pose.rotation);
	body.shape_ = std::move(shape);
	return body;
}

void SoftBodyData::wake() {
	if (frozen_) {
		return; // a frozen body does not sleep, and its contacts are no reason to wake
	}
	if (rest_state_.asleep && changes_) {
		changes_->woken_islands.push_back({ rest_state_.island, rest_state_.restored });
	}
	rest_state_.asleep = false;
	rest_state_.rest_time = 0;
}

void SoftBodyData::disturb() {
	wake();
	if (frozen_ && changes_) {
		changes_->disturbed_boxes.push_back(bounding_box(hull())); // bodies that rest on it share no island with it
	}
}

void SoftBodyData::put_to_sleep() {
	// The step counts its islands from 1.
	constexpr std::uint64_t NOT_OF_A_STEP = std::uint64_t(1) << 63;
	if (frozen_) {
		return;
	}
	std::ranges::fill(mutable_velocities(), Vec2{});
	clear_external_forces();
	note_change(); // the step determines sleeping bodies anew
	rest_state_ = { 0, true, NOT_OF_A_STEP | (changes_ ? ++changes_->put_to_sleep : 0) };
}

void SoftBodyData::note_change() {
	last_valid_hull_.clear();
	disturb();
	if (changes_) {
		++changes_->arrangement;
	}
}

void SoftBodyData::set_frozen(bool frozen) {
	if (frozen == frozen_) {
		return;
	}
	note_change();
	frozen_ = frozen;
	disturb();
	frozen_inverse_masses_.assign(frozen ? point_count() : 0, Real(0));
	std::ranges::fill(mutable_velocities(), Vec2{});
	touch_memory_ = {};
	clear_external_forces();
	clear_pin_targets();
}

void SoftBodyData::set_active(bool active) {
	if (active != active_) {
		active_ = active;
		note_change();
	}
}

void SoftBodyData::set_ignored_tags(std::span<const std::uint64_t> tags) {
	std::vector<std::uint64_t> wanted(tags.begin(), tags.end());
	std::ranges::sort(wanted);
	wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
	std::erase(wanted, 0u);
	if (wanted != ignored_tags_) {
		ignored_tags_ = std::move(wanted);
		note_change();
	}
}

bool SoftBodyData::ignores_tag(std::uint64_t tag) const {
	return !ignored_tags_.empty() && std::ranges::binary_search(ignored_tags_, tag);
}

Status SoftBodyData::set_settings(const BodySettings &settings) {
	if (Status status = check_settings(settings)) {
		return status;
	}
	settings_ = settings;
	note_change();
	return {};
}

Status SoftBodyData::set_shape(std::shared_ptr<const SoftBodyShape> shape) {
	if (!shape || shape->point_count() != point_count() || shape->hull_count() != shape_->hull_count()) {
		return Error{ "shape", shape ? std::to_string(shape->point_count()) + " points" : "null",
			"must have the body's " + std::to_string(point_count()) + " points and " +
					std::to_string(shape_->hull_count()) + " hull points",
			"remove the body and create another" };
	}
	for (std::size_t i = 0; i < pinned_inverse_masses_.size(); ++i) {
		if (pinned_inverse_masses_[i] != 0) {
			pinned_inverse_masses_[i] = shape->inverse_masses()[i];
		}
	}
	shape_ = std::move(shape);
	note_change();
	return {};
}

Point2D SoftBodyData::point(std::size_t index) const {
	Point2D point{ positions()[index], velocities()[index], {}, shape_->masses()[index], inverse_masses()[index] };
	for (const ExternalForce &external : external_forces_) {
		if (external.point == index) {
			point.force += external.force;
		}
	}
	return point;
}

Status SoftBodyData::check_point(std::uint32_t point, const char *what, Vec2 value) const {
	if (point >= point_count()) {
		return Error{ "point", std::to_string(point), "must be below " + std::to_string(point_count()),
			"use an index of an existing point" };
	}
	if (!is_finite(value)) {
		return Error{ what, "(" + number_text(value.x) + ", " + number_text(value.y) + ")", "must be finite",
			"check the computation that produced this value" };
	}
	return {};
}

Status SoftBodyData::add_external_force(std::uint32_t point, Vec2 force) {
	if (Status status = check_point(point, "force", force)) {
		return status;
	}
	if (frozen_) {
		return {};
	}
	wake();
	external_forces_.push_back({ point, force });
	if (changes_) {
		++changes_->forces;
	}
	return {};
}

Status SoftBodyData::set_acceleration(Vec2 acceleration) {
	if (Status status = check_point(0, "acceleration", acceleration)) {
		return status;
	}
	if (acceleration != acceleration_) {
		acceleration_ = acceleration;
		wake();
		if (changes_) {
			++changes_->forces;
		}
	}
	return {};
}

Vec2 SoftBodyData::total_acceleration(Vec2 gravity) const {
	const Vec2 falling = gravity * settings_.gravity_scale;
	if (acceleration_ == Vec2{}) {
		return falling;
	}
	const Vec2 total = falling + acceleration_;
	const Real rounding = 4 * std::numeric_limits<Real>::epsilon();
	return length_squared(total) > rounding * rounding * length_squared(falling) ? total : Vec2{};
}

void SoftBodyData::queue_load(const RigidLoad &load) {
	if (is_frozen()) {
		return;
	}
	wake();
	load_.force += load.force;
	load_.torque += load.torque;
	if (changes_) {
		++changes_->forces;
	}
}

Status SoftBodyData::apply_impulse(std::uint32_t point, Vec2 impulse) {
	if (Status status = check_point(point, "impulse", impulse)) {
		return status;
	}
	if (frozen_) {
		return {};
	}
	wake();
	mutable_velocities()[point] += impulse * inverse_masses()[point];
	return {};
}

Status SoftBodyData::set_point(std::uint32_t point, Vec2 position, Vec2 velocity) {
	if (Status status = check_point(point, "position", position)) {
		return status;
	}
	if (Status status = check_point(point, "velocity", velocity)) {
		return status;
	}
	disturb();
	last_valid_hull_.clear();
	one_ways_.clear();
	mutable_positions()[point] = position;
	mutable_velocities()[point] = frozen_ ? Vec2{} : velocity;
	disturb();
	return {};
}

Status SoftBodyData::set_pinned(std::uint32_t point, bool pinned) {
	if (Status status = check_point(point, "position", {})) {
		return status;
	}
	if (pinned && !has_pins()) {
		pinned_inverse_masses_.assign(shape_->inverse_masses().begin(), shape_->inverse_masses().end());
	}
	std::erase_if(pin_targets_, [point](const PinTarget &target) { return target.point == point; });
	if (pinned) {
		pinned_inverse_masses_[point] = 0;
		mutable_velocities()[point] = {};
	} else if (has_pins()) {
		pinned_inverse_masses_[point] = shape_->inverse_masses()[point];
		if (std::ranges::find(pinned_inverse_masses_, Real(0)) == pinned_inverse_masses_.end()) {
			pinned_inverse_masses_.clear();
		}
	}
	note_change();
	return {};
}

Status SoftBodyData::set_pin_target(std::uint32_t point, Vec2 position) {
	if (Status status = check_point(point, "position", position)) {
		return status;
	}
	if (!is_pinned(point)) {
		return Error{ "point", std::to_string(point), "must be pinned", "pin it with set_pinned first" };
	}
	if (frozen_) {
		return {};
	}
	std::erase_if(pin_targets_, [point](const PinTarget &target) { return target.point == point; });
	if (position == positions()[point]) {
		return {};
	}
	wake();
	pin_targets_.push_back({ point, position });
	if (changes_) {
		++changes_->pin_targets;
	}
	return {};
}

Status SoftBodyData::teleport(const Pose &reference, const Pose &pose) {
	for (const Pose &each : { reference, pose }) {
		if (Status status = check_pose(each)) {
			return status;
		}
	}
	disturb();
	for (const std::span<Vec2> points : { mutable_positions(), mutable_previous_positions() }) {
		for (Vec2 &p : points) {
			p = pose.apply(reference.apply_inverse(p));
		}
	}
	disturb();
	last_valid_hull_.clear();
	touch_memory_ = {};
	one_ways_.clear();
	const Rotation from = reference.rotation;
	const Rotation to = pose.rotation;
	const Rotation turn{ to.c * from.c + to.s * from.s, to.s * from.c - to.c * from.s };
	const Rotation memory = rotation_memory();
	set_rotation_memory({ turn.c * memory.c - turn.s * memory.s, turn.s * memory.c + turn.c * memory.s });
	return {};
}

} // namespace softbody
