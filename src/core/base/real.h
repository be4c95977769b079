// SPDX-License-Identifier: MIT
// Names the core's floating-point type, so that one source builds in both precisions.
#pragma once

namespace softbody {

/// Scalar of all simulated quantities: `float`, or `double` when the core is compiled with
/// `SOFTBODY_DOUBLE`. Games use float (half the memory traffic); the double build separates
/// rounding from truncation error in the accuracy charts.
#ifdef SOFTBODY_DOUBLE
using Real = double;
#else
using Real = float;
#endif

} // namespace softbody
