// SPDX-License-Identifier: MIT
// The forces on a body's points, evaluated for any state an integrator asks about.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

/// Adds up all forces at the given state (thesis eq. 3.7): gravity, springs with projected damping,
/// pressure, shape matching, and `external`. A term that is switched off is not evaluated. `positions`, `velocities` and `external` have one entry a point;
/// `forces` [mass·length/s²] is overwritten. Reads no state of the body other than its shape,
/// settings and rotation memory, so that multi-stage integrators can evaluate it anywhere.
/// O(points + springs).
void evaluate_forces(const SoftBodyData &body, Vec2 gravity, std::span<const Vec2> external,
		std::span<const Vec2> positions, std::span<const Vec2> velocities, std::span<Vec2> forces);

/// Adds the springs' forces: F = (k (|d| - l) + c (v2 - v1)·e) e on the first point, -F on the second
/// (thesis eq. 3.12 and 3.16, the latter corrected to a vector). A spring shorter than
/// DEGENERATE_LENGTH of its rest length has no direction and adds nothing.
void add_spring_forces(const SoftBodyShape &shape, std::span<const Vec2> positions,
		std::span<const Vec2> velocities, std::span<Vec2> forces);

/// Adds shape matching: m k_s / mean(m) (c + R q - x) on each point, and damping of the motion relative
/// to the rigid one (Müller et al. 2005, as a force; Müller et al. 2007, sec. 3.5). With weights
/// proportional to mass the sum of the forces and their torque about the centre of mass vanish
/// identically, and the highest frequency it adds is sqrt(k_s / mean(m)) whatever the masses.
void add_shape_forces(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities,
		std::span<Vec2> forces);

} // namespace softbody
