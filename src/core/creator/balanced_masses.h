// SPDX-License-Identifier: MIT
// Puts the center of several masses where it belongs.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// Changes masses by as small factors as possible, so that their center is `center` and their sum stays. False, with
/// nothing changed, where a mass would lose more than three quarters, or all points lie on a line. Preconditions: as many
/// masses as points, all above 0. O(n).
bool balance_masses(std::span<const Vec2> points, Vec2d center, std::span<double> masses);

} // namespace softbody
