// SPDX-License-Identifier: MIT
// Storage of bodies under stable ids, and of their environment.
#include "core/model/world_data.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <string>
#include <utility>

namespace softbody {

namespace {

std::uint64_t next_version() {
	static std::atomic<std::uint64_t> last = 0;
	return ++last;
}

} // namespace

Status WorldData::set_gravity(Vec2 gravity) {
	if (Status status = check_finite("gravity", gravity)) {
		return status;
	}
	if (gravity != gravity_) {
		wake_all();
	}
	gravity_ = gravity;
	return {};
}

Status WorldData::set_length_unit(Real length_unit) {
	if (Status status = check_above("length_unit", length_unit, 0, "")) {
		return status;
	}
	length_unit_ = length_unit;
	return {};
}

void WorldData::set_sleeping(bool sleeping) {
	sleeping_ = sleeping;
	if (!sleeping) {
		wake_all();
	}
}

void WorldData::wake_all() {
	for (SoftBodyData &body : soft_bodies()) {
		body.wake();
	}
}

Status WorldData::set_contact_substeps(int contact_substeps) {
	if (Status status = check_between("contact_substeps", contact_substeps, 1, MAX_SUBSTEPS, "")) {
		return status;
	}
	contact_substeps_ = contact_substeps;
	return {};
}

BodyId WorldData::add_soft_body(SoftBodyData body) {
	body.wake(); // bodies with which it may have fallen asleep are elsewhere
	body.set_change_counts(changes_);
	++changes_->arrangement;
	return bodies_.add(std::move(body));
}

bool WorldData::remove_soft_body(BodyId id) {
	SoftBodyData *body = find(id);
	if (!body) {
		return false;
	}
	body->disturb(); // and with it the bodies that rested on it
	std::erase_if(collision_exceptions_, [id](const CollisionException &each) { return each.a == id || each.b == id; });
	remove_joints_of(id);
	++changes_->arrangement;
	return bodies_.remove(id);
}

bool WorldData::replace_soft_body(BodyId id, SoftBodyData body) {
	SoftBodyData *place = find(id);
	if (!place) {
		return false;
	}
	place->disturb();
	remove_joints_of(id);
	body.wake();
	body.set_change_counts(changes_);
	++changes_->arrangement;
	*place = std::move(body);
	return true;
}

void WorldData::remove_joints_of(BodyId id) {
	for (std::size_t i = joints().size(); i-- > 0;) {
		if (joints()[i].first.body == id || joints()[i].second.body == id) {
			remove_joint(joint_id_at(i));
		}
	}
}

Status WorldData::add_collision_exception(BodyId a, BodyId b) {
	for (const BodyId id : { a, b }) {
		if (!find(id)) {
			return Error{ "body", "an id that refers to nothing", "must be a body of this world", "add the exception before its bodies are removed" };
		}
	}
	if (a == b) {
		return Error{ "body", "the same twice", "must be two bodies", "switch self_collision off instead" };
	}
	const CollisionException exception{ std::min(a, b), std::max(a, b) };
	const auto place = std::ranges::lower_bound(collision_exceptions_, exception);
	if (place == collision_exceptions_.end() || *place != exception) {
		collision_exceptions_.insert(place, exception);
		find(a)->wake();
		find(b)->wake();
	}
	return {};
}

bool WorldData::remove_collision_exception(BodyId a, BodyId b) {
	if (std::erase(collision_exceptions_, CollisionException{ std::min(a, b), std::max(a, b) }) == 0) {
		return false;
	}
	find(a)->wake();
	find(b)->wake();
	return true;
}

bool WorldData::has_collision_exception(BodyId a, BodyId b) const {
	return std::ranges::binary_search(collision_exceptions_, CollisionException{ std::min(a, b), std::max(a, b) });
}

WorldData::Memory WorldData::memory() const {
	return { bodies_.order(), collision_exceptions_, joints_.order(), { joints().begin(), joints().end() }, changes_->put_to_sleep,
		changes_->woken_islands, changes_->disturbed_boxes };
}

Status WorldData::check_memory(const Memory &memory) const {
	constexpr const char *UNSOUND = "keep the bytes as they were saved";
	const std::size_t count = memory.bodies.ids.size();
	if (count != soft_bodies().size()) {
		return Error{ "state.bodies", std::to_string(count), "must be as many as the world has, " + std::to_string(soft_bodies().size()),
			count < soft_bodies().size() ? "remove first the bodies that came since" : "disable bodies instead of removing them" };
	}
	for (std::size_t i = 0; i < count; ++i) {
		if (memory.bodies.ids[i] != id_at(i)) {
			return Error{ "state.bodies[" + std::to_string(i) + "]", "another body", "must be the one that the world has there",
				"disable bodies instead of removing them, or build the world in the same order" };
		}
	}
	if (!IdList<SoftBodyData>::is_sound(memory.bodies)) {
		return Error{ "state.bodies", "ids that do not fit", "must each be used or free", UNSOUND };
	}
	if (!IdList<Joint>::is_sound(memory.joint_order) || memory.joint_order.ids.size() != memory.joints.size()) {
		return Error{ "state.joints", "ids that do not fit", "must each be used or free", UNSOUND };
	}
	for (const Joint &joint : memory.joints) {
		if (Status status = check_joint_here(joint)) {
			status->name = "state." + status->name;
			return status;
		}
	}
	for (const CollisionException &exception : memory.exceptions) {
		if (!find(exception.a) || !find(exception.b) || !(exception.a < exception.b)) {
			return Error{ "state.exceptions", "a pair that the world has not", "must be two bodies, the lesser id first", UNSOUND };
		}
	}
	if (std::ranges::adjacent_find(memory.exceptions, std::greater_equal()) != memory.exceptions.end()) {
		return Error{ "state.exceptions", "out of order", "must ascend", UNSOUND };
	}
	for (const Aabb &box : memory.disturbed_boxes) {
		if (!is_finite(box.min) || !is_finite(box.max)) {
			return Error{ "state.disturbed_boxes", "non-finite", "must be finite", UNSOUND };
		}
	}
	return {};
}

void WorldData::put_back(Memory memory) {
	bodies_.set_order(memory.bodies);
	collision_exceptions_ = std::move(memory.exceptions);
	joints_.assign(std::move(memory.joints), memory.joint_order);
	changes_->put_to_sleep = memory.put_to_sleep;
	changes_->woken_islands = std::move(memory.woken_islands);
	changes_->disturbed_boxes = std::move(memory.disturbed_boxes);
	for (const auto count : { &ChangeCounts::arrangement, &ChangeCounts::forces, &ChangeCounts::pin_targets, &ChangeCounts::joints,
				 &ChangeCounts::restores }) {
		++(*changes_.*count);
	}
}

Status WorldData::check_joint_here(const Joint &joint) const {
	if (Status status = check_joint(joint)) {
		return status;
	}
	for (const bool is_first : { true, false }) {
		const JointAnchor &anchor = is_first ? joint.first : joint.second;
		const std::string name = is_first ? "joint.first" : "joint.second";
		if (!anchor.is_soft()) {
			continue;
		}
		const SoftBodyData *body = find(anchor.body);
		if (!body) {
			return Error{ name + ".body", "an id without a body", "must refer to a body of this world",
				"use the id that add_soft_body returned" };
		}
		const std::size_t count = anchor.fraction != 0 ? body->shape().hull_count() : body->point_count();
		if (Status status = check_index(name + ".point", anchor.point, count,
					anchor.fraction != 0 ? "use an index of a hull point" : "use an index of an existing point")) {
			return status;
		}
	}
	return {};
}

void WorldData::note_joint(const Joint &joint) {
	++changes_->joints;
	for (const JointAnchor &anchor : { joint.first, joint.second }) {
		if (SoftBodyData *body = anchor.is_soft() ? find(anchor.body) : nullptr) {
			body->wake();
		}
	}
}

Result<JointId> WorldData::add_joint(const Joint &joint) {
	if (Status status = check_joint_here(joint)) {
		return *status;
	}
	note_joint(joint);
	return joints_.add(joint);
}

Status WorldData::set_joint(JointId id, const Joint &joint) {
	Joint *known = joints_.find(id);
	if (!known) {
		return Error{ "id", std::to_string(id.index), "must refer to a joint", "use the id that add_joint returned" };
	}
	if (Status status = check_joint_here(joint)) {
		return status;
	}
	note_joint(*known);
	note_joint(joint);
	*known = joint;
	return {};
}

bool WorldData::remove_joint(JointId id) {
	const Joint *joint = joints_.find(id);
	if (!joint) {
		return false;
	}
	note_joint(*joint);
	return joints_.remove(id);
}

Status WorldData::add_border(const Border &border) {
	if (Status status = check_border(border)) {
		return status;
	}
	borders_.push_back(border);
	environment_version_ = next_version();
	return {};
}

Status WorldData::add_collider(Collider collider) {
	const Status missing = collider.rigid_body == NO_RIGID_BODY ? Status()
			: check_index("collider.rigid_body", collider.rigid_body, rigid_bodies_.size(), "add the rigid body before its colliders");
	if (Status status = first_error({ check_collider(collider), missing })) {
		return status;
	}
	colliders_.push_back(std::move(collider));
	environment_version_ = next_version();
	return {};
}

Result<std::uint32_t> WorldData::add_rigid_body(const RigidBody &body) {
	if (Status status = check_rigid_body(body)) {
		return *status;
	}
	rigid_bodies_.push_back(body);
	reactions_.emplace_back();
	return std::uint32_t(rigid_bodies_.size() - 1);
}

Status WorldData::set_rigid_body(std::uint32_t index, const RigidBody &body) {
	if (Status status = first_error({ check_index("index", index, rigid_bodies_.size(), "use the index that add_rigid_body returned"),
				check_rigid_body(body) })) {
		return status;
	}
	rigid_bodies_[index] = body;
	return {};
}

void WorldData::clear_environment() {
	borders_.clear();
	colliders_.clear();
	rigid_bodies_.clear();
	reactions_.clear();
	environment_version_ = next_version();
}

} // namespace softbody
