// SPDX-License-Identifier: MIT
// Advances bodies through one step, alone or side by side: forces, integration, surroundings.
#pragma once

#include "core/base/pack.h"
#include "core/collision/environment_contact_solver.h"
#include "core/collision/self_collision.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/dynamics/batch_builder.h"
#include "core/dynamics/state_prefetch.h"
#include "core/dynamics/substep_plan.h"
#include "core/dynamics/wide_stepper.h"
#include "core/model/body_frame.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace softbody {

/// What a stepper did since it was last asked.
struct StepCounts {
	std::uint64_t substeps = 0; ///< body-substeps
	std::uint64_t contacts = 0; ///< contacts with the surroundings solved
	std::uint64_t self_contacts = 0; ///< contacts of bodies with themselves solved
	std::vector<std::uint32_t> non_finite; ///< body indices of bodies that had to be reset
};

/// For every lane the hull's points, or null.
using SweepStarts = std::array<const Vec2 *, PACK_WIDTH>;

/// Steps the bodies of a batch. One object serves one thread; it owns nothing but scratch memory, which grows to
/// the largest body and then stays.
class BodyStepper {
public:
	/// `world` and `surroundings` must outlive the stepper's use. `has_forces`: whether any body has queued forces.
	void begin_step(WorldData &world, const ColliderIndex &surroundings, bool has_forces);

	/// Keeps the positions from which the step starts. Bit l of `lanes` tells, here and below, whether lane l takes part.
	void begin(const Batch &batch, std::uint32_t lanes);
	/// Advances by `duration` [s], `elapsed` [s] after the step began, in `substeps` substeps of the plan's method, each
	/// ended by the contacts with the surroundings. Resets what is no longer finite, or whole (CREDIBLE_REACH).
	/// `sweep_start`: where each body's hull last had been moved out of the surroundings, if it has been pushed since;
	/// what then lies between counts as its way. Null: where it is. Contacts of bodies with themselves end each substep
	/// too, unless `are_coupled`: then other bodies have yet to push them.
	void advance(Batch &batch, std::uint32_t lanes, const SubstepPlan &plan, Real elapsed, Real duration, int substeps,
			const SweepStarts &sweep_start = {}, bool are_coupled = false);
	/// The same for all bodies of two batches that `move_alike`, both at once where that can be done. Asks for `prefetch` meanwhile.
	/// Whether the extents of `solver_bodies`, unless all are null, have been measured as well.
	bool advance_both(const std::array<Batch *, 2> &batches, const SubstepPlan &plan, Real elapsed, Real duration,
			int substeps, const std::array<SweepStarts, 2> &sweep_start, bool are_coupled,
			const std::array<SolverBody *, WIDE_WIDTH> &solver_bodies, StatePrefetch &prefetch);
	/// Solves the contacts of a body with itself, after other bodies have pushed it in a substep of `h` [s] that started
	/// with its hull at `before`.
	void solve_self_contacts(std::uint32_t body_index, std::span<const Vec2> before, Real h);
	/// Adds `dt` [s] to the time at rest of the bodies that hardly move, and starts that of the others anew.
	void time_rest(const Batch &batch, std::uint32_t lanes, Real dt);
	/// The frames of a batch's bodies.
	std::array<BodyFrame, PACK_WIDTH> measure_frames(const Batch &batch);
	/// Keeps their rotations, as what shape matching takes where the shape no longer tells.
	void remember_rotations(const Batch &batch, std::uint32_t lanes, const std::array<BodyFrame, PACK_WIDTH> &frames);
	/// Forgets external forces.
	void end(const Batch &batch, std::uint32_t lanes);
	/// Resets the bodies that are no longer finite, after something else than `advance` has moved them.
	void check(const Batch &batch, std::uint32_t lanes, Real dt);

	StepCounts &counts() { return counts_; }
	/// Contacts of monitored bodies with the surroundings, since it was last cleared.
	ContactLog &log() { return collision_.log(); }

private:
	void advance_alone(std::uint32_t body_index, const SubstepPlan &plan, Real elapsed, Real duration, int substeps,
			const Vec2 *sweep_start, bool is_coupled);
	/// A full batch's bodies side by side, in scratch memory that the next call overwrites.
	BodyLanes<RealPack> gather_lanes(const Batch &batch);
	/// A full batch in which others stand in for the bodies that are not of `lanes`, until the next call.
	Batch with_stand_ins(const Batch &batch, std::uint32_t lanes);
	/// Lanes of `solved_alone` meet the surroundings one after the other in each substep.
	void advance_side_by_side(Batch &batch, std::uint32_t taking_part, std::uint32_t solved_alone, const SubstepPlan &plan,
			Real duration, int substeps, const SweepStarts &sweep_start, bool are_coupled);
	/// Between two substeps: each of those lanes as it is in `lanes`, and back. How many contacts each had.
	RealPack solve_alone(const Batch &batch, std::uint32_t solved_alone, const BodyLanes<RealPack> &lanes, Real h,
			const SweepStarts &sweep_start);
	/// Which lanes, of those taking part, have more to do with the surroundings than lie on borders that do not bounce: near
	/// these, in a touch.
	std::uint32_t lanes_solved_alone(const Batch &batch, std::uint32_t taking_part, Real elapsed, Real duration);
	/// False, and nothing has changed, where it cannot be done.
	bool advance_wide(const std::array<Batch *, 2> &batches, const SubstepPlan &plan, Real duration, int substeps,
			const std::array<SolverBody *, WIDE_WIDTH> &solver_bodies, StatePrefetch &prefetch);
	/// Brings those of the lanes that are crushed or drawn out back within their limits.
	void keep_whole_in_lanes(const Batch &batch, std::uint32_t taking_part, std::uint32_t crushed,
			const BodyLanes<RealPack> &lanes, Real h, bool bears_load);
	void advance_one_by_one(Batch &batch, std::uint32_t lanes, const SubstepPlan &plan, Real elapsed, Real duration,
			int substeps, const SweepStarts &sweep_start, bool are_coupled);
	bool can_go_side_by_side(const Batch &batch, std::uint32_t lanes, const SubstepPlan &plan) const;
	void reset(std::uint32_t body_index, Real dt);
	SoftBodyData &body(std::uint32_t body_index) const { return world_->soft_bodies()[body_index]; }

	WorldData *world_ = nullptr;
	const ColliderIndex *surroundings_ = nullptr;
	bool has_forces_ = false;
	bool borders_bounce_ = false;
	EnvironmentContactSolver collision_;
	SelfCollision self_collision_;
	StepCounts counts_;
	IntegratorWorkspace workspace_;
	std::vector<Vec2> external_;
	std::vector<Vec2> load_; ///< with what acts on the body as a whole, in a substep
	std::vector<Vec2> start_; ///< positions, then velocities, at the start of `advance`
	std::vector<Vec2> before_; ///< positions at the start of the substep
	std::vector<Vec2> hull_before_; ///< likewise, of the hull of a body that meets itself
	BasicWorkspace<RealPack> pack_workspace_;
	std::vector<BasicVec2<RealPack>> pack_positions_;
	std::vector<BasicVec2<RealPack>> pack_velocities_;
	std::vector<Vec2> limited_; ///< of a body whose limits are kept
	std::vector<Vec2> stand_ins_;
	std::vector<BasicVec2<RealPack>> pack_start_; ///< positions, then velocities, where bodies do not keep them
	std::unique_ptr<WideStepper> wide_ = make_wide_stepper();
};

} // namespace softbody
