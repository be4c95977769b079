// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#pragma once

#include "core/base/error.h"
#include "core/base/parallel_for.h"
#include "core/collision/collision_handling.h"
#include "core/dynamics/body_stepper.h"
#include "core/dynamics/roster.h"
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
	/// Bodies whose state became non-finite in this step. Each was put back to where it was before the
	/// step, at rest; the others are untouched.
	std::vector<BodyId> reset_bodies;
};

/// Steps a world (thesis 4.4.2, "Simulator"): per substep it evaluates forces, integrates, and answers contacts
/// with the surroundings. Owns nothing but scratch memory, which grows to the largest body and then stays: a step
/// allocates nothing once warm.
class Simulator {
public:
	/// `world` must outlive the simulator. With `parallel_for` the work of a step is divided; its results are the
	/// same bits for any number of threads.
	explicit Simulator(WorldData &world, ParallelFor parallel_for = {});

	/// Advances every body by `dt` [s], > 0 and finite. External forces act during the whole step and
	/// are then forgotten.
	StepReport simulate(Real dt);

	/// What `simulate(dt)` would choose for a body.
	SubstepPlan plan(const SoftBodyData &body, Real dt) const;

private:
	void update_plans(Real dt);
	/// Calls `work(stepper, crew index)` for every crew, divided over the steppers.
	template <class Work>
	void for_all_crews(const Work &work);
	void collect(StepReport &report);

	WorldData &world_;
	ParallelFor parallel_for_;
	Roster roster_;
	SurroundingsIndex surroundings_;
	std::vector<BodyStepper> steppers_; ///< one a task, so that no two threads share scratch memory
	std::vector<SubstepPlan> plans_; ///< one a crew
	std::uint64_t seen_forces_ = 0;
	std::uint64_t planned_roster_ = 0;
	Real planned_dt_ = 0;
	bool planned_with_contacts_ = false;
};

} // namespace softbody
