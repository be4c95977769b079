// SPDX-License-Identifier: MIT
// Advances batches of bodies through a time slice of a step: forces, integration, environment.
#pragma once

#include "core/collision/environment_contact_solver.h"
#include "core/collision/self_collision.h"
#include "core/dynamics/batch.h"
#include "core/dynamics/chain_stepper.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/dynamics/lane_stepper.h"
#include "core/dynamics/plastic_flow.h"
#include "core/dynamics/state_prefetch.h"
#include "core/dynamics/step_context.h"
#include "core/model/body_frame.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Counts of a stepper since the step began.
struct StepCounts {
	std::uint64_t substeps = 0; ///< body substeps
	std::uint64_t contacts = 0; ///< contacts with the environment solved
	std::uint64_t self_contacts = 0; ///< contacts of bodies with themselves solved
	std::vector<std::uint32_t> non_finite; ///< body indices of the bodies that were reset
	std::vector<std::uint32_t> dented; ///< body indices of the bodies whose rest shape has changed
};

/// Steps batches of bodies. One object serves one thread. It owns nothing but scratch memory, which grows to the
/// largest body. The bits of a body do not depend on how many bodies share its batch.
class BodyStepper {
public:
	void begin_step(const StepContext &context);
	/// Largest number of bodies in a batch.
	std::size_t width() const { return wide_ != nullptr ? WIDE_WIDTH : PACK_WIDTH; }

	/// Stores the positions at the start of the step, for interpolation.
	void begin(const Batch &batch);
	/// Advances every body of the batch by its substeps of the slice, each ended by the contacts with the environment.
	/// Resets bodies that are no longer finite or that flew apart (CREDIBLE_REACH). After a coupled slice, in this
	/// step or the last, the path of a body starts where its contacts with colliders were last solved. A coupled slice ends by measuring
	/// extents (`SolverBody::measure_extent`). Prefetches all of `prefetch` meanwhile.
	void advance(const Batch &batch, const TimeSlice &slice, StatePrefetch &prefetch);
	/// Moves the bodies of a batch that may fly as rigid ones through a whole step of `dt` [s], rest times included, and returns the bit
	/// mask of their lanes. The others are as they were. The bodies must meet no other body in the step. In rigid_flight.cpp.
	std::uint32_t fly(const Batch &batch, Real dt);
	/// Forgets what had pushed bodies that nothing pushes any more (SoftBodyData::last_valid_hull).
	void forget_pushes(const Batch &batch);
	/// Solves the contacts of a body with itself, after other bodies have pushed it in a substep of `h` [s].
	void solve_self_contacts(std::uint32_t active_index, Real h);
	/// Adds `dt` [s] to the rest time of the bodies that hardly move, and sets that of the others to 0. Slows bodies
	/// that may fall asleep soon.
	void time_rest(const Batch &batch, Real dt);
	/// Measures the frames of a batch's bodies.
	std::array<BodyFrame, WIDE_WIDTH> measure_frames(const Batch &batch);
	/// Stores rotations for shape matching, which reads them if a shape no longer defines its rotation.
	void remember_rotations(const Batch &batch, std::span<const BodyFrame> frames);
	/// Clears external forces.
	void end(const Batch &batch);
	/// Resets a body that is no longer finite. For use after other code than `advance` has moved it.
	void check(std::uint32_t body_index, Real dt);

	StepCounts &counts() { return counts_; }
	/// Contacts of monitored bodies with the environment since the log was last cleared.
	ContactLog &log() { return collision_.log(); }

private:
	/// Advances the body in one lane by itself.
	void advance_one(const Batch &batch, std::size_t lane, const TimeSlice &slice);
	/// Advances a body that is an open chain.
	void advance_chain(const Batch &batch, std::size_t lane, const TimeSlice &slice);
	/// Advances a batch in SIMD lanes.
	void advance_lanes(const Batch &batch, const TimeSlice &slice, StatePrefetch &prefetch);
	bool can_use_lanes(const Batch &batch) const;
	LaneStepper &lanes_for(const Batch &batch) { return batch.count == WIDE_WIDTH ? *wide_ : *narrow_; }
	/// Bit mask of the lanes with contacts that lanes cannot solve: with colliders nearby, or of points that bounce by themselves.
	std::uint32_t lanes_solved_alone(const Batch &batch, const TimeSlice &slice);
	bool may_bounce_on_borders(const Batch &batch) const;
	/// Stores the state of a body at the start of a slice.
	void keep_start(const Batch &batch, std::size_t lane);
	void restore_start(const Batch &batch, std::size_t lane) const;
	/// Hull points where the path of a body through the environment starts; null for its present position.
	const Vec2 *sweep_start(std::uint32_t active_index, std::uint32_t body_index, const TimeSlice &slice);
	void reset(std::uint32_t body_index, Real dt);
	SoftBodyData &body(std::uint32_t body_index) const { return context_->world.soft_bodies()[body_index]; }

	std::optional<StepContext> context_;
	EnvironmentContactSolver collision_;
	SelfCollision self_collision_;
	PlasticFlow plastic_flow_;
	ChainStepper chain_stepper_;
	StepCounts counts_;
	IntegratorWorkspace workspace_;
	std::vector<Vec2> external_;
	std::vector<Vec2> load_; ///< external forces with the body's own load, in one substep
	std::vector<Vec2> start_; ///< positions and velocities at the start of a slice, one lane after the other
	std::vector<Vec2> before_; ///< positions at the start of the substep
	std::vector<Vec2> hull_before_; ///< hull points at the start of the substep, of a body that collides with itself
	std::vector<std::uint32_t> near_colliders_; ///< of a body that could fly as a rigid one
	std::vector<Vec2> limited_; ///< state of a body while its limits are kept
	std::unique_ptr<LaneStepper> narrow_ = make_narrow_stepper();
	std::unique_ptr<LaneStepper> wide_ = make_wide_stepper(); ///< may be null
};

} // namespace softbody
