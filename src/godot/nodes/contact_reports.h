// SPDX-License-Identifier: MIT
// What a node tells scripts of its contacts.
#pragma once

#include "core/model/contact.h"

#include <godot_cpp/variant/vector2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

class BodySignals;

/// Contacts of the last step, and which objects the body touches.
class ContactReports {
public:
	struct Record {
		godot::Vector2 point;
		godot::Vector2 normal;
		double impulse = 0;
		double depth = 0;
		uint32_t core_point = 0;
		uint64_t collider = 0; ///< instance id, 0 for none
	};

	/// Contacts reported at most: of more, the strongest are.
	static constexpr int DEFAULT_LIMIT = 16;
	static constexpr int MOST_LIMIT = 4096; ///< as Godot's RigidBody2D

	const std::vector<Record> &records() const { return records_; }
	/// Instance ids, sorted.
	const std::vector<uint64_t> &touched() const { return touched_; }

	/// After a step. `p_colliders` has the instance id of the other side of each contact, `p_touched` those of all objects that
	/// are touched. What has begun or ended since the last call goes to `r_signals`, as of the node `p_owner`.
	void take(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders, std::vector<uint64_t> p_touched,
			int p_limit, uint64_t p_owner, BodySignals &r_signals);
	/// Forgets the contacts. The touched objects are kept, as the body may come back.
	void clear() { records_.clear(); }
	/// Forgets contacts and touched objects, and returns the objects.
	std::vector<uint64_t> forget_all();
	/// Forgets an object. False if it was not touched.
	bool forget(uint64_t p_collider) { return std::erase(touched_, p_collider) > 0; }

private:
	std::vector<Record> records_;
	std::vector<uint64_t> touched_;
};

} // namespace softbody
