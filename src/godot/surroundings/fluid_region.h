// SPDX-License-Identifier: MIT
// The part of the plane that a fluid fills: the shapes of an area.
#pragma once

#include "core/base/vec2.h"

#include <godot_cpp/classes/area2d.hpp>

#include <vector>

namespace softbody {

/// Convex polygons of positive winding, one for each shape that is not disabled, in global coordinates. Round shapes become polygons
/// of 32 corners, a world boundary a square of WATER_REACH below it. Shapes without an inside (segments, rays, concave ones) give none.
std::vector<std::vector<Vec2>> read_fluid_region(godot::Area2D &area);

/// How far a world boundary reaches to each side of its middle, and down [px].
inline constexpr double WATER_REACH = 100000;

} // namespace softbody
