// SPDX-License-Identifier: MIT
// Creation and checked changes of a soft body's state.
#include "core/model/soft_body_data.h"

#include <cmath>
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
	body.positions_.reserve(count);
	body.inverse_masses_.reserve(count);
	for (std::size_t i = 0; i < count; ++i) {
		body.positions_.push_back(pose.apply(shape->rest_positions()[i] + shape->origin_offset()));
		body.inverse_masses_.push_back(1 / shape->masses()[i]);
	}
	body.previous_positions_ = body.positions_;
	body.velocities_.assign(count, Vec2{});
	body.rotation_memory_ = pose.rotation;
	body.shape_ = std::move(shape);
	return body;
}

void SoftBodyData::note_change() {
	if (changes_) {
		++*changes_;
	}
}

void SoftBodyData::set_active(bool active) {
	if (active != active_) {
		active_ = active;
		note_change();
	}
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
	for (std::size_t i = 0; i < inverse_masses_.size(); ++i) {
		if (inverse_masses_[i] != 0) {
			inverse_masses_[i] = 1 / shape->masses()[i];
		}
	}
	shape_ = std::move(shape);
	note_change();
	return {};
}

Point2D SoftBodyData::point(std::size_t index) const {
	Point2D point{ positions_[index], velocities_[index], {}, shape_->masses()[index], inverse_masses_[index] };
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
	external_forces_.push_back({ point, force });
	return {};
}

Status SoftBodyData::apply_impulse(std::uint32_t point, Vec2 impulse) {
	if (Status status = check_point(point, "impulse", impulse)) {
		return status;
	}
	velocities_[point] += impulse * inverse_masses_[point];
	return {};
}

Status SoftBodyData::set_point(std::uint32_t point, Vec2 position, Vec2 velocity) {
	if (Status status = check_point(point, "position", position)) {
		return status;
	}
	if (Status status = check_point(point, "velocity", velocity)) {
		return status;
	}
	positions_[point] = position;
	velocities_[point] = velocity;
	return {};
}

Status SoftBodyData::set_pinned(std::uint32_t point, bool pinned) {
	if (Status status = check_point(point, "position", {})) {
		return status;
	}
	pin_count_ += std::uint32_t(pinned) - std::uint32_t(inverse_masses_[point] == 0);
	note_change();
	inverse_masses_[point] = pinned ? Real(0) : 1 / shape_->masses()[point];
	if (pinned) {
		velocities_[point] = {};
	}
	return {};
}

Status SoftBodyData::teleport(const Pose &reference, const Pose &pose) {
	for (const Pose &each : { reference, pose }) {
		if (Status status = check_pose(each)) {
			return status;
		}
	}
	for (std::vector<Vec2> *points : { &positions_, &previous_positions_ }) {
		for (Vec2 &p : *points) {
			p = pose.apply(reference.apply_inverse(p));
		}
	}
	touch_memory_ = {};
	const Rotation from = reference.rotation;
	const Rotation to = pose.rotation;
	const Rotation turn{ to.c * from.c + to.s * from.s, to.s * from.c - to.c * from.s };
	rotation_memory_ = { turn.c * rotation_memory_.c - turn.s * rotation_memory_.s,
		turn.s * rotation_memory_.c + turn.c * rotation_memory_.s };
	return {};
}

} // namespace softbody
