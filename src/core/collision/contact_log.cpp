// SPDX-License-Identifier: MIT
// Records the contacts of a step, one for each place however many substeps find it.
#include "core/collision/contact_log.h"

#include <algorithm>

namespace softbody {

namespace {

constexpr std::size_t LEAST_SLOTS = 64;

bool is_same_place(const ContactPoint &a, const ContactPoint &b) {
	return a.body == b.body && a.other == b.other && a.feature == b.feature && a.kind == b.kind;
}

// Multiplications by odd numbers and shifts, after SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t hash_of(const ContactPoint &contact_point) {
	std::uint64_t hash = std::uint64_t(contact_point.body) << 32 | contact_point.other;
	hash *= 0x9e3779b97f4a7c15u;
	hash ^= hash >> 32 ^ std::uint64_t(contact_point.feature) << 8 ^ std::uint64_t(contact_point.kind);
	hash *= 0xbf58476d1ce4e5b9u;
	return hash ^ hash >> 29;
}

} // namespace

// Linear probing. Returns the slot of `contact_point`, or the free slot for it.
std::size_t ContactLog::slot_of(const ContactPoint &contact_point) const {
	const std::size_t mask = slots_.size() - 1;
	std::size_t slot = hash_of(contact_point) & mask;
	while (slots_[slot] != 0 && !is_same_place(contact_points_[slots_[slot] - 1], contact_point)) {
		slot = (slot + 1) & mask;
	}
	return slot;
}

void ContactLog::grow() {
	slots_.assign(std::max(LEAST_SLOTS, 2 * slots_.size()), 0);
	for (std::uint32_t i = 0; i < contact_points_.size(); ++i) {
		slots_[slot_of(contact_points_[i])] = i + 1;
	}
}

void ContactLog::add(const ContactPoint &contact_point) {
	if (2 * contact_points_.size() >= slots_.size()) {
		grow();
	}
	std::uint32_t &entry = slots_[slot_of(contact_point)];
	if (entry == 0) {
		contact_points_.push_back(contact_point);
		entry = std::uint32_t(contact_points_.size());
		return;
	}
	ContactPoint &known = contact_points_[entry - 1];
	const Real impulse = known.normal_impulse + contact_point.normal_impulse;
	known = contact_point;
	known.normal_impulse = impulse;
}

void ContactLog::clear() {
	if (!contact_points_.empty()) {
		contact_points_.clear();
		std::ranges::fill(slots_, 0);
	}
}

} // namespace softbody
