// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#pragma once

#include "core/base/error.h"
#include "core/base/parallel_for.h"
#include "core/collision/environment_contact_solver.h"
#include "core/collision/contact_monitor.h"
#include "core/collision/pair_contacts.h"
#include "core/collision/rigid_contacts.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/body_stepper.h"
#include "core/dynamics/contact_substeps.h"
#include "core/dynamics/joint_solver.h"
#include "core/dynamics/pin_motion.h"
#include "core/dynamics/rigid_neighbors.h"
#include "core/dynamics/sleep_watch.h"
#include "core/dynamics/step_profile.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// What one step did.
struct StepReport {
	Status refused; ///< set when `dt` was refused; then nothing moved
	std::uint64_t substeps = 0; ///< body-substeps, summed over bodies
	std::uint64_t contacts = 0; ///< contacts with the surroundings solved, summed over substeps
	std::uint64_t pair_contacts = 0; ///< contacts between bodies solved, summed over substeps
	std::size_t sleeping_bodies = 0; ///< after the step
	/// Bodies whose state became non-finite in this step, or that flew apart (CREDIBLE_REACH). Each was given its rest
	/// shape again, with the center, rotation and mean velocity that it had before, so that its next step starts
	/// sane; at rest if that velocity cannot be believed or a point is pinned. Pinned points stay. The others are
	/// untouched. Those whose settings say so (FailureResponse::FREEZE) are frozen from the next step on.
	std::vector<BodyId> reset_bodies;
	std::uint64_t self_contacts = 0; ///< contacts of bodies with themselves solved, summed over substeps
	/// Joints that bore more than they can (Joint::break_force) and are gone. Each is told once.
	std::vector<JointId> broken_joints;
	StepProfile profile;
};

/// Steps a world (thesis 4.4.2, "Simulator"). Bodies with nothing near them take their substeps one body after the
/// other. Bodies that may touch one another or a dynamic rigid body, or are joined to something, take contact substeps
/// together: the world's (more in a long step, see `substeps_of_step`), or as many as one of the island needs (`ContactSubsteps`). In
/// each of them every body advances, in as many force substeps as it needs, and then contacts between bodies are solved,
/// with dynamic rigid bodies, and joints. Owns nothing but scratch memory, which grows with the world.
/// Islands of bodies at rest fall asleep (`SleepWatch`).
class Simulator {
public:
	/// `world` must outlive the simulator. With `parallel_for` the work of a step is divided; its results are the
	/// same bits for any number of threads.
	explicit Simulator(WorldData &world, ParallelFor parallel_for = {}, Clock clock = {});
	Simulator(const Simulator &) = delete;
	Simulator &operator=(const Simulator &) = delete;

	/// Advances every body by `dt` [s], > 0 and finite. External forces act during the whole step and
	/// are then forgotten.
	StepReport simulate(Real dt);

	/// Every contact of the last step of a body that monitors (BodySettings::contact_monitor), as that body sees it: the
	/// same list for any number of threads, sorted by body, what it touches, and body index. What sleeps is not stepped and has
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
	// A step, in this order.
	void begin_step(Real dt);
	void find_rigid_contacts(Real dt);
	void divide_bodies(Real dt);
	void step_free(Real dt);
	void step_coupled(Real dt);
	void report_contacts(Real dt);
	void let_sleep();
	void collect(StepReport &report);

	/// Calls `work(stepper, batch, prefetch)` for the bodies of a list, ordered as `ActiveBodies::awake`, divided over the steppers.
	template <class Work>
	void for_batches(std::span<const std::uint32_t> list, const Work &work);
	void step_islands(int substeps, Real dt);
	void move_rigid_bodies_alone(Real dt);
	void measure_frames();
	void solve_self_contacts(std::span<const std::uint32_t> list, Real h);
	void resist_rolling_between_bodies();
	void check_touched_sleepers(Real dt);
	PairBodies pair_bodies() { return { bodies_.solver_bodies(), bodies_.resting(), bodies_.body_indices(), world_ }; }

	WorldData &world_;
	ParallelFor parallel_for_;
	Clock clock_;
	PhaseTimer timer_{ clock_ };
	StepProfile profile_; ///< of the present step
	ActiveBodies bodies_;
	ColliderIndex surroundings_;
	SleepWatch sleep_;
	PinMotion pin_motion_;
	PairContacts pair_contacts_;
	RigidContacts rigid_contacts_;
	std::uint64_t rigid_contact_count_ = 0;
	RigidNeighbors rigid_neighbors_;
	JointSolver joint_solver_;
	ContactMonitor contact_monitor_;
	std::vector<BodyStepper> steppers_; ///< one a task, so that no two threads share scratch memory

	// Active indices, ordered as `ActiveBodies::awake`.
	std::vector<std::uint32_t> free_; ///< bodies that meet no other body
	std::vector<std::uint32_t> coupled_; ///< bodies that may
	std::vector<std::uint32_t> group_; ///< coupled bodies that take as many contact substeps
	ContactSubsteps contact_substeps_;
	std::vector<std::uint32_t> beside_dynamic_; ///< active indices that may meet a dynamic rigid body, or are joined to one
	std::vector<BodyPair> joined_; ///< pairs that sleep and wake together without touching

	std::uint64_t seen_forces_ = 0;
	bool has_accelerated_bodies_ = false;
};

} // namespace softbody
