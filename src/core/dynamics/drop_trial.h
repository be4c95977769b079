// SPDX-License-Identifier: MIT
// Finds from what height a body may fall before it dents, or tears: copies of it land in worlds of their own.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <functional>

namespace softbody {

/// Heights of a free fall onto flat ground, from rest, of the lowest point [length]. Infinite: nothing happens up to
/// MOST_DROP. Zero: it happens where the body stands.
inline constexpr Real MOST_DROP = 100; ///< [m]

/// Whether a landing body is what is asked for, after each step of it.
using DropCheck = std::function<bool(const SoftBodyData &)>;

/// Finds the least height from which `check` becomes true within half a second of landing as the body is turned now, to a
/// twentieth above; what happens below a twentieth of the radius counts as that height. It is found by doubling and bisection, so that a height above it may be harmless where a body bounces
/// off differently. Drag does not count. A body with pins, one that nothing pulls, arguments that a world refuses, and
/// trials that take more than `most_steps` steps in all give NaN. `dt` [s] > 0. Not for use in a step.
Real find_drop_height(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt, int most_steps, const DropCheck &check);

} // namespace softbody
