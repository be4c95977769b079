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

/// Bodies of one shape that take the same substeps by the same method, and whose settings differ in the coefficients of
/// forces at most (`can_stand_side_by_side`): WIDE_WIDTH or PACK_WIDTH of them, or a single body. A batch is a view of
/// the active bodies, made for one call.
struct Batch {
	const SoftBodyShape *shape = nullptr;
	const BodySettings *settings = nullptr; ///< of the first body, which hold for all but for the coefficients
	const SubstepPlan *plan = nullptr; ///< of the first body
	bool are_unlike = false; ///< whether settings differ, which are then in `own_settings`
	std::uint32_t count = 0; ///< WIDE_WIDTH, PACK_WIDTH or 1
	std::array<std::uint32_t, WIDE_WIDTH> active_indices; ///< of the first `count` lanes, as the next two
	std::array<std::uint32_t, WIDE_WIDTH> body_indices; ///< indices into `WorldData::soft_bodies()`
	std::array<const BodySettings *, WIDE_WIDTH> own_settings;
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
