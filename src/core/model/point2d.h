// SPDX-License-Identifier: MIT
// One point mass as a value.
#pragma once

#include "core/base/vec2.h"

namespace softbody {

/// Point mass (thesis 4.4.2, "Point2D"). A value: bodies store their points as parallel arrays, because the step reads
/// positions without masses and masses without forces.
struct Point2D {
	Vec2 position; ///< [length]
	Vec2 velocity; ///< [length/s]
	Vec2 force; ///< external force queued for the next step [mass·length/s²]
	Real mass = 1; ///< [mass], > 0
	Real inverse_mass = 1; ///< 1 / mass, or 0 while the point is pinned
};

} // namespace softbody
