// SPDX-License-Identifier: MIT
// Place and rotation of a rigid thing.
#pragma once

#include "core/base/vec2.h"

namespace softbody {

/// A rigid placement: rotation about the body's origin, then translation.
struct Pose {
	Vec2 position; ///< [length]
	Rotation rotation;

	Vec2 apply(Vec2 local) const { return position + rotation.apply(local); }
	Vec2 apply_inverse(Vec2 world) const { return rotation.apply_inverse(world - position); }
};

} // namespace softbody
