// SPDX-License-Identifier: MIT
// Contacts between soft bodies through a step: which pairs may touch, and what each pair has seen of it.
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

/// The bodies of a step as those who solve contacts between them see them. A body goes by its active index in the lists.
struct PairBodies {
	std::span<SolverBody> solver_bodies;
	std::span<const char> asleep; ///< not 0 for who sleeps
	std::span<const std::uint32_t> body_indices; ///< in the world, ascending
	WorldData &world;

	SoftBodyData &data(std::uint32_t active_index) const { return world.soft_bodies()[body_indices[active_index]]; }
};

/// Finds the pairs of a step, answers their contacts in each substep, on several threads where pairs share no body, and
/// keeps what a pair has seen until the step ends. A bounce that is still to be given back is kept by the bodies. Owns
/// nothing but scratch memory.
class PairContacts {
public:
	PairContacts();

	/// Begins another list of bodies, which `add_body` fills in the order of the active indices.
	void begin_arranging();
	void add_body(const BodySettings &settings);
	/// Whether anything that two of them do depends on how they spin.
	bool resists_rolling() const { return resists_rolling_; }

	/// Forgets the pairs and counts of the last step.
	void forget_step();
	/// Finds the pairs of the coming step of `dt` [s]. `version` tells whether the active indices still mean the same bodies.
	/// `separated`, in order, are not to collide, nor are collision exceptions. O(bodies) expected.
	void begin_step(const PairBodies &bodies, Real dt, std::uint64_t version, std::span<const BodyPair> separated,
			const ParallelFor &parallel_for);
	/// Whether any two bodies notice each other, or else nothing is looked for in this step.
	bool is_used() const { return is_used_; }
	/// Whether the body may touch another, of which one at least is awake.
	bool has_pair(std::uint32_t active_index) const { return is_used_ && has_pair_[active_index] != 0; }

	/// What holds for all substeps of `h` [s] of a turn.
	void begin_substeps(Real h);
	/// Solves the contacts of all pairs of the turn after a substep.
	void solve(const PairBodies &bodies, const SubstepGroup &group, const ParallelFor &parallel_for);
	/// Brakes spins by what pairs pressed on each other in all substeps, once their frames have been taken.
	void resist_rolling(const PairBodies &bodies);
	/// Leaves with the bodies what they must remember. After the last substep.
	void end_step(const PairBodies &bodies);

	/// The pairs of the step, and for each whether it touched.
	std::span<const BodyPair> pairs() const { return is_used_ ? broad_phase_.pairs() : std::span<const BodyPair>{}; }
	std::span<const char> touched() const { return touched_; }
	/// Contacts solved in the step.
	std::uint64_t contact_count() const;
	/// Those who answer, for their logs.
	std::span<PairContactSolver> solvers() { return solvers_; }

private:
	void recall_touches(const PairBodies &bodies);
	void find_exceptions(const PairBodies &bodies, std::span<const BodyPair> separated);

	BroadPhase broad_phase_;
	// One a task, so that no two threads share scratch memory.
	std::vector<PairContactSolver> solvers_;
	std::vector<std::uint64_t> contacts_;
	std::vector<BroadPhaseBody> boxes_; ///< one a active index
	std::vector<char> has_pair_; ///< likewise
	// One a pair.
	std::vector<char> touched_; ///< in this step
	std::vector<Real> impulses_; ///< likewise: summed normal impulse [mass·length/s]
	std::vector<PairTouch> touches_; ///< empty when nothing bounces
	struct Open {
		BodyPair pair;
		PairTouch touch;
	};
	std::vector<Open> open_; ///< of the last step
	std::vector<BodyPair> exceptions_; ///< sorted active indices
	Real h_ = 0;
	std::uint32_t layers_ = 0; ///< of all bodies
	std::uint32_t masks_ = 0;
	bool bounces_ = false;
	bool resists_rolling_ = false;
	bool is_used_ = false; ///< in this step
};

} // namespace softbody
