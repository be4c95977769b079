// SPDX-License-Identifier: MIT
// The default integrator: velocity first, then position with the new velocity.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

/// Advances one body by `h` [s]: v += h F(x, v)/m, then x += h v (thesis eq. 3.17 to 3.25 with the
/// updated velocity in 3.25, which makes the method symplectic for undamped springs). Order 1, one
/// force evaluation, stable for hω < 2 without damping. `forces` is scratch of one entry a point.
void step_semi_implicit_euler(SoftBodyData &body, Vec2 gravity, std::span<const Vec2> external, Real h,
		std::span<Vec2> forces);

} // namespace softbody
