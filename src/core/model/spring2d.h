// SPDX-License-Identifier: MIT
// One damped linear spring between two points of a body.
#pragma once

#include "core/base/real.h"

#include <cstdint>

namespace softbody {

/// Spring between the points `a` and `b` of one body (thesis 4.4.2, "Spring2D"). It pulls with k(|d| - l) along the
/// line between the points and damps only the rate of length change, so it neither turns the body nor resists its
/// rotation (thesis eq. 3.12 and 3.16, corrected).
struct Spring2D {
	std::uint32_t a = 0; ///< point index
	std::uint32_t b = 0; ///< point index, != a
	Real rest_length = 0; ///< l [length], > 0
	Real stiffness = 0; ///< k [force/length], >= 0
	Real damping = 0; ///< c [force·s/length], >= 0
};

} // namespace softbody
