// SPDX-License-Identifier: MIT
// The forces on a body's points, as a function of positions and velocities.
#pragma once

#include "core/base/vec2.h"
#include "core/model/body_lanes.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

/// Adds up all forces at the given state (thesis eq. 3.7): gravity, springs with projected damping, pressure, shape
/// matching, elastic modes or triangles, and `external`. The area term is not a force (`hold_area`). `positions` and
/// `velocities` have one entry a point, `external` one a point or none; `forces` [mass·length/s²] is overwritten. Of
/// the body only shape, settings and rotation memory are read. O(points + springs).
template <class T>
void evaluate_forces(const BodyModel<T> &body, Vec2 gravity, std::span<const BasicVec2<T>> external,
		std::span<const BasicVec2<T>> positions, std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces);

/// Adds the springs' forces: F = (k (|d| - l) + c (v2 - v1)·e) e on the first point, -F on the second (thesis eq. 3.12
/// and 3.16, the latter corrected to a vector). A spring shorter than DEGENERATE_LENGTH of its rest length has no
/// direction and adds nothing. The settings' scales multiply stiffness and damping.
template <class T>
void add_spring_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces);

/// Adds shape matching: m k_s / mean(m) (c + R q - x) on each point, and damping of the motion relative to the rigid
/// one (Müller et al. 2005, as a force; Müller et al. 2007, sec. 3.5). With weights proportional to mass the forces and
/// their torques about the center of mass sum to zero, and the highest frequency added is sqrt(k_s / mean(m)) whatever
/// the masses.
template <class T>
void add_shape_forces(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions,
		std::span<const BasicVec2<T>> velocities, std::span<BasicVec2<T>> forces);

} // namespace softbody
