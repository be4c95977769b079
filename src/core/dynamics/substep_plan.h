// SPDX-License-Identifier: MIT
// How many substeps a body needs, from bounds on its own frequencies.
#pragma once

#include "core/base/real.h"
#include "core/model/body_settings.h"
#include "core/model/soft_body_shape.h"

namespace softbody {

/// What the substep rule found and chose, for display as much as for stepping.
struct SubstepPlan {
	Real frequency = 0; ///< Ω: bound of the highest angular frequency [rad/s]
	Real damping_rate = 0; ///< Γ: bound of the highest damping rate c/m [1/s]
	int substeps = 1; ///< chosen count
	/// How far the step may grow before the linear stability limit h²Ω² + 2hΓ = 4 is reached [1]:
	/// above 1 stable. Infinite without springs.
	Real stability_margin = 0;
	/// False when more than MAX_SUBSTEPS would be needed, or a fixed count is beyond the linear limit.
	bool safe = true;
};

/// The smallest n with h = dt/n and h²Ω² + 2hΓ <= STABILITY_BUDGET², at least MIN_CONTACT_SUBSTEPS if
/// `has_contacts`, at most MAX_SUBSTEPS; or the fixed count of the settings. The rule follows from
/// the linear limit of semi-implicit Euler, hω < 2 (sqrt(1 + ζ²) - ζ), which is h²ω² + 2h(2ζω) < 4.
/// `dt` [s] > 0. O(1).
SubstepPlan plan_substeps(const SoftBodyShape &shape, const BodySettings &settings, Real dt, bool has_contacts);

} // namespace softbody
