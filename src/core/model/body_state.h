// SPDX-License-Identifier: MIT
// Everything a body remembers from step to step, and all of it as one value that can be saved and restored.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/id_list.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// A force on one point, acting during the whole of the next step (thesis 4.4.2).
struct ExternalForce {
	std::uint32_t point = 0; ///< point index
	Vec2 force; ///< [mass·length/s²]
	friend bool operator==(const ExternalForce &, const ExternalForce &) = default;
};

/// Place of a pinned point at the end of the next step.
struct PinTarget {
	std::uint32_t point = 0; ///< point index
	Vec2 position; ///< [length]
	friend bool operator==(const PinTarget &, const PinTarget &) = default;
};

/// Force and torque on a body as a whole during the next step (see `add_rigid_force`).
struct RigidLoad {
	Vec2 force; ///< [mass·length/s²]
	Real torque = 0; ///< about the center of mass [mass·length²/s²]
	friend bool operator==(const RigidLoad &, const RigidLoad &) = default;
};

/// Memory of the touch that a body is in, for its bounce when it leaves.
struct TouchMemory {
	bool touching = false;
	Real approach = 0; ///< fastest approach of the center of mass during this touch [length/s]
	Real restitution = 0; ///< of body and surface together [1]
	Vec2 normal; ///< of the last contacts, weighted by their impulses; unit
	Vec2 surface_velocity; ///< [length/s]
	double account = 0; ///< energy that the body's touches have taken and not given back [mass·length²/s²]
	// Of the current step.
	bool ended = false;
	Real missing = 0; ///< speed that the body lacks of its bounce, once the touch has ended [length/s]
	double work = 0; ///< that moving surfaces have done on the body [mass·length²/s²]
	friend bool operator==(const TouchMemory &, const TouchMemory &) = default;
};

/// Memory of a touch of two bodies, for their bounce when they part and shortly after.
struct PairTouch {
	bool touching = false;
	Real approach = 0; ///< fastest approach of their centers during this touch [length/s]
	bool ended = false; ///< in this step
	Real missing = 0; ///< speed that the two lack of their bounce since the touch has ended [length/s]
	friend bool operator==(const PairTouch &, const PairTouch &) = default;
};

/// A touch with another body, current or not yet paid for, kept by the body that is stored first in the world.
struct PairMemory {
	BodyId other;
	PairTouch touch;
	friend bool operator==(const PairMemory &, const PairMemory &) = default;
};

/// State of a body at a one-way collider near it: held by it, or on its way through.
struct OneWayMemory {
	std::uint64_t collider = 0; ///< its `one_way_name`
	bool held = false;
	friend bool operator==(const OneWayMemory &, const OneWayMemory &) = default;
};

/// Whether a body sleeps, and for how long it has hardly moved.
struct RestState {
	Real rest_time = 0; ///< [s]
	Vec2 drowsy_center; ///< center of mass when it became drowsy
	Vec2 drowsy_velocity; ///< of the center of mass at that time [length/s]
	bool asleep = false;
	std::uint64_t island = 0; ///< while asleep: common to all bodies that fell asleep together
	std::uint64_t surroundings = 0; ///< while asleep: stands for its environment and joints, see `SleepWatch`
	std::uint32_t restored = 0; ///< number of restored states since the last step
	friend bool operator==(const RestState &, const RestState &) = default;
};

/// Stands for any fluids (`SoftBodyData::fluids`): of a body that was put to sleep, until the next step.
inline constexpr std::uint64_t ANY_FLUIDS = ~std::uint64_t(0);

/// What a body remembers besides the places and speeds of its points.
struct BodyMemory {
	std::vector<Vec2> previous_positions; ///< of all points, for drawing [length]
	std::vector<PinTarget> pin_targets; ///< of the next step
	std::vector<ExternalForce> external_forces; ///< queued for the next step
	RigidLoad load; ///< queued for the next step
	Vec2 acceleration; ///< SoftBodyData::acceleration [length/s²]
	std::uint64_t fluids = 0; ///< SoftBodyData::fluids
	TouchMemory touch;
	std::vector<PairMemory> pair_touches;
	std::vector<OneWayMemory> one_ways; ///< the few one-way colliders that hold the body or that it passes through
	RestState rest;
	Real damage_pause = 0; ///< time for which strain does not dent or tear the body [s]
	std::vector<Vec2> last_valid_hull; ///< see SoftBodyData::last_valid_hull; empty, or one a hull point
	bool placed = true; ///< put where it is since colliders were last looked at, see SoftBodyData::is_placed
	bool active = true;
	bool frozen = false;

	friend bool operator==(const BodyMemory &, const BodyMemory &) = default;
};

/// Everything of a body that a step reads and writes (`SoftBodyData::save_state`). Restored with equal shape, settings,
/// world and environment, the body goes on in the same bits, on any number of threads. `BodyId`s in it mean something
/// in the same world, or in one built alike. Not part of it: shape, settings, ignored tags, everything of the world,
/// and contact events already reported, so touches may be reported to begin or end anew.
struct BodyState : BodyMemory {
	std::vector<Vec2> positions; ///< of all points [length]
	std::vector<Vec2> velocities; ///< of all points [length/s]
	std::vector<std::uint32_t> pinned_points; ///< ascending
	Rotation rotation_memory;
	std::vector<Vec2> rest_positions; ///< of a dented body, of all points about its center of mass [length]; else empty

	BodyMemory &memory() { return *this; }
	const BodyMemory &memory() const { return *this; }

	friend bool operator==(const BodyState &, const BodyState &) = default;
};

/// Refuses, by name, lists of other sizes, indices out of range or order, and non-finite values. O(points).
Status check_body_state(const BodyState &state, std::size_t point_count, std::size_t hull_count);

/// A state as bytes, equal on every machine: little-endian, with a version, the size of `Real` and a checksum.
std::vector<std::uint8_t> to_bytes(const BodyState &state);
/// The state from its bytes. Refuses, by name, other data, another version or precision, damaged data and non-finite
/// values. `restore_state` checks whether it fits a body. Never allocates more than about the data's size.
Result<BodyState> body_state_from_bytes(std::span<const std::uint8_t> bytes);

} // namespace softbody
