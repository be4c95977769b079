// SPDX-License-Identifier: MIT
// Notes of the contacts that are found during a step, one for each place however many substeps find it.
#include "core/collision/contact_log.h"

#include <algorithm>

namespace softbody {

namespace {

constexpr std::size_t LEAST_SLOTS = 64;

bool is_same_place(const Sighting &a, const Sighting &b) {
	return a.body == b.body && a.other == b.other && a.feature == b.feature && a.kind == b.kind;
}

// Multiplications by odd numbers and shifts, after SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t hash_of(const Sighting &sighting) {
	std::uint64_t hash = std::uint64_t(sighting.body) << 32 | sighting.other;
	hash *= 0x9e3779b97f4a7c15u;
	hash ^= hash >> 32 ^ std::uint64_t(sighting.feature) << 8 ^ std::uint64_t(sighting.kind);
	hash *= 0xbf58476d1ce4e5b9u;
	return hash ^ hash >> 29;
}

} // namespace

// Linear probing. Where `sighting` stands, or where it would.
std::size_t ContactLog::slot_of(const Sighting &sighting) const {
	const std::size_t mask = slots_.size() - 1;
	std::size_t slot = hash_of(sighting) & mask;
	while (slots_[slot] != 0 && !is_same_place(sightings_[slots_[slot] - 1], sighting)) {
		slot = (slot + 1) & mask;
	}
	return slot;
}

void ContactLog::grow() {
	slots_.assign(std::max(LEAST_SLOTS, 2 * slots_.size()), 0);
	for (std::uint32_t i = 0; i < sightings_.size(); ++i) {
		slots_[slot_of(sightings_[i])] = i + 1;
	}
}

void ContactLog::add(const Sighting &sighting) {
	if (2 * sightings_.size() >= slots_.size()) {
		grow();
	}
	std::uint32_t &entry = slots_[slot_of(sighting)];
	if (entry == 0) {
		sightings_.push_back(sighting);
		entry = std::uint32_t(sightings_.size());
		return;
	}
	Sighting &known = sightings_[entry - 1];
	const Real impulse = known.normal_impulse + sighting.normal_impulse;
	known = sighting;
	known.normal_impulse = impulse;
}

void ContactLog::clear() {
	if (!sightings_.empty()) {
		sightings_.clear();
		std::ranges::fill(slots_, 0);
	}
}

} // namespace softbody
