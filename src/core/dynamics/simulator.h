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
#include "core/dynamics/bounce_ledger.h"
#include "core/dynamics/contact_substeps.h"
#include "core/dynamics/island_report.h"
#include "core/dynamics/joint_solver.h"
#include "core/dynamics/pin_motion.h"
#include "core/dynamics/rigid_neighbors.h"
#include "core/dynamics/sleep_watch.h"
#include "core/dynamics/step_profile.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Results of one step.
struct StepReport {
	Status refused; ///< set if `dt` was refused; then nothing has moved
	std::uint64_t substeps = 0; ///< body substeps, summed over bodies
	std::uint64_t contacts = 0; ///< contacts with the environment solved, summed over substeps
	std::uint64_t pair_contacts = 0; ///< contacts between bodies solved, summed over substeps
	std::size_t sleeping_bodies = 0; ///< after the step
	/// Bodies whose state became non-finite in this step, or that flew apart (CREDIBLE_REACH). Each has got its rest
	/// shape again with its last center, rotation and mean velocity. It is at rest if that velocity is not credible or
	/// a point is pinned. Pinned points stay. Other bodies are not changed. Bodies with FailureResponse::FREEZE are
	/// frozen from the next step on.
	std::vector<BodyId> reset_bodies;
	std::size_t flying_bodies = 0; ///< that took the step as rigid ones (`WorldData::set_rigid_flight`)
	std::vector<BodyId> dented_bodies; ///< bodies whose rest shape has changed in this step (`PlasticFlow`)
	std::uint64_t self_contacts = 0; ///< contacts of bodies with themselves solved, summed over substeps
	/// Joints removed because they bore more than Joint::break_force. Each joint is reported once.
	std::vector<JointId> broken_joints;
	StepProfile profile;
	/// Contact substeps of each island and the contact error that they leave; empty unless `set_reporting_islands`.
	std::vector<IslandReport> islands;
};

/// Steps a world (thesis 4.4.2, "Simulator"). A body with no other body near takes its substeps independently of
/// others. Bodies that may touch one another or a dynamic rigid body, or that are joined to something, take contact
/// substeps together. Their number is that of the world (more in a long step, see `substeps_of_step`), or the largest
/// that a body of the island needs (`ContactSubsteps`). In each contact substep every body takes its force substeps;
/// then contacts between bodies, with dynamic rigid bodies, and joints are solved. Islands of bodies at rest fall
/// asleep (`SleepWatch`). Owns nothing but scratch memory, which grows with the world.
class Simulator {
public:
	/// `world` must outlive the simulator. `parallel_for` divides the work of a step. The results have the same bits
	/// for any number of threads.
	explicit Simulator(WorldData &world, ParallelFor parallel_for = {}, Clock clock = {});
	Simulator(const Simulator &) = delete;
	Simulator &operator=(const Simulator &) = delete;

	WorldData &world() { return world_; }
	const WorldData &world() const { return world_; }

	/// Advances every body by `dt` [s], > 0 and finite. External forces act during the whole step and are then cleared.
	StepReport simulate(Real dt);

	/// Whether each step measures its islands (`report_islands`), which takes more time than the step. False by default.
	/// Does not change how bodies move.
	void set_reporting_islands(bool reports) { reports_islands_ = reports; }
	bool is_reporting_islands() const { return reports_islands_; }

	/// Contacts of monitored bodies in the last step (BodySettings::contact_monitor), each from that body's side. The
	/// list does not depend on the number of threads. It is sorted by body, other side and place. A sleeping body has
	/// no contacts; its touches last. Valid until the next step.
	std::span<const Contact> contacts() const { return contact_monitor_.contacts(); }
	/// Touches of monitored bodies that the last step has begun or ended (see `ContactMonitor`), ends first. Each is
	/// reported once; a refused step reports none. Valid until the next step.
	std::span<const ContactEvent> contact_events() const { return contact_monitor_.events(); }
	/// Touches that have begun and not ended. Valid until the next step.
	std::span<const Touch> touches() const { return contact_monitor_.touches(); }

	/// Puts earlier touches back, sorted as they were: part of the state of a world. The contacts and events of the last step are
	/// forgotten.
	void put_back_touches(std::vector<Touch> touches) { contact_monitor_.put_back(std::move(touches)); }

	/// Lists the bodies that the last step left awake: neither asleep, nor frozen, nor inactive. O(awake bodies).
	void list_awake(std::vector<BodyId> &ids);

	/// Whether a body took the last step as a rigid one. O(log bodies).
	bool has_flown(BodyId id) const;

	/// The substeps that `simulate(dt)` would choose for a body by itself. A body that may touch another takes at least
	/// the contact substeps.
	SubstepPlan plan(const SoftBodyData &body, Real dt) const;

private:
	// The parts of a step, in order.
	void begin_step(Real dt);
	void find_rigid_contacts(Real dt);
	void divide_bodies(Real dt);
	void fly(Real dt);
	void step_free(Real dt);
	void step_coupled(Real dt);
	bool may_bounce();
	void report_contacts(Real dt);
	void let_sleep();
	void collect(StepReport &report);

	/// Calls `work(stepper, batch, prefetch)` for the bodies of a list, ordered as `ActiveBodies::awake`, divided among
	/// the steppers. `parts` as for `ActiveBodies::batch_at`; MAX_SUBSTEPS where no substep is taken.
	template <class Work>
	void for_batches(std::span<const std::uint32_t> list, int parts, const Work &work);
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
	StepProfile profile_; ///< of the current step
	ActiveBodies bodies_;
	ColliderIndex surroundings_;
	SleepWatch sleep_;
	PinMotion pin_motion_;
	PairContacts pair_contacts_;
	RigidContacts rigid_contacts_;
	std::uint64_t rigid_contact_count_ = 0;
	RigidNeighbors rigid_neighbors_;
	JointSolver joint_solver_;
	BounceLedger bounce_ledger_;
	ContactMonitor contact_monitor_;
	std::vector<BodyStepper> steppers_; ///< one for each task, so that no two threads share scratch memory

	// Active indices, ordered as `ActiveBodies::awake`.
	std::vector<std::uint32_t> free_; ///< bodies that meet no other body
	std::vector<std::uint32_t> coupled_; ///< bodies that take contact substeps
	std::vector<char> flown_; ///< for each active index, whether the body took the last step as a rigid one; empty if none could
	std::vector<std::uint32_t> group_; ///< bodies of `coupled_` in the current substep group
	ContactSubsteps contact_substeps_;
	std::vector<std::uint32_t> beside_dynamic_; ///< active indices of bodies that may meet a dynamic rigid body, or are joined to one
	std::vector<BodyPair> joined_; ///< pairs that sleep and wake together without touching

	std::uint64_t seen_forces_ = 0;
	std::uint64_t seen_restores_ = 0;
	bool had_colliders_ = true; ///< in the last step
	bool has_accelerated_bodies_ = false;
	bool reports_islands_ = false;
};

} // namespace softbody
