// SPDX-License-Identifier: MIT
// Puts the center of several masses where it belongs.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/holed_polygon.h"

#include <cstddef>
#include <span>

namespace softbody {

/// Changes masses by as small factors as possible, so that their center is `center` and their sum stays. False, with
/// nothing changed, where a mass would lose more than three quarters, or all points lie on a line. Preconditions: as many
/// masses as points, all above 0. O(n).
bool balance_masses(std::span<const Vec2> points, Vec2d center, std::span<double> masses);

/// The same, and so that the moment of inertia about the center is that of an area of these moments, too: mass moves between the hull,
/// which are the first points, and the inner points, and then all masses change a little. Where no such masses are found, as for a ring
/// without points inside, only the center is right. False where not even that can be.
bool give_moments(std::span<const Vec2> points, std::size_t hull_count, const AreaMoments &moments, std::span<double> masses);

} // namespace softbody
