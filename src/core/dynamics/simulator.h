// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#pragma once

#include "core/base/error.h"
#include "core/base/parallel_for.h"
#include "core/collision/collision_handling.h"
#include "core/collision/contact_monitor.h"
#include "core/collision/pair_contacts.h"
#include "core/collision/rigid_contacts.h"
#include "core/collision/surroundings_watch.h"
#include "core/dynamics/body_stepper.h"
#include "core/dynamics/heap_substeps.h"
#include "core/dynamics/joint_solver.h"
#include "core/dynamics/pin_motion.h"
#include "core/dynamics/roster.h"
#include "core/dynamics/sleepers.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// What one step did.
struct StepReport {
	Status refused; ///< set when `dt` was refused; then nothing moved
	std::uint64_t substeps = 0; ///< body-substeps, summed over bodies
	std::uint64_t contacts = 0; ///< contacts with the surroundings answered, summed over substeps
	std::uint64_t pair_contacts = 0; ///< contacts between bodies answered, summed over substeps
	std::size_t sleeping_bodies = 0; ///< after the step
	/// Bodies whose state became non-finite in this step, or that flew apart (CREDIBLE_REACH). Each was given its rest
	/// shape again, with the centre, rotation and mean velocity that it had before, so that its next step starts
	/// sane; at rest if that velocity cannot be believed or a point is pinned. Pinned points stay. The others are
	/// untouched. Those whose settings say so (FailureResponse::FREEZE) are frozen from the next step on.
	std::vector<BodyId> reset_bodies;
	std::uint64_t self_contacts = 0; ///< contacts of bodies with themselves answered, summed over substeps
	/// Joints that bore more than they can (Joint::break_force) and are gone. Each is told once.
	std::vector<JointId> broken_joints;
};

/// Steps a world (thesis 4.4.2, "Simulator"). Bodies with nothing near them take their substeps one body after the
/// other. Bodies that may touch one another or a dynamic rigid body, or are joined to something, take contact substeps
/// together: the world's (more in a long step, see `substeps_of_step`), or as many as one of the heap needs (`HeapSubsteps`). In
/// each of them every body advances, in as many force substeps as it needs, and then contacts between bodies are answered,
/// with dynamic rigid bodies, and joints. Owns nothing but scratch memory, which grows with the world.
/// Islands of bodies at rest fall asleep (`Sleepers`).
class Simulator {
public:
	/// `world` must outlive the simulator. With `parallel_for` the work of a step is divided; its results are the
	/// same bits for any number of threads.
	explicit Simulator(WorldData &world, ParallelFor parallel_for = {});

	/// Advances every body by `dt` [s], > 0 and finite. External forces act during the whole step and
	/// are then forgotten.
	StepReport simulate(Real dt);

	/// Every contact of the last step of a body that monitors (BodySettings::contact_monitor), as that body sees it: the
	/// same list for any number of threads, sorted by body, what it touches, and place. What sleeps is not stepped and has
	/// none; its touches last. Valid until the next step.
	std::span<const Contact> contacts() const { return contact_monitor_.contacts(); }
	/// Which touches of such bodies the last step has begun or ended (see `ContactMonitor`): first the ends. Each is
	/// told once, so that a step that is refused tells nothing. Valid until the next step.
	std::span<const ContactEvent> contact_events() const { return contact_monitor_.events(); }
	/// The touches that have begun and not ended. Valid until the next step.
	std::span<const Touch> touches() const { return contact_monitor_.touches(); }

	/// What `simulate(dt)` would choose for a body. One that may touch another takes at least the contact substeps.
	SubstepPlan plan(const SoftBodyData &body, Real dt) const;

private:
	static constexpr std::uint32_t NO_OWN_PLANS = UINT32_MAX;
	/// Where a crew's bodies stand in the lists below, how they are stepped, and which of them are awake.
	struct CrewState {
		SubstepPlan plan;
		std::array<std::uint32_t, PACK_WIDTH> rows{}; ///< of `touching_`
		std::uint32_t awake = 0; ///< a bit a lane
		std::uint32_t coupled = 0; ///< likewise: who takes contact substeps, with the rest of a heap
		std::uint32_t turn = ALL_LANES; ///< likewise: who takes part in the present pass
		std::uint32_t stepped() const { return awake & turn; }
		std::uint32_t kind = 0; ///< the same for crews in a row that `move_alike`
		std::uint32_t own_plans = NO_OWN_PLANS; ///< place in `own_plans_` where lanes differ in this step
		const SubstepPlan &plan_of(std::uint32_t lane, const auto &all) const {
			return own_plans == NO_OWN_PLANS ? plan : all[own_plans][lane];
		}
	};

