// SPDX-License-Identifier: MIT
// Tests on points and triangles, robust to rounding (thesis Alg. 4.5 and 4.6, corrected).
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/segment.h" // for includers that ask about segments too

namespace softbody {

/// Twice the signed area of the triangle abc: positive when a, b, c turn from x towards y
/// (counter-clockwise with y up, clockwise on Godot's screen). Evaluated in double, so that the
/// sign is right for float input unless the triangle is thinner than about 1e-15 of its size.
/// Source: thesis Alg. 4.6, which calls this the area.
double signed_double_area(Vec2 a, Vec2 b, Vec2 c);

/// Whether p lies in the triangle abc, border included, for either winding. A degenerate triangle
/// (zero area) contains nothing. Source: thesis Alg. 4.5, with the upper bound on u that it lacks.
bool point_in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c);

} // namespace softbody
