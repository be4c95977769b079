// SPDX-License-Identifier: MIT
// Chooses the integrator and the number of substeps of a body, from bounds on its own frequencies.
#pragma once

#include "core/base/real.h"
#include "core/model/body_settings.h"
#include "core/model/integrator.h"
#include "core/model/soft_body_data.h"
#include "core/model/soft_body_shape.h"

namespace softbody {

/// The reason for a plan.
enum class PlanReason : std::uint8_t {
	STABILITY, ///< the smallest count that keeps within the stability budget
	CONTACTS, ///< the smallest count with which contacts behave; stability needs fewer
	TOO_STIFF, ///< past EXPLICIT_SUBSTEP_CAP: XPBD instead
	FIXED, ///< the settings fix the count
	UNSTABLE, ///< not stable with any count up to MAX_SUBSTEPS
};

/// "stability", "contacts", "too_stiff", "fixed" or "unstable".
const char *name_of(PlanReason reason);

/// Result of the substep rule, for display as much as for stepping.
struct SubstepPlan {
	Real frequency = 0; ///< Ω: bound of the highest angular frequency [rad/s]
	Real damping_rate = 0; ///< Γ: bound of the highest damping rate c/m [1/s]
	Integrator integrator = Integrator::SEMI_IMPLICIT_EULER; ///< chosen method, never AUTOMATIC
	int substeps = 1; ///< chosen count
	/// Share of a substep at whose end XPBD solves its constraints, 1/2..1; 1 for the other methods. At 1/2 the step is
	/// the implicit midpoint rule, which damps nothing; at 1 it is implicit Euler, which damps all that is fast.
	Real implicit_share = 1;
	/// Factor by which the substep may grow before the integrator's linear stability limit is reached [1]: above 1
	/// stable. Infinite for XPBD and without springs.
	Real stability_margin = 0;
	/// stability_margin > 1, and no cap was hit. For explicit Euler, midpoint and Heun that covers motion near the rest
	/// shape only: crumpled bodies may gain energy. Figures: docs/accuracy.md, "The automatic choice".
	bool safe = true;
	PlanReason reason = PlanReason::STABILITY;
	/// Force evaluations a step times points, springs and elastic triangles: proportional to the time it takes [1].
	Real cost = 0;
};

/// Substeps of a body in one of `parts` equal slices of a step: its share, rounded up.
inline int substeps_in_slice(const SubstepPlan &plan, int parts) {
	return (plan.substeps + parts - 1) / parts;
}

/// Bounds on a body's own motion; derived in docs/decisions/substep-rule.md.
struct FrequencyBounds {
	double frequency_squared = 0; ///< Ω², of the highest squared angular frequency [1/s²]
	double damping_rate = 0; ///< Γ, of the highest damping rate [1/s]
	/// β, the least ratio of damping to stiffness [s]; infinite without stiffness. Visits every spring, so it is
	/// evaluated for explicit Euler, midpoint and Heun only.
	double damping_time = 0;
};
/// The body at rest: exact for springs and shape matching, and for pressure while the hull keeps its size. O(1).
FrequencyBounds frequency_bounds(const SoftBodyShape &shape, const BodySettings &settings);
/// As above, with the pressure of the present hull and of the one to which its velocities would carry it in `dt` [s],
/// whichever is larger. Not rigorous for accelerations within the step. O(hull points).
FrequencyBounds frequency_bounds(const SoftBodyData &body, Real dt);

/// Largest step [s] with which `integrator` stays within `budget` of its linear limit (2 is the limit itself, less is a
/// margin); 0 when no step is stable, infinite when every one is. The eigenvalues z of stiffness K and damping C solve
/// z² + c z + k = 0 with βk <= c <= Γ, k <= Ω².
/// - Semi-implicit Euler: h²Ω² + 2hΓ <= budget², which is hω < 2(sqrt(1+ζ²) - ζ) at budget 2.
/// - Verlet: h²Ω² + 4hΓ <= budget², as the damping of its second kick is predicted with old forces.
/// - Runge-Kutta 4: h max(Ω, Γ) <= budget/2 · 2.6, a half disk within its region (2.78 real, 2.83 imaginary).
/// - Explicit Euler: h <= budget/2 · β and hΓ <= budget.
/// - Midpoint and Heun: h³ <= budget/2 · 4β/Ω² or h <= budget/2 · β, and hΓ <= budget.
double largest_stable_step(Integrator integrator, const FrequencyBounds &bounds, double budget);

/// Number of substeps in a step of `dt` [s], given `in_usual_step` for a step of USUAL_STEP: proportional where `dt` is
/// longer, up to MAX_CONTACT_SUBSTEPS; never fewer.
int substeps_of_step(int in_usual_step, Real dt);

/// Chooses integrator and substeps for a step of `dt` [s] > 0, for a body at its rest shape. AUTOMATIC is velocity
/// Verlet without and semi-implicit Euler with `has_contacts`, with the smallest n for which h = dt/n is within
/// STABILITY_BUDGET, at least MIN_CONTACT_SUBSTEPS if `has_contacts`. Past EXPLICIT_SUBSTEP_CAP it is XPBD with
/// XPBD_SUBSTEPS. Both counts are larger in long steps (`substeps_of_step`). A body that may dent has the method and the
/// substep of XPBD that it has in a step of USUAL_STEP, so that dents do not depend on `dt`. A named integrator is kept, with its own
/// smallest n up to MAX_SUBSTEPS. A fixed count of the settings is kept, safe or not. A chain has its own method (`ChainSolver`),
/// with CHAIN_SUBSTEPS, whatever the integrator.
SubstepPlan plan_substeps(const SoftBodyShape &shape, const BodySettings &settings, Real dt, bool has_contacts);
/// The plan for a step of `dt` [s] that a body begins near its rest shape (CALM_STRAIN), where `plan` is the one for any
/// shape. Springs that point in different directions are slower together than the same springs in one line, so that
/// semi-implicit Euler needs fewer substeps. Another method, a body with hardly any damping (CALM_DAMPING), one under pressure, or a
/// count that is fixed or due to contacts keeps `plan`.
SubstepPlan plan_near_rest(const SubstepPlan &plan, const SoftBodyShape &shape, const BodySettings &settings, Real dt);
/// The plan of a body in its present state, which differs while pressure acts on a stretched hull.
SubstepPlan plan_substeps(const SoftBodyData &body, Real dt, bool has_contacts);

} // namespace softbody
