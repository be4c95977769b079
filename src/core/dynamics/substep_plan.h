// SPDX-License-Identifier: MIT
// Which integrator and how many substeps a body needs, from bounds on its own frequencies.
#pragma once

#include "core/base/real.h"
#include "core/model/body_settings.h"
#include "core/model/integrator.h"
#include "core/model/soft_body_shape.h"

namespace softbody {

/// Why a plan is as it is.
enum class PlanReason : std::uint8_t {
	STABILITY, ///< the smallest count that keeps within the stability budget
	CONTACTS, ///< the smallest count with which contacts behave; stability needs fewer
	TOO_STIFF, ///< past EXPLICIT_SUBSTEP_CAP: XPBD instead
	FIXED, ///< the settings fix the count
	UNSTABLE, ///< not stable with any count up to MAX_SUBSTEPS
};

/// What the substep rule found and chose, for display as much as for stepping.
struct SubstepPlan {
	Real frequency = 0; ///< Ω: bound of the highest angular frequency [rad/s]
	Real damping_rate = 0; ///< Γ: bound of the highest damping rate c/m [1/s]
	Integrator integrator = Integrator::SEMI_IMPLICIT_EULER; ///< chosen method, never AUTOMATIC
	int substeps = 1; ///< chosen count
	/// How far the substep may grow before the integrator's linear stability limit is reached [1]: above 1
	/// stable. Infinite for XPBD and without springs.
	Real stability_margin = 0;
	bool safe = true; ///< stability_margin > 1, and no cap was hit
	PlanReason reason = PlanReason::STABILITY;
	/// Force evaluations a step times points and springs: proportional to the time it takes [1].
	Real cost = 0;
};

/// Bounds on a body's own motion in any configuration. Ω² is that of the springs (see
/// SoftBodyShape::spring_frequency_squared), plus k_s/mean(m) for shape matching, plus
/// k_p (sum |∂A/∂x|²/m / A0 + 1/m) for pressure (its Hessian is k_p/A0 (∇A ∇Aᵀ + (A - sA0) ∇²A), and
/// ∇²A has eigenvalues up to 1). Γ is the same for the damping coefficients. O(1).
struct FrequencyBounds {
	double frequency_squared = 0; ///< Ω² [1/s²]
	double damping_rate = 0; ///< Γ [1/s]
};
FrequencyBounds frequency_bounds(const SoftBodyShape &shape, const BodySettings &settings);

/// Largest step [s] with which `integrator` stays within `budget` of its linear limit (2 is the limit
/// itself, less is a margin); 0 when no step is stable, infinite when every one is.
/// - Semi-implicit Euler: h²Ω² + 2hΓ <= budget², which is hω < 2(sqrt(1+ζ²) - ζ) at budget 2.
/// - Verlet: h²Ω² + 4hΓ <= budget², as the damping of its second kick is predicted with old forces.
/// - Runge-Kutta 4: h max(Ω, Γ) <= budget/2 · 2.6, inside its region on both axes (2.78 real, 2.83 imaginary).
/// - Explicit Euler: damping must outweigh its gain, h <= budget/2 · Γ/Ω², and h Γ <= budget.
/// - Midpoint and Heun: their gain (hω)³ω/8 must stay below the decay, (hΩ)³ <= budget/2 · 4 Γ/Ω, and h Γ <= budget.
double largest_stable_step(Integrator integrator, const FrequencyBounds &bounds, double budget);

/// Chooses. AUTOMATIC is velocity Verlet where there is nothing to touch, semi-implicit Euler where there
/// is (`has_contacts`), with the smallest n for which h = dt/n is within STABILITY_BUDGET, at least
/// MIN_CONTACT_SUBSTEPS if `has_contacts`; past EXPLICIT_SUBSTEP_CAP it is XPBD with XPBD_SUBSTEPS. A named integrator keeps its name, with its own smallest n up to
/// MAX_SUBSTEPS. A fixed count of the settings is kept, safe or not. `dt` [s] > 0. O(1).
SubstepPlan plan_substeps(const SoftBodyShape &shape, const BodySettings &settings, Real dt, bool has_contacts);

} // namespace softbody
