// SPDX-License-Identifier: MIT
// Finds whether a body has its shape back after a fall: copies of it fall in worlds of their own.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

namespace softbody {

/// Loss of area after a fall from which on a body has not kept its shape [1].
inline constexpr Real FALLEN_AREA_LOSS = Real(0.2);

/// How a body lies after its falls: the worst of them.
struct FallOutcome {
	Real area_loss = 0; ///< share of the rest area [1]; negative for an inflated body
	bool folded = false; ///< its hull meets itself or has turned over

	bool keeps_shape() const { return !folded && area_loss <= FALLEN_AREA_LOSS; }

	friend bool operator==(const FallOutcome &, const FallOutcome &) = default;
};

/// Lets two copies of the body fall onto flat ground by twice its radius, that of a disk of its area: one as it stands, and
/// one turned a little. The body keeps its limits. The first fall that ruins the shape is the last. A body with pins, one that
/// nothing pulls, and arguments that a world refuses give an outcome without loss. `dt` [s] > 0. A formula cannot tell it:
/// without shape matching the hull of many points crosses itself in small loops, and XPBD cannot hold very many springs.
/// Takes up to 8 s of simulated time for each fall; not for use in a step.
FallOutcome try_falls(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt);

} // namespace softbody
