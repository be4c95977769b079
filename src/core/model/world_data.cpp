// SPDX-License-Identifier: MIT
// Storage of bodies under stable ids, and of their surroundings.
#include "core/model/world_data.h"

#include <string>
#include <utility>

namespace softbody {

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

BodyId WorldData::add_soft_body(SoftBodyData body) {
	if (free_slots_.empty()) {
		free_slots_.push_back(std::uint32_t(slots_.size()));
		slots_.emplace_back();
	}
	const std::uint32_t slot = free_slots_.back();
	free_slots_.pop_back();
	slots_[slot].dense = std::uint32_t(bodies_.size());
	const BodyId id{ slot, slots_[slot].generation };
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
	bodies_[dense].wake(); // and with it what rested on it
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

Status WorldData::add_border(const Border &border) {
	if (Status status = check_border(border)) {
		return status;
	}
	borders_.push_back(border);
	return {};
}

Status WorldData::add_collider(ConvexCollider collider) {
	if (Status status = check_collider(collider)) {
		return status;
	}
	colliders_.push_back(std::move(collider));
	return {};
}

void WorldData::clear_surroundings() {
	borders_.clear();
	colliders_.clear();
}

} // namespace softbody
