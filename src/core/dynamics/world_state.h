// SPDX-License-Identifier: MIT
// The state of a whole world as bytes: saved, compared, put back.
#pragma once

#include "core/base/error.h"
#include "core/dynamics/simulator.h"
#include "core/model/state_archive.h"
#include "core/model/world_data.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace softbody {

/// Saves and restores everything that determines the coming steps of a world, of which it is the caller's to keep shapes,
/// settings, gravity and environment: bodies, joints, collision exceptions, sleep, touches. Restored, the world goes on in the
/// same bits. Its bodies must be those that it had, in the same order and of the same structure.
///
/// Bytes are little-endian, with a version, the size of `Real` and a checksum. Each body is one record. A state on top of a
/// `base` has only the records that differ from that. Owns scratch memory, which grows with the world.
class WorldState {
public:
	/// What a caller keeps beside the world and its bodies goes into their state as bytes. Each function may be empty.
	struct Companion {
		std::uint64_t world_token = 0; ///< tags and hashes of the environment mean something in a world of this number only
		std::function<void(std::size_t body, StateWriter &to)> write_body;
		std::function<void(StateWriter &to)> write_world;
		/// What a refusal calls the body stored at that index; its index if empty.
		std::function<std::string(std::size_t body)> name_body;
	};
	/// A body whose state differs from the one that `read` has accepted.
	struct Changed {
		std::size_t body = 0; ///< index in `WorldData::soft_bodies`
		std::span<const std::uint8_t> companion; ///< what `write_body` wrote
	};

	/// The state between two steps. `base`: an earlier state of the same world, saved without a base; refused if it is none.
	/// `bytes` lends its memory. O(points).
	Result<std::vector<std::uint8_t>> save(const Simulator &simulator, const Companion &companion,
			std::span<const std::uint8_t> base = {}, std::vector<std::uint8_t> bytes = {});

	/// Reads and checks a state, and compares it with the world. Refuses, by name, damaged bytes, another version or precision,
	/// another base, other bodies, and non-finite values. `bytes` and `base` must stay until `put_back`. O(bytes + points).
	Status read(const Simulator &simulator, const Companion &companion, std::span<const std::uint8_t> bytes,
			std::span<const std::uint8_t> base = {});
	/// What is other than in the state that was read.
	std::span<const Changed> changed() const { return changed_; }
	/// What `write_world` wrote.
	std::span<const std::uint8_t> companion() const { return companion_; }
	/// Whether the state is of a world with another token.
	bool is_foreign() const { return is_foreign_; }
	/// Restores the state that was read, once, unless the world has been changed since. O(bodies + points of the changed ones),
	/// and the next step checks all bodies. In a world of another token a body that sleeps takes the environment that the next step
	/// finds for the one in which it fell asleep, and touches of tags and one-way colliders are forgotten.
	void put_back(Simulator &simulator);

private:
	struct Table {
		std::span<const std::uint8_t> world;
		std::uint64_t checksum = 0;
		std::uint64_t base = 0; ///< checksum of its base; 0 without one
		std::uint64_t token = 0;
		std::vector<std::span<const std::uint8_t>> records; ///< one a body; empty: that of the base
	};

	static Status open(const char *name, std::span<const std::uint8_t> bytes, Table &table);
	static void write_record(const SoftBodyData &body, std::size_t index, const Companion &companion, StateWriter &to);
	void write_world(const Simulator &simulator, const Companion &companion, StateWriter &to) const;
	Status read_world(std::span<const std::uint8_t> bytes, const WorldData &world);
	Status read_record(std::span<const std::uint8_t> record, const SoftBodyData &body, std::size_t index, const Companion &companion);
	void forget_environment();

	Table state_;
	Table base_;
	StateWriter present_; ///< record of a body as it is
	WorldData::Memory memory_;
	std::vector<Touch> touches_;
	std::vector<Changed> changed_;
	std::vector<BodyState> states_; ///< of the changed bodies, and more that are not used
	std::span<const std::uint8_t> companion_;
	bool is_foreign_ = false;
};

/// A number that tells whether two worlds agree in what moves: places, velocities, dents, sleep, joints. Alike on every machine,
/// and in worlds that have met other objects of the same places. O(points).
std::uint64_t hash_of_motion(const WorldData &world);

} // namespace softbody
