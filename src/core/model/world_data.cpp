// SPDX-License-Identifier: MIT
// Storage of bodies under stable ids, and of their environment.
#include "core/model/world_data.h"

#include <algorithm>
#include <atomic>
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
	if (!is_finite(gravity)) {
		return Error{ "gravity", "(" + number_text(gravity.x) + ", " + number_text(gravity.y) + ")", "must be finite",
			"check the computation that produced this value" };
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
	for (SoftBodyData &body : bodies_) {
		body.wake();
	}
}

Status WorldData::set_contact_substeps(int contact_substeps) {
	if (contact_substeps < 1 || contact_substeps > MAX_SUBSTEPS) {
		return Error{ "contact_substeps", std::to_string(contact_substeps),
			"must be from 1 to " + std::to_string(MAX_SUBSTEPS), "4 to 8 hold an ordinary pile" };
	}
	contact_substeps_ = contact_substeps;
	return {};
}

void WorldData::set_contact_response(ContactResponse response) {
	if (response != contact_response_) {
		wake_all();
	}
	contact_response_ = response;
}

Status WorldData::set_separation_stiffness(Real stiffness) {
	if (Status status = check_at_least("separation_stiffness", stiffness, 0, "N/m²")) {
		return status;
	}
	separation_stiffness_ = stiffness;
	return {};
}

BodyId WorldData::add_soft_body(SoftBodyData body) {
	if (free_slots_.empty()) {
		free_slots_.push_back(std::uint32_t(slots_.size()));
		slots_.emplace_back();
	}
	const std::uint32_t slot = free_slots_.back();
	free_slots_.pop_back();
	slots_[slot].dense = std::uint32_t(bodies_.size());
	const BodyId id{ slot, slots_[slot].generation };
	body.wake(); // bodies with which it may have fallen asleep are elsewhere
	body.set_change_counts(changes_);
	bodies_.push_back(std::move(body));
	ids_.push_back(id);
	++changes_->arrangement;
	return id;
}

bool WorldData::remove_soft_body(BodyId id) {
	if (!find(id)) {
		return false;
	}
	const std::uint32_t dense = slots_[id.index].dense;
	bodies_[dense].disturb(); // and with it the bodies that rested on it
	std::erase_if(collision_exceptions_, [id](const CollisionException &each) { return each.a == id || each.b == id; });
	for (std::size_t i = joints().size(); i-- > 0;) {
		if (joints()[i].first.body == id || joints()[i].second.body == id) {
			remove_joint(joint_id_at(i));
		}
	}
	if (dense + 1 != bodies_.size()) {
		bodies_[dense] = std::move(bodies_.back());
		ids_[dense] = ids_.back();
		slots_[ids_[dense].index].dense = dense;
	}
	bodies_.pop_back();
	ids_.pop_back();
	slots_[id.index].dense = UINT32_MAX;
	slots_[id.index].generation++;
	free_slots_.push_back(id.index);
	++changes_->arrangement;
	return true;
}

SoftBodyData *WorldData::find(BodyId id) {
	return const_cast<SoftBodyData *>(std::as_const(*this).find(id));
}

const SoftBodyData *WorldData::find(BodyId id) const {
	if (id.index >= slots_.size() || slots_[id.index].dense == UINT32_MAX ||
			slots_[id.index].generation != id.generation) {
		return nullptr;
	}
	return &bodies_[slots_[id.index].dense];
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
	const CollisionException exception{ std::min(a, b), std::max(a, b) };
	const auto place = std::ranges::lower_bound(collision_exceptions_, exception);
	if (place == collision_exceptions_.end() || *place != exception) {
		return false;
	}
	collision_exceptions_.erase(place);
	find(a)->wake();
	find(b)->wake();
	return true;
}

bool WorldData::has_collision_exception(BodyId a, BodyId b) const {
	return std::ranges::binary_search(collision_exceptions_, CollisionException{ std::min(a, b), std::max(a, b) });
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
		if (anchor.point >= count) {
			return Error{ name + ".point", std::to_string(anchor.point), "must be below " + std::to_string(count),
				anchor.fraction != 0 ? "use an index of a hull point" : "use an index of an existing point" };
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
	if (Status status = check_collider(collider)) {
		return status;
	}
	if (collider.rigid_body != NO_RIGID_BODY && collider.rigid_body >= rigid_bodies_.size()) {
		return Error{ "collider.rigid_body", std::to_string(collider.rigid_body),
			"must be below " + std::to_string(rigid_bodies_.size()), "add the rigid body before its colliders" };
	}
	colliders_.push_back(std::move(collider));
	environment_version_ = next_version();
	return {};
}

Status WorldData::add_chain(std::span<const Vec2> points, bool closed, const Collider &like) {
	const std::size_t least = closed ? 3 : 2;
	if (points.size() < least) {
		return Error{ "chain", std::to_string(points.size()) + " points",
			"must have at least " + std::to_string(least) + " points", "give the missing points" };
	}
	const std::size_t count = colliders_.size();
	for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i) {
		Collider segment = like;
		const std::size_t size = points.size();
		segment.vertices = { points[i], points[(i + 1) % size] };
		if (closed || i > 0) {
			segment.ghost_at_first = points[(i + size - 1) % size];
		}
		if (closed || i + 2 < size) {
			segment.ghost_at_second = points[(i + 2) % size];
		}
		Status status;
		if (segment.vertices[0] == segment.vertices[1]) {
			status = Error{ "chain[" + std::to_string(i) + "]", "coincides with the next", "must differ from its neighbors",
				"remove one of the two" };
		} else {
			status = add_collider(std::move(segment));
		}
		if (status) {
			colliders_.erase(colliders_.begin() + std::ptrdiff_t(count), colliders_.end());
			return status;
		}
	}
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
	if (index >= rigid_bodies_.size()) {
		return Error{ "index", std::to_string(index), "must be below " + std::to_string(rigid_bodies_.size()),
			"use the index that add_rigid_body returned" };
	}
	if (Status status = check_rigid_body(body)) {
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
