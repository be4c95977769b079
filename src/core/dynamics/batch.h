// SPDX-License-Identifier: MIT
// Bodies that are stepped together in SIMD lanes.
#pragma once

#include "core/base/pack.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/body_settings.h"
#include "core/model/soft_body_shape.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace softbody {

/// Bodies of one shape, equal settings and one plan: WIDE_WIDTH or PACK_WIDTH of them, or a single body. A batch is a
/// view of the active bodies, made for one call.
struct Batch {
	const SoftBodyShape *shape = nullptr;
	const BodySettings *settings = nullptr;
	const SubstepPlan *plan = nullptr;
	std::uint32_t count = 0; ///< WIDE_WIDTH, PACK_WIDTH or 1
	std::array<std::uint32_t, WIDE_WIDTH> active_indices; ///< of the first `count` lanes, as the next two
	std::array<std::uint32_t, WIDE_WIDTH> body_indices; ///< indices into `WorldData::soft_bodies()`
	std::array<Vec2 *, WIDE_WIDTH> states; ///< positions of all points, followed by velocities and by the rotation memory

	/// Velocities of a lane's points.
	Vec2 *velocities(std::size_t lane) const { return states[lane] + shape->point_count(); }
	/// Rotation memory of a lane, see `SoftBodyData::rotation_memory`.
	Rotation rotation_memory(std::size_t lane) const {
		const Vec2 memory = states[lane][2 * shape->point_count()];
		return { memory.x, memory.y };
	}
};

} // namespace softbody
