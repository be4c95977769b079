// SPDX-License-Identifier: MIT
// Which integrator and how many substeps a body needs, from bounds on its own frequencies.
#pragma once

#include "core/base/real.h"
#include "core/model/body_settings.h"
#include "core/model/integrator.h"
#include "core/model/soft_body_data.h"
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
	/// stability_margin > 1, and no cap was hit. For explicit Euler, midpoint and Heun that speaks of motion near the
	/// rest shape: there none of 4762 random bodies called safe grew, but crumpled 3 to 7 % of explicit Euler's did,
	/// and 1 % of the others'.
	bool safe = true;
	PlanReason reason = PlanReason::STABILITY;
	/// Force evaluations a step times points, springs and elastic triangles: proportional to the time it takes [1].
	Real cost = 0;
};

/// Bounds on a body's own motion. Ω² is that of the springs (see SoftBodyShape::spring_frequency_squared), plus
/// k_s/mean(m) for shape matching, both in any configuration, plus the pressure's. Its Hessian is
/// k_p/A0 (∇A ∇Aᵀ + (A - sA0) ∇²A), so it adds k_p (sum |∂A/∂x|²/m / A0 + |A/A0 - s|/m), as ∇²A has eigenvalues up
/// to 1. Both parts grow without limit as the hull is stretched: no constant bounds them.
/// Elastic modes add the stiffness of what is in no mode over the mass. Elastic triangles add μ times
/// `triangle_shear_inverse_mass`, in any configuration, which alone is damped, and K times `triangle_dilation_inverse_mass`, that at rest.
/// In other configurations a triangle is up to 2.42 times as stiff against a change of area; STABILITY_BUDGET leaves room for 2.37
/// times Ω².
/// Γ is the same as Ω² for the damping coefficients; pressure has none.
/// β is what the explicit methods live by, a time such that C - βK is positive: the least ratio of damping to
/// stiffness. Springs give the least c/k of those with k > 0. All that shape matching damps may pay for the pressure
/// too: pressure moves no rigid motion, its stiffness is at most p = k_p sum |∂A/∂x|²/m / A0 and shape damping acts on
/// everything else alike, so the two together have c_s / (k_s + p mean(m)); with pressure and without shape damping, 0.
/// β holds near the rest shape. Away from it, springs under tension resist motion across them with
/// k (1 - l/|d|), which nothing damps, and so does pressure off its target: there explicit methods may gain energy.
struct FrequencyBounds {
	double frequency_squared = 0; ///< Ω² [1/s²]
	double damping_rate = 0; ///< Γ [1/s]
	/// β [s]; infinite where nothing is stiff. Evaluated for explicit Euler, midpoint and Heun alone: it takes a
	/// look at every spring.
	double damping_time = 0;
};
/// The body at rest: exact for springs and shape matching, and for pressure while the hull keeps its size. O(1).
FrequencyBounds frequency_bounds(const SoftBodyShape &shape, const BodySettings &settings);
/// As above, with the pressure of the present hull and of the one to which its velocities would carry it in `dt` [s],
/// wherever that is larger. Not rigorous for what accelerations change within the step. O(hull points).
FrequencyBounds frequency_bounds(const SoftBodyData &body, Real dt);

/// Largest step [s] with which `integrator` stays within `budget` of its linear limit (2 is the limit
/// itself, less is a margin); 0 when no step is stable, infinite when every one is. Modes need not be
/// simultaneous eigenvectors of stiffness K and damping C: whatever the eigenvector u, its eigenvalue z solves
/// z² + c z + k = 0 with c = u*Cu and k = u*Ku, and βk <= c <= Γ, k <= Ω².
/// - Semi-implicit Euler: h²Ω² + 2hΓ <= budget², which is hω < 2(sqrt(1+ζ²) - ζ) at budget 2.
/// - Verlet: h²Ω² + 4hΓ <= budget², as the damping of its second kick is predicted with old forces.
/// - Runge-Kutta 4: h max(Ω, Γ) <= budget/2 · 2.6, a half disk within its region (2.78 real, 2.83 imaginary).
/// - Explicit Euler: h <= budget/2 · β and hΓ <= budget.
/// - Midpoint and Heun: h³ <= budget/2 · 4β/Ω² or h <= budget/2 · β, and hΓ <= budget.
double largest_stable_step(Integrator integrator, const FrequencyBounds &bounds, double budget);

/// As many substeps as `in_usual_step` are in a step of USUAL_STEP, in one of `dt` [s]: in proportion where it is longer, up
/// to MAX_CONTACT_SUBSTEPS; never fewer.
int substeps_of_step(int in_usual_step, Real dt);

/// Chooses. AUTOMATIC is velocity Verlet where there is nothing to touch, semi-implicit Euler where there
/// is (`has_contacts`), with the smallest n for which h = dt/n is within STABILITY_BUDGET, at least
/// MIN_CONTACT_SUBSTEPS if `has_contacts`; past EXPLICIT_SUBSTEP_CAP it is XPBD with XPBD_SUBSTEPS; both more in long steps
/// (`substeps_of_step`). A named integrator
/// keeps its name, with its own smallest n up to MAX_SUBSTEPS. A fixed count of the settings is kept, safe or not.
/// `dt` [s] > 0. This is the plan of a body at its rest shape.
SubstepPlan plan_substeps(const SoftBodyShape &shape, const BodySettings &settings, Real dt, bool has_contacts);
/// The plan of a body as it is now, which differs while pressure acts on a stretched hull.
SubstepPlan plan_substeps(const SoftBodyData &body, Real dt, bool has_contacts);

} // namespace softbody
