// SPDX-License-Identifier: MIT
// Contacts between soft bodies during a step: the pairs that may touch, and the memory of each pair.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/broad_phase.h"
#include "core/collision/substep_group.h"
#include "core/collision/pair_bounce.h"
#include "core/collision/pair_contact_solver.h"
#include "core/collision/pair_constraint.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// The bodies of a step for the solver of their contacts. All lists are indexed by active index.
struct PairBodies {
	std::span<SolverBody> solver_bodies;
	std::span<const char> asleep; ///< not 0 for a sleeping body
	std::span<const std::uint32_t> body_indices; ///< in the world, ascending
	WorldData &world;

	SoftBodyData &data(std::uint32_t active_index) const { return world.soft_bodies()[body_indices[active_index]]; }
};

/// Finds the pairs of a step and solves their contacts in each substep. Several threads work on pairs that share no
/// body. Keeps the memory of a pair until the step ends; the bodies keep bounces that are still to be given back. Owns
/// nothing but scratch memory.
class PairContacts {
public:
	PairContacts();

	/// Begins a new list of bodies, which `add_body` fills in the order of the active indices.
	void begin_arranging();
	void add_body(const BodySettings &settings);
	/// Whether rolling resistance acts between any two bodies.
	bool resists_rolling() const { return resists_rolling_; }

	/// Clears the pairs and counts of the last step.
	void forget_step();
	/// Finds the pairs of the coming step of `dt` [s]. `version` changes when active indices change their meaning.
	/// `separated`, sorted, are pairs that must not collide, in addition to collision exceptions. O(bodies) expected.
	void begin_step(const PairBodies &bodies, Real dt, std::uint64_t version, std::span<const BodyPair> separated,
			const ParallelFor &parallel_for);
	/// Whether any two bodies notice each other. If not, the step has no pairs.
	bool is_used() const { return is_used_; }
	/// Whether the body is in a pair, of which at least one body is awake.
	bool has_pair(std::uint32_t active_index) const { return is_used_ && has_pair_[active_index] != 0; }

	/// Prepares the substeps of `h` [s] of a substep group.
	void begin_substeps(Real h);
	/// Solves the contacts of all pairs of the group after a substep, which `substeps_left` others follow in this step.
	void solve(const PairBodies &bodies, const SubstepGroup &group, int substeps_left, const ParallelFor &parallel_for);
	/// Applies rolling resistance by the impulses of all substeps, once the frames of the bodies have been taken.
	void resist_rolling(const PairBodies &bodies);
	/// Stores the memory of pairs in the bodies. Call it after the last substep.
	void end_step(const PairBodies &bodies);

	/// Pairs of the step. `touched` tells for each pair whether it touched.
	std::span<const BodyPair> pairs() const { return is_used_ ? broad_phase_.pairs() : std::span<const BodyPair>{}; }
	std::span<const char> touched() const { return touched_; }
	/// Whether any body has restitution.
	bool bounces() const { return bounces_; }
	/// The touch of each pair; empty when nothing bounces.
	std::span<PairTouch> touches() { return is_used_ && bounces_ ? std::span<PairTouch>(touches_) : std::span<PairTouch>(); }
	/// Number of contacts solved in the step.
	std::uint64_t contact_count() const;
	/// The solvers, for their logs.
	std::span<PairContactSolver> solvers() { return solvers_; }

private:
	void begin_bounces(const PairBodies &bodies);
	void recall_touches(const PairBodies &bodies);
	void find_exceptions(const PairBodies &bodies, std::span<const BodyPair> separated);

	BroadPhase broad_phase_;
	// One for each task, so that no two threads share scratch memory.
	std::vector<PairContactSolver> solvers_;
	std::vector<std::uint64_t> contacts_;
	std::vector<BroadPhaseBody> circles_; ///< one for each active index
	std::vector<char> has_pair_; ///< one for each active index
	// One for each pair.
	std::vector<char> touched_; ///< in this step
	std::vector<PairCandidates> candidates_;
	std::vector<Real> impulses_; ///< summed normal impulse in this step [mass·length/s]
	std::vector<PairTouch> touches_; ///< empty when nothing bounces
	struct Open {
		BodyPair pair;
		PairTouch touch;
	};
	std::vector<Open> open_; ///< of the last step, by first body
	std::vector<std::uint32_t> open_begins_; ///< index in `open_` of a first body's first touch; one more than bodies
	std::vector<BodyPair> exceptions_; ///< sorted active indices
	Real h_ = 0;
	std::uint32_t layers_ = 0; ///< of all bodies together
	std::uint32_t masks_ = 0;
	bool bounces_ = false;
	bool resists_rolling_ = false;
	bool is_used_ = false; ///< in this step
};

} // namespace softbody
