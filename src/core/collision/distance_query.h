// SPDX-License-Identifier: MIT
// Whether a body is close to a body or surface that it has touched.
#pragma once

#include "core/collision/collider_index.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <vector>

namespace softbody {

/// Whether two bodies that notice each other are less than `gap` [length] apart. Also true for overlapping bodies if a
/// point of one is that close to the other's hull. O(points²), or O(points) if their boxes are farther apart.
bool are_near(const SoftBodyData &a, const SoftBodyData &b, Real gap);

/// Whether a body is less than `gap` [length] from, or inside, a border or collider of this tag that it notices, with
/// rigid bodies at their present poses. Beside a sharp corner of a polygon it may be somewhat farther. `surroundings`
/// must be those of the last step; `scratch` is overwritten. O(borders + hull points × colliders near).
bool is_near_tag(const ColliderIndex &surroundings, const SoftBodyData &body, std::uint64_t tag, Real gap,
		std::vector<std::uint32_t> &scratch);

} // namespace softbody
