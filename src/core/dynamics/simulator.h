// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#pragma once

#include "core/base/error.h"
#include "core/base/parallel_for.h"
#include "core/collision/broad_phase.h"
#include "core/collision/collision_handling.h"
#include "core/collision/pair_handling.h"
#include "core/collision/rigid_contacts.h"
#include "core/dynamics/body_stepper.h"
#include "core/dynamics/roster.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// What one step did.
struct StepReport {
	Status refused; ///< set when `dt` was refused; then nothing moved
	std::uint64_t substeps = 0; ///< body-substeps, summed over bodies
	std::uint64_t contacts = 0; ///< contacts with the surroundings answered, summed over substeps
	std::uint64_t pair_contacts = 0; ///< contacts between bodies answered, summed over substeps
	/// Bodies whose state became non-finite in this step. Each was put back to where it was before the
	/// step, at rest; the others are untouched.
	std::vector<BodyId> reset_bodies;
};

/// Steps a world (thesis 4.4.2, "Simulator"). Bodies with nothing near them take their substeps one body after the
/// other. Bodies that may touch one another or a dynamic rigid body take the world's contact substeps together: in each of them every
/// body advances, in as many force substeps as it needs, and then contacts between bodies are answered, and those with
/// dynamic rigid bodies. Owns nothing but
/// scratch memory, which grows with the world and then stays: a step allocates nothing once warm.
class Simulator {
public:
	/// `world` must outlive the simulator. With `parallel_for` the work of a step is divided; its results are the
	/// same bits for any number of threads.
	explicit Simulator(WorldData &world, ParallelFor parallel_for = {});

	/// Advances every body by `dt` [s], > 0 and finite. External forces act during the whole step and
	/// are then forgotten.
	StepReport simulate(Real dt);

	/// What `simulate(dt)` would choose for a body. One that may touch another takes at least the contact substeps.
	SubstepPlan plan(const SoftBodyData &body, Real dt) const;

private:
	/// Where a crew's bodies stand in the lists below, and whether they take their substeps together with others.
	struct CrewState {
		SubstepPlan plan;
		std::array<std::uint32_t, PACK_WIDTH> rows{}; ///< of `touching_`
		bool is_coupled = false;
	};

	void arrange(Real dt);
	void find_pairs(Real dt);
	void find_rigid_contacts(Real dt);
	void step_coupled(Real dt);
	void answer_pairs();
	void move_rigid_bodies_alone(Real dt);
	/// Calls `work(stepper, crew index)` for every crew in the list, divided over the steppers.
	template <class Work>
	void for_crews(std::span<const std::uint32_t> crews, const Work &work);
	void collect(StepReport &report);

	WorldData &world_;
	ParallelFor parallel_for_;
	Roster roster_;
	SurroundingsIndex surroundings_;
	BroadPhase broad_phase_;
	// One a task, so that no two threads share scratch memory.
	std::vector<BodyStepper> steppers_;
	std::vector<PairHandling> pair_handlings_;
	std::vector<std::uint64_t> pair_contacts_;
	RigidContacts rigid_contacts_;
	std::uint64_t rigid_contact_count_ = 0;

	std::vector<CrewState> crews_; ///< one a crew of the roster
	std::vector<std::uint32_t> free_crews_;
	std::vector<std::uint32_t> coupled_crews_;
	// One an active body.
	std::vector<TouchingBody> touching_;
	std::vector<BroadPhaseBody> broad_;
	std::vector<char> has_pair_;
	std::vector<char> has_rigid_body_; ///< near it; empty when nothing can be pushed

	std::uint64_t seen_forces_ = 0;
	std::uint64_t arranged_roster_ = 0;
	Real arranged_dt_ = 0;
	bool arranged_with_contacts_ = false;
	bool bodies_notice_bodies_ = false;
};

} // namespace softbody
