// SPDX-License-Identifier: MIT
// What air and water do to an outline: buoyancy, drag where the fluid runs against it, and viscosity.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"

#include <span>
#include <vector>

namespace softbody {

/// A fluid that fills a region of the plane.
struct Fluid {
	Real density = 0; ///< ρ [mass/length²], >= 0
	/// C [1], >= 0: an edge of length l whose outer side the fluid meets at the normal speed v is pressed inward by ρ C v² l / 2.
	/// The lee side is not pulled.
	Real drag = 1;
	/// k [1/s], >= 0: the fluid pulls the body along as a whole, by ρ A k times their difference in velocity; A is the area inside.
	Real viscosity = 0;
	Vec2 flow = {}; ///< velocity of the fluid [length/s]
	Vec2 gravity = {}; ///< by which what is displaced weighs [length/s²]; 0: no buoyancy
};

/// Refuses the first value that is not finite or out of its range, by name.
Status check_fluid(const Fluid &fluid);

/// The part of a polygon inside a convex region of positive winding (Sutherland and Hodgman 1974). Of a concave polygon the parts
/// may be joined by edges without area between them, so that area and centroid are right. Empty where there is none. O(n·m).
std::vector<Vec2> clip_to_convex(std::span<const Vec2> polygon, std::span<const Vec2> region);

/// Adds the forces of a fluid in a convex region of positive winding to those of the points of a hull of either winding, each of
/// mass `point_mass`. Buoyancy is -ρ A `gravity`, and acts at the centroid of A, the area that will be inside in the middle of a
/// step of `time_step` [s]. No force of drag does more in `time_step` than to take the fluid's speed. O(n·m).
void add_fluid_forces(const Fluid &fluid, std::span<const Vec2> region, std::span<const Vec2> hull, std::span<const Vec2> velocities, Real point_mass, Real time_step, std::span<Vec2> forces);

} // namespace softbody
