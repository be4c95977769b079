// SPDX-License-Identifier: MIT
// The per-body values that may change between steps: terms of the model, surface, integration.
#pragma once

#include "core/base/error.h"
#include "core/base/real.h"
#include "core/model/integrator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace softbody {

/// Treatment of a body whose state has become non-finite, or that has flown apart. Either way it gets its rest shape
/// back and is listed in StepReport::reset_bodies.
enum class FailureResponse : std::uint8_t {
	RESET, ///< it goes on; if the cause lasts, it is reset again in the next step
	FREEZE, ///< it is frozen (SoftBodyData::set_frozen), and so reported once
};
inline constexpr int FAILURE_RESPONSE_COUNT = 2;

/// Strains that leave a dent.
enum class DentBy : std::uint8_t {
	BOTH,
	COMPRESSION,
	TENSION,
};
inline constexpr int DENT_BY_COUNT = 3;

/// Coefficients of the body's model beyond its springs, and how it is stepped. A term with coefficient 0 is off.
struct BodySettings {
	/// Factors on the stiffness and damping of all springs of the shape [1], >= 0. Springs of stiffness 0 are not evaluated.
	Real spring_stiffness_scale = 1;
	Real spring_damping_scale = 1;
	/// Shear modulus μ of the elastic modes or triangles [force/length], >= 0; no effect without them. See `Material`.
	Real shear_modulus = 0;
	/// Poisson's ratio ν of the elastic modes [1], 0..0.49; not of triangles. `area_stiffness` resists the change of
	/// area.
	Real poisson_ratio = Real(0.45);
	/// Bulk modulus K of the hull's area [force/length], >= 0: energy K (A - inflation A0)² / (2 A0) for small changes,
	/// harder as the area goes to 0. A compliant constraint (XPBD, Macklin 2016), which takes no substeps. With elastic
	/// triangles it is the modulus of each triangle, by explicit forces, and takes substeps.
	Real area_stiffness = 0;
	/// Damping of elastic modes and area: time β for which strain rate counts as strain [s], >= 0 (Kelvin and Voigt).
	Real elastic_damping_time = 0;
	/// Share of the rest area above which the area is kept [1], 0..1; 0, the default, switches it off. See
	/// `keep_whole`.
	Real least_area = 0;
	/// Shares of its rest size between which the body as a whole is kept in any direction [1]: 0..1 and >= 1; 0 and
	/// infinity, the defaults, switch them off. See `keep_whole`.
	Real least_stretch = 0;
	Real most_stretch = std::numeric_limits<Real>::infinity();
	/// Strain of a spring's line beyond which the body's rest shape gives way [1], >= 0; 0, the default, switches dents off. See
	/// `PlasticFlow`. A body that may be dented is stepped alone.
	Real yield_strain = 0;
	/// Rate at which strain beyond the yield turns into a dent [1/s], >= 0.
	Real flow_rate = 30;
	/// Largest change of the length of a spring's line at rest, as a share of the first [1], 0..0.9.
	Real max_dent = Real(0.5);
	/// Strains that leave a dent.
	DentBy dent_by = DentBy::BOTH;
	/// Shape-matching stiffness k_s [force/length], >= 0. Each point of mass m is pulled towards its place in the
	/// best-fitting rigid copy of the rest shape with m k_s / mean(m). 0 switches the term off; then a folded body
	/// stays folded. About 0.4 of the springs' stiffness always recovers.
	Real shape_stiffness = 0;
	/// Damping of motion relative to the rigid motion [force·s/length], >= 0. It slows wobble, never flight or spin.
	Real shape_damping = 0;
	/// Pressure stiffness k_p [force/length], >= 0: the body pushes its hull outward with the pressure
	/// k_p (inflation - A/A0) (thesis 2.1.3). Without inner springs it is a balloon.
	Real pressure_stiffness = 0;
	/// Area that the pressure aims at, as a multiple of the rest area [1], >= 0. Above 1 inflates.
	Real inflation = 1;
	/// Axial stiffness EA of a chain at its widest section [force], > 0: a pull F stretches it by the share F / EA. Infinite, the
	/// default: its links keep their lengths under any load. No effect on other bodies, like the next three.
	Real axial_stiffness = std::numeric_limits<Real>::infinity();
	/// Bending stiffness EI of a chain at its widest section [force·length²], >= 0; it goes with the cube of the width. 0, the
	/// default: as limp as a rope of thread.
	Real bending_stiffness = 0;
	/// Damping of stretch and bending of a chain: time for which strain rate counts as strain [s], >= 0.
	Real chain_damping_time = 0;
	/// Share of its curvature as designed that a chain bends back to [1], 0..1. 0, the default: it is straight at rest.
	Real rest_bend = 0;
	/// Coulomb friction coefficient [1], >= 0. 0 slides, 1 holds a slope of 45 degrees.
	Real friction = Real(0.4);
	/// The body's friction counts even where the other side's is smaller. Of two that are rough the larger counts.
	bool rough = false;
	/// Rolling resistance [1], >= 0: a contact takes at most this times the normal impulse times the body's radius,
	/// over its inertia, of the spin. Without it a soft body on flat ground rocks for tens of
	/// seconds. On slopes up to about atan(r) it hardly rolls.
	Real rolling_resistance = 0;
	/// Least share of the approach speed with which the body leaves a surface [1], 0..1. Springs may return more.
	Real restitution = 0;
	/// The body's restitution is subtracted from that of the other side, at least 0, instead of added to it.
	bool absorbent = false;
	/// Factor on the world's gravity [1], any finite value.
	Real gravity_scale = 1;
	/// Decay of the velocity of the body as a whole [1/s], >= 0: by exp(-damp t), whatever the substeps. Springs and
	/// wobble are unaffected. The caller adds the damping of an environment (an area, water). Default 0: none.
	Real linear_damp = 0;
	/// Decay of the spin of the body as a whole [1/s], >= 0: by exp(-damp t). Default 0.
	Real angular_damp = 0;
	/// The method that advances the points; see `plan_substeps` for AUTOMATIC.
	Integrator integrator = Integrator::AUTOMATIC;
	/// Substeps a step, 1..MAX_SUBSTEPS, or 0 for the automatic rule (see `plan_substeps`).
	int substeps = 0;
	/// Whether the body may fly as a rigid one, if its world lets bodies do so (`WorldData::set_rigid_flight`).
	bool can_fly_rigid = true;
	/// Whether the body may fall asleep when its island has hardly moved for a while (see `Simulator`).
	bool can_sleep = true;
	/// Layers of the body. Two bodies touch when one's mask shares a bit with the other's layer.
	std::uint32_t collision_layer = 1;
	/// Environment and bodies that the body collides with: those whose layer shares a bit with this mask.
	std::uint32_t collision_mask = 0xffffffffu;
	/// Whether the body's contacts are listed and their beginnings and ends reported (see `Simulator::contacts`).
	/// Motion is not affected. A pile in which every body monitors takes about 1.15 times as long.
	bool contact_monitor = false;
	/// Whether the hull is kept from passing through itself, from outside (arms that close, a snake that curls) and
	/// from inside (a thin body pressed flat). Friction is the body's. Such a body is stepped on its own, in at least
	/// MIN_CONTACT_SUBSTEPS substeps; see `SelfCollision` for its cost. Default false: costs nothing.
	bool self_collision = false;

