// SPDX-License-Identifier: MIT
// Exact-as-possible tests on points, triangles and line segments (thesis Alg. 4.5 to 4.7, corrected).
#pragma once

#include "core/base/vec2.h"

#include <optional>

namespace softbody {

/// Twice the signed area of the triangle abc: positive when a, b, c turn from x towards y
/// (counter-clockwise with y up, clockwise on Godot's screen). Evaluated in double, so that the
/// sign is right for float input unless the triangle is thinner than about 1e-15 of its size.
/// Source: thesis Alg. 4.6, which calls this the area.
double signed_double_area(Vec2 a, Vec2 b, Vec2 c);

/// Whether p lies in the triangle abc, border included, for either winding. A degenerate triangle
/// (zero area) contains nothing. Source: thesis Alg. 4.5, with the upper bound on u that it lacks.
bool point_in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c);

/// Where segments ab and cd meet, as the parameter t in [0, 1] along ab; empty when they do not.
/// Touching end points count. Collinear overlap gives the first shared point seen from a.
/// Source: thesis Alg. 4.7, with a + t(b - a) for its misprint and the touching cases it misses.
std::optional<Real> segment_intersection(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

/// Parameter t in [0, 1] of the point a + t(b - a) closest to p; 0 when a and b coincide.
Real closest_parameter_on_segment(Vec2 p, Vec2 a, Vec2 b);

} // namespace softbody