	/// True when something was arranged anew.
	bool arrange(Real dt);
	void plan_pressure(Real dt);
	void find_rigid_contacts(Real dt);
	void move_rigid_bodies_alone(Real dt);
	void divide_crews(Real dt);
	void choose_contact_substeps(Real dt);
	int needed_substeps(const CrewState &crew, std::uint32_t lane, int least) const;
	bool may_be_divided(const CrewState &crew, std::uint32_t lane) const;
	std::optional<int> common_need(int least) const;
	void find_heaps(int least);
	void leave_free();
	PairBodies pair_bodies() { return { touching_, sleepers_.flags(), places_, world_ }; }
	/// One of `parts` equal stretches of the step, each body in its share of the substeps that it needs.
	struct Stretch {
		Real elapsed = 0; ///< since the step began [s]
		Real duration = 0; ///< [s]
		int parts = 1;
		bool is_coupled = false;
	};
	void advance(BodyStepper &stepper, std::uint32_t crew, const Stretch &stretch);
	void advance_both(BodyStepper &stepper, std::uint32_t a, std::uint32_t b, const Stretch &stretch, StateAhead &ahead);
	bool move_alike_now(std::uint32_t a, std::uint32_t b) const;
	SweptFrom swept_from(std::uint32_t crew, const Stretch &stretch) const;
	void measure_extents(std::uint32_t crew);
	void step_coupled(Real dt);
	void step_heaps(int substeps, Real dt);
	void measure_frames();
	void answer_self_contacts(Real h);
	void resist_rolling_between_bodies();
	void check_touched_sleepers(Real dt);
	void take_over_sleepers(bool is_rearranged);
	/// Called when a body falls asleep or wakes.
	void note_awake(std::uint32_t row, bool awake);
	void wake_by_surroundings();
	Aabb rest_box(std::uint32_t row) const;
	void wake_by_frozen_bodies();
	void wake_in(std::span<const Aabb> boxes);
	void let_sleep();
	/// Calls `work(stepper, crew index)` for every crew in the list, divided over the steppers.
	template <class Work>
	void for_crews(std::span<const std::uint32_t> crews, const Work &work);
	/// The same, with every crew advanced between `before(stepper, crew index)` and `after`, likewise.
	template <class Before, class After>
	void advance_crews(std::span<const std::uint32_t> crews, const Stretch &stretch, const Before &before,
			const After &after);
	void report_contacts(Real dt);
	void collect(StepReport &report);

	WorldData &world_;
	ParallelFor parallel_for_;
	Roster roster_;
	SurroundingsIndex surroundings_;
	SurroundingsWatch watch_;
	PairContacts pair_contacts_;
	RigidContacts rigid_contacts_;
	std::uint64_t rigid_contact_count_ = 0;
	ContactMonitor contact_monitor_;
	std::vector<BodyStepper> steppers_; ///< one a task, so that no two threads share scratch memory

	std::vector<CrewState> crews_; ///< one a crew of the roster
	std::vector<std::array<SubstepPlan, PACK_WIDTH>> own_plans_;
	std::vector<std::uint32_t> pressed_crews_; ///< those with pressure
	std::vector<std::uint32_t> free_crews_;
	std::vector<std::uint32_t> coupled_crews_;
	std::vector<std::uint32_t> turn_crews_; ///< those of them whose turn it is
	HeapSubsteps heap_substeps_;
	std::vector<std::uint32_t> beside_dynamic_; ///< rows near a dynamic rigid body, or joined to one
	int rigid_substeps_ = 0; ///< in how many the dynamic rigid bodies move; 0: nobody is near
	// One an active body.
	std::vector<TouchingBody> touching_;
	std::vector<Vec2> before_; ///< hull points of all bodies at the start of a contact substep
	std::vector<Vec2> swept_from_; ///< hull points of all bodies when they last had looked at the surroundings
	std::vector<std::size_t> first_hull_point_; ///< in the two above
	std::vector<char> has_rigid_body_; ///< near it; empty when nothing can be pushed
	std::vector<char> restless_; ///< who is near one that is awake; likewise
	std::vector<std::pair<std::uint32_t, std::uint32_t>> beside_rigid_; ///< rigid bodies and the rows near them, in order
	std::vector<std::uint32_t> near_colliders_;
	std::vector<BodyPair> joined_; ///< who sleeps and wakes together without touching
	std::vector<std::uint32_t> places_; ///< in the world, ascending
	std::vector<std::uint32_t> row_of_; ///< the other way round
	std::vector<std::uint32_t> crew_of_;
	Sleepers sleepers_;
	std::size_t frozen_count_ = 0;
	PinMotion pin_motion_;
	JointSolver joint_solver_;

	std::uint64_t seen_forces_ = 0;
	std::uint64_t seen_restores_ = 0;
	std::uint64_t arranged_roster_ = 0;
	Real arranged_dt_ = 0;
	bool arranged_with_contacts_ = false;
	bool has_accelerated_bodies_ = false;
	bool has_monitored_bodies_ = false;
	bool bodies_meet_themselves_ = false;
};

} // namespace softbody