	/// Treatment of the body when it fails. Default RESET.
	FailureResponse failure_response = FailureResponse::RESET;

	/// Whether shape matching takes part.
	bool matches_shape() const { return shape_stiffness > 0 || shape_damping > 0; }
	/// Whether springs take part.
	bool has_springs() const { return spring_stiffness_scale > 0 || spring_damping_scale > 0; }
	/// Whether the elastic modes or triangles of the shape take part.
	bool is_elastic() const { return shear_modulus > 0; }
	/// Whether limits of area or stretch are on.
	bool has_limits() const { return least_area > 0 || least_stretch > 0 || most_stretch < std::numeric_limits<Real>::max(); }
	/// Whether forces depend on the body's orientation, so that its rotation is kept from step to step.
	bool turns_with_body() const { return matches_shape() || is_elastic(); }
	/// Whether strain may dent it.
	bool can_dent() const { return yield_strain > 0 && flow_rate > 0 && max_dent > 0; }
	/// Whether its motion as a whole is damped.
	bool has_damp() const { return linear_damp > 0 || angular_damp > 0; }

	friend bool operator==(const BodySettings &, const BodySettings &) = default;
};

/// Friction with a negative sign for a rough side, so that `combine_friction` needs no more than the two numbers.
inline Real signed_friction(Real friction, bool rough) {
	return rough ? -friction : friction;
}
/// The smaller friction counts, unless a side is rough; then the largest of the rough sides.
inline Real combine_friction(Real signed_a, Real signed_b) {
	return std::abs(std::min(signed_a, signed_b));
}
/// Restitution with a negative sign for an absorbent side. Sides add up; the sum is cut off at 0 and 1.
inline Real signed_restitution(Real restitution, bool absorbent) {
	return absorbent ? -restitution : restitution;
}

/// Refuses the first value outside its range, by name.
Status check_settings(const BodySettings &settings);

} // namespace softbody
