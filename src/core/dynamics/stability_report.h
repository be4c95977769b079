// SPDX-License-Identifier: MIT
// Judges whether a body will hold: its substep plan, and its springs compared with its weight. For editor tools.
#pragma once

#include "core/base/real.h"
#include "core/base/vec2.h"
#include "core/dynamics/substep_plan.h"

namespace softbody {

/// The sag of a body of the usual structure (hull and centre springs) on flat ground depends on q = k n R / (8 m g)
/// alone (measured for 8 to 64 hull points): below 1 it folds, at 2 it has lost a tenth of its area, at 4 a twentieth,
/// at 8 a fiftieth. For a body with elastic modes or triangles q = E R / (m g): at 15 a disk has lost 4 % of its
/// height, at 4 a tenth.
inline constexpr Real FOLDING_STRENGTH = 1;
inline constexpr Real FIRM_STRENGTH = 4;

/// Result of `report_stability`.
struct StabilityReport {
	SubstepPlan plan; ///< the plan of a step
	/// The plan if the settings left the number of substeps open: `plan`, unless they fix it.
	SubstepPlan automatic;
	Real stiffness = 0; ///< mean of the springs [force/length]; 0 without springs
	Real strength = 0; ///< q [1]; infinite without weight
	Real folding_stiffness = 0; ///< where q is FOLDING_STRENGTH [force/length]
	Real firm_stiffness = 0; ///< where q is FIRM_STRENGTH [force/length]
	/// E of a body with elastic modes or triangles [force/length]; 0 for others, for which the next two mean nothing.
	Real youngs_modulus = 0;
	Real folding_youngs_modulus = 0; ///< where q is FOLDING_STRENGTH [force/length]
	Real firm_youngs_modulus = 0; ///< where q is FIRM_STRENGTH [force/length]
	Real damping = 0; ///< mean of the springs [force·s/length]
	/// Damping below which strong deformations ring for long [force·s/length]: DAMPING_FLOOR sqrt(k m), of the means.
	Real least_damping = 0;

	bool is_too_soft() const { return strength < FOLDING_STRENGTH; }
	bool rings() const { return damping < least_damping; }
};

/// Judges a body at rest. R is the radius of a disk of the hull's area, n the number of hull points. `gravity`
/// [length/s²] is that of the world, before the settings' factor. `dt` [s] > 0. A formula: inner springs, pressure and
/// painted springs carry more or less than it says; `LoadTrial` measures that. O(springs).
StabilityReport report_stability(const SoftBodyShape &shape, const BodySettings &settings, Vec2 gravity, Real dt,
		bool has_contacts);

} // namespace softbody
