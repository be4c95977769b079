// SPDX-License-Identifier: MIT
// Which bodies are stepped side by side.
#pragma once

#include "core/base/pack.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// A bit for every body of a full batch.
inline constexpr std::uint32_t ALL_LANES = (1u << PACK_WIDTH) - 1;

/// Bodies that are stepped together: PACK_WIDTH of one shape and settings by which they move alike, or a single one.
struct Batch {
	std::array<std::uint32_t, PACK_WIDTH> bodies{}; ///< body indices in `WorldData::soft_bodies()`
	std::uint32_t count = 0; ///< PACK_WIDTH or 1
	std::uint32_t monitored = 0; ///< a bit a lane: BodySettings::contact_monitor
	/// A bit a lane: may have a touch under way (TouchMemory), which a surface that bounced began. Kept by the step.
	std::uint32_t touching = 0;
	// Of the bodies, as long as nothing is rearranged: the step then need not read the bodies themselves.
	const SoftBodyShape *shape = nullptr;
	/// Of the first body, or of the first batch in a sequence that `move_alike`.
	const BodySettings *settings = nullptr;
	std::array<Vec2 *, PACK_WIDTH> positions{};
	std::array<Vec2 *, PACK_WIDTH> velocities{};

	/// As `SoftBodyData::rotation_memory`, which lies behind the velocities.
	Rotation rotation_memory(std::size_t lane) const {
		const Vec2 memory = velocities[lane][shape->point_count()];
		return { memory.x, memory.y };
	}
};

/// Whether two batches are full, of one shape, and have settings by which they move alike.
bool move_alike(const Batch &a, const Batch &b);

/// Divides the active bodies of a world into batches. Thousands of like bodies are the common scene, and side by
/// side they take a third of the time; what does not fit (another shape, pins) is stepped alone, with the same
/// result. Made anew only when an arrangement of `WorldData::change_counts()` is counted.
class BatchBuilder {
public:
	/// Does nothing while the world has not changed. O(bodies).
	void update(WorldData &world);
	std::span<const Batch> batches() const { return batches_; }
	std::span<Batch> batches() { return batches_; }
	/// Bodies in no batch, in the order of the world's storage.
	std::span<const std::uint32_t> inactive_bodies() const { return inactive_; }
	/// Moves with every division made.
	std::uint64_t version() const { return version_; }

private:
	std::vector<Batch> batches_;
	std::vector<std::uint32_t> inactive_;
	std::uint64_t seen_arrangement_ = 0;
	std::uint64_t version_ = 0;
};

} // namespace softbody
