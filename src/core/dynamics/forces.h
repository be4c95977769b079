// SPDX-License-Identifier: MIT
// The forces on a body's points, evaluated for any state an integrator asks about.
#pragma once

#include "core/base/vec2.h"
#include "core/model/body_lanes.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

/// Adds up all forces at the given state (thesis eq. 3.7): gravity, springs with projected damping,
/// pressure, shape matching, elastic modes, and `external`. The area term is no force (`hold_area`). A term that is switched
/// off is not evaluated. `positions` and
/// `velocities` have one entry a point, `external` one a point or none at all; `forces` [mass·length/s²] is
/// overwritten. Reads no state of the body other than its shape, settings and rotation memory, so that
/// multi-stage integrators can evaluate it anywhere. O(points + springs).
template <class T>
void evaluate_forces(const BodyModel<T> &body, Vec2 gravity, std::span<const BasicVec2<T>> external,
		std::span<const BasicVec2<T>> positions, std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces);

/// Adds the springs' forces: F = (k (|d| - l) + c (v2 - v1)·e) e on the first point, -F on the second
/// (thesis eq. 3.12 and 3.16, the latter corrected to a vector). A spring shorter than
/// DEGENERATE_LENGTH of its rest length has no direction and adds nothing. Stiffness and damping are multiplied by the
/// settings' scales.
template <class T>
void add_spring_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces);

/// Adds shape matching: m k_s / mean(m) (c + R q - x) on each point, and damping of the motion relative
/// to the rigid one (Müller et al. 2005, as a force; Müller et al. 2007, sec. 3.5). With weights
/// proportional to mass the sum of the forces and their torque about the center of mass vanish
/// identically, and the highest frequency it adds is sqrt(k_s / mean(m)) whatever the masses.
template <class T>
void add_shape_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces);

} // namespace softbody
