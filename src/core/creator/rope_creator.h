// SPDX-License-Identifier: MIT
// Turns a path and its widths into the structure of an open chain: a rope, a strap, a tentacle.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/soft_body_shape.h"

#include <memory>
#include <span>
#include <vector>

namespace softbody {

/// Largest number of points of a rope's path [1].
inline constexpr int MAX_ROPE_POINTS = 512;

/// Points at equal distances along a polyline, first and last included: `count` of them. Refuses fewer than two points, points
/// that are not finite, a path without length and a count that is not 2..MAX_ROPE_POINTS. O(path + count).
Result<std::vector<Vec2>> divide_path(std::span<const Vec2> path, int count);

/// Refuses a path of fewer than 2 or more than MAX_ROPE_POINTS points, non-finite points, neighbors that coincide, another number
/// of widths than points, and widths that are not > 0. O(path).
Status check_rope(std::span<const Vec2> path, std::span<const Real> widths);

/// The outline of a rope along `path`, with a width [length] at each of its n points: `outline[i]` and `outline[2n - 1 - i]` lie
/// beside point i. It runs along one side of the path and back along the other, with positive winding. Refuses what `check_rope` refuses, and a path
/// so bent or so near to itself that the outline would cross itself. O(path²).
Result<std::vector<Vec2>> rope_outline(std::span<const Vec2> path, std::span<const Real> widths);

/// A rope of that outline, whose centerline runs through `centers`, half as many points as the hull has. Points are the hull's,
/// then the centers; a hull of negative winding is reversed about its first point, as `SoftBodyCreator` does. Each section has the
/// share of `mass` [mass] that it has of the outline's area. Most of it is in the hull points, which meet other bodies. Refuses
/// what `SoftBodyShape::create` refuses, a hull of another number of points and a mass that is not > 0.
Result<std::shared_ptr<const SoftBodyShape>> create_rope_in(std::span<const Vec2> hull, std::span<const Vec2> centers, Real mass);

/// The rope along `path` with these widths and this mass. Refuses what `rope_outline` and the above refuse.
Result<std::shared_ptr<const SoftBodyShape>> create_rope(std::span<const Vec2> path, std::span<const Real> widths, Real mass);

} // namespace softbody
