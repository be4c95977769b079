// SPDX-License-Identifier: MIT
// What a node tells scripts of its contacts.
#include "godot/nodes/contact_reports.h"

#include "godot/convert.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace softbody {

namespace {

// One place and one normal for all contacts with one collider, weighted by their impulses.
ContactReports::Impact impact_of(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders, uint64_t p_collider) {
	ContactReports::Impact impact;
	double weights = 0;
	for (std::size_t i = 0; i < p_contacts.size(); i++) {
		if (p_colliders[i] != p_collider) {
			continue;
		}
		const Contact &contact = p_contacts[i];
		const double weight = std::max<double>(contact.normal_impulse, 1e-9); // they may already part
		impact.point += to_godot(contact.point) * real_t(weight);
		impact.normal += to_godot(contact.normal) * real_t(weight);
		impact.impulse += contact.normal_impulse;
		weights += weight;
	}
	if (weights > 0) {
		impact.point /= real_t(weights);
		impact.normal.normalize();
	}
	return impact;
}

} // namespace

// Records stay in the order of the core, which does not depend on threads.
std::vector<uint64_t> ContactReports::take_over(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders,
		std::vector<uint64_t> &r_touched, int p_limit) {
	std::vector<uint32_t> kept(p_contacts.size());
	std::iota(kept.begin(), kept.end(), 0u);
	if (kept.size() > std::size_t(p_limit)) {
		std::ranges::stable_sort(kept, std::greater(), [&](uint32_t i) { return p_contacts[i].normal_impulse; });
		kept.resize(std::size_t(p_limit));
		std::ranges::sort(kept);
	}
	records_.clear();
	for (const uint32_t i : kept) {
		const Contact &contact = p_contacts[i];
		records_.push_back({ to_godot(contact.point), to_godot(contact.normal), double(contact.normal_impulse), double(contact.depth), contact.hull_point, p_colliders[i] });
	}

	std::ranges::sort(r_touched);
	r_touched.erase(std::ranges::unique(r_touched).begin(), r_touched.end());
	std::erase(r_touched, 0u); // what belongs to no object
	return std::exchange(touched_, r_touched);
}

ContactReports::Changes ContactReports::take(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders,
		std::vector<uint64_t> p_touched, int p_limit) {
	const std::vector<uint64_t> told = told_.take(take_over(p_contacts, p_colliders, p_touched, p_limit));
	Changes changes;
	std::ranges::set_difference(told, p_touched, std::back_inserter(changes.ended));
	std::vector<uint64_t> begun;
	std::ranges::set_difference(p_touched, told, std::back_inserter(begun));
	for (const uint64_t collider : begun) {
		changes.begun.push_back({ collider, impact_of(p_contacts, p_colliders, collider) });
	}
	return changes;
}

void ContactReports::take_quietly(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders,
		std::vector<uint64_t> p_touched, int p_limit) {
	told_.note_silence(take_over(p_contacts, p_colliders, p_touched, p_limit));
}

void ContactReports::restore(std::vector<uint64_t> p_touched) {
	told_.note_restore(touched_);
	touched_ = std::move(p_touched);
	records_.clear();
}

std::vector<uint64_t> ContactReports::forget_all() {
	records_.clear();
	told_ = {};
	return std::exchange(touched_, {});
}

} // namespace softbody
