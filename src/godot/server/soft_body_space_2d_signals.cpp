// SPDX-License-Identifier: MIT
// Signals of a space's step: touches and sleep.
#include "godot/server/soft_body_space_2d.h"

#include "godot/nodes/soft_body_2d.h"
#include "godot/server/body_signals.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

using namespace godot;

namespace softbody {

namespace {

/// Nodes by the slots of their bodies. Moving nodes may have brought other bodies into the slots since the step.
class NodeIds {
public:
	explicit NodeIds(const std::vector<SoftBody2D *> &p_nodes) {
		for (const SoftBody2D *node : p_nodes) {
			const BodyId body = node->get_body_id();
			if (body.index != UINT32_MAX) {
				entries_.resize(std::max<std::size_t>(entries_.size(), body.index + 1));
				entries_[body.index] = { body, node->get_instance_id() };
			}
		}
	}

	/// Instance id, 0 for a surface without an object.
	uint64_t find(const ContactOther &p_other) const {
		if (p_other.kind != ContactOther::Kind::SOFT_BODY) {
			return p_other.tag;
		}
		const uint32_t slot = p_other.body.index;
		return slot < entries_.size() && entries_[slot].body == p_other.body ? entries_[slot].id : 0;
	}

private:
	struct Entry {
		BodyId body;
		uint64_t id = 0;
	};
	std::vector<Entry> entries_;
};

// Records of one body, in a list that is sorted by bodies.
template <class Record>
std::span<const Record> of_body(std::span<const Record> p_list, BodyId p_body) {
	const auto found = std::ranges::equal_range(p_list, p_body.index, {}, [](const Record &p_record) { return p_record.body.index; });
	return found.empty() || found.front().body != p_body ? std::span<const Record>() : std::span<const Record>(found);
}

} // namespace

void SoftBodySpace2D::collect_signals(BodySignals &r_signals) {
	bool has_watchers = false;
	for (SoftBody2D *node : nodes_) {
		node->take_sleep(r_signals);
		has_watchers = has_watchers || node->watches_contacts();
	}
	if (!has_watchers) {
		return;
	}
	const NodeIds ids(nodes_);
	std::vector<uint64_t> colliders;
	for (SoftBody2D *node : nodes_) {
		if (!node->watches_contacts()) {
			continue;
		}
		const std::span<const Contact> contacts = of_body(simulator_.contacts(), node->get_body_id());
		colliders.clear();
		for (const Contact &contact : contacts) {
			colliders.push_back(ids.find(contact.other));
		}
		std::vector<uint64_t> touched;
		for (const Touch &touch : of_body(simulator_.touches(), node->get_body_id())) {
			touched.push_back(ids.find(touch.other));
		}
		node->take_contacts(contacts, colliders, std::move(touched), r_signals);
	}
}

} // namespace softbody
