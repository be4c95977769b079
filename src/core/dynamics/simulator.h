// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/collision/collision_handling.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <vector>

namespace softbody {

/// What one step did.
struct StepReport {
	Status refused; ///< set when `dt` was refused; then nothing moved
	std::uint64_t substeps = 0; ///< body-substeps, summed over bodies
	std::uint64_t contacts = 0; ///< contacts answered, summed over substeps
	/// Bodies whose state became non-finite in this step, or that flew apart (CREDIBLE_REACH). Each was given its rest shape again, with the centre,
	/// rotation and mean velocity that it had before the step, so that its next step starts sane; at rest if
	/// that velocity cannot be believed or a point is pinned. Pinned points stay. The others are untouched.
	std::vector<BodyId> reset_bodies;
};

/// Steps a world (thesis 4.4.2, "Simulator"): per body and substep it evaluates forces, integrates,
/// and answers contacts with the surroundings. Owns nothing but scratch memory, which grows to the
/// largest body and then stays: a step allocates nothing once warm.
class Simulator {
public:
	/// `world` must outlive the simulator.
	explicit Simulator(WorldData &world) : world_(world), collision_(world) {}

	/// Advances every body by `dt` [s], > 0 and finite. External forces act during the whole step and
	/// are then forgotten.
	StepReport simulate(Real dt);

	/// What `simulate(dt)` would choose for a body.
	SubstepPlan plan(const SoftBodyData &body, Real dt) const;

private:
	void simulate_body(SoftBodyData &body, BodyId id, Real dt, StepReport &report);

	WorldData &world_;
	CollisionHandling collision_;
	IntegratorWorkspace workspace_;
	std::vector<Vec2> external_;
	std::vector<Vec2> before_; ///< positions at the start of the substep
};

} // namespace softbody
