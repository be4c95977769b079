// SPDX-License-Identifier: MIT
// What a node tells scripts of its contacts.
#pragma once

#include "core/model/contact.h"
#include "godot/nodes/told_value.h"

#include <godot_cpp/variant/vector2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Contacts of the last step, and which objects the body touches.
class ContactReports {
public:
	/// Place and strength of a contact when two things met.
	struct Impact {
		godot::Vector2 point; ///< in the world [px]
		godot::Vector2 normal; ///< unit, towards this body
		double impulse = 0; ///< [kg·px/s]
	};
	/// An object that the body has begun to touch.
	struct Beginning {
		uint64_t collider = 0; ///< instance id
		Impact impact;
	};
	/// What has begun and ended in a step.
	struct Changes {
		std::vector<uint64_t> ended; ///< instance ids
		std::vector<Beginning> begun;
	};
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
	/// are touched. Returns what has begun or ended since the last call.
	Changes take(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders, std::vector<uint64_t> p_touched, int p_limit);
	/// As `take`, in a step that tells nothing.
	void take_quietly(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders, std::vector<uint64_t> p_touched, int p_limit);
	/// With a state: the objects touched then. The contacts are forgotten.
	void restore(std::vector<uint64_t> p_touched);
	/// Forgets the contacts. The touched objects are kept, as the body may come back.
	void clear() { records_.clear(); }
	/// Forgets contacts and touched objects, and returns the objects.
	std::vector<uint64_t> forget_all();
	/// Forgets an object. False if it was not touched.
	bool forget(uint64_t p_collider) { return std::erase(touched_, p_collider) > 0; }

private:
	/// Returns the objects before the step; `p_touched` becomes sorted.
	std::vector<uint64_t> take_over(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders, std::vector<uint64_t> &r_touched, int p_limit);

	std::vector<Record> records_;
	std::vector<uint64_t> touched_;
	ToldValue<std::vector<uint64_t>> told_;
};

} // namespace softbody
