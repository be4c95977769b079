// SPDX-License-Identifier: MIT
// Damping of springs by the ratio to critical damping, as in the thesis.
#pragma once

#include "core/base/real.h"

#include <cmath>
#include <cstddef>

namespace softbody {

/// Usual damping of a spring as a fraction of sqrt(k m) [1].
inline constexpr Real DEFAULT_DAMPING_RATIO = Real(0.05);

/// Damping coefficient c [force·s/length] that gives each spring the damping ratio `ratio`, on points of mass
/// `total_mass / point_count`: c = ratio sqrt(k m).
inline Real damping_for_ratio(Real ratio, Real stiffness, Real total_mass, std::size_t point_count) {
	return ratio * std::sqrt(stiffness * total_mass / Real(point_count));
}

} // namespace softbody
