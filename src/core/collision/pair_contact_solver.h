// SPDX-License-Identifier: MIT
// Contacts of soft bodies with one another.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/collision/contact_log.h"
#include "core/collision/hull_contact.h"
#include "core/collision/near_edges.h"
#include "core/collision/pair_candidates.h"
#include "core/collision/pair_constraint.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Finds and solves the contacts of pairs of bodies, each hull point against the other's hull edges. One object serves
/// one thread; several threads may work at once on pairs that share no body.
///
/// If two bodies move far in a substep (SWEEP_SHARE), each point is also swept through the moving edges, so that
/// nothing passes through. Crossing bodies, with the middles of both inside both, are moved apart as wholes first.
class alignas(128) PairContactSolver {
public:
	/// Sets the length of the coming substep [s].
	void begin_substep(Real h);

	/// Solves every contact between the two bodies. Returns the number of contacts. Lists their candidates for the
	/// `substeps_left` in the rest of the step, and uses the list while it holds. O(candidates); O(points × edges near
	/// the other body) to make a list; without one O(points within the other's circle × hull points).
	std::size_t handle(SolverBody &a, SolverBody &b, PairCandidates &candidates, int substeps_left);
	/// Sum of the normal impulses of the last `handle` [mass·length/s].
	Real last_impulse() const { return impulse_; }
	/// Vector sum of the normal impulses of the last `handle`, as they act on the first body [mass·length/s].
	Vec2 last_push() const { return push_; }
	/// Contacts since the log was last cleared, of pairs with at least one monitored body.
	ContactLog &log() { return log_; }

private:
	std::size_t handle_points(SolverBody &a, SolverBody &b, bool are_fast);
	std::size_t handle_points_of(SolverBody &body, SolverBody &other, bool are_fast, Real side);
	void list_candidates(const SolverBody &body, const SolverBody &other, Real margin, PairCandidates &candidates);
	std::optional<std::uint32_t> way_out(const SolverBody &body, const SolverBody &other, std::uint32_t point,
			std::optional<std::uint32_t> nearest);
	std::size_t handle_candidates(SolverBody &a, SolverBody &b, PairCandidates &candidates);
	bool handle_candidate(SolverBody &body, SolverBody &other, PairCandidate &candidate, Real side);
	void solve(SolverBody &body, SolverBody &other, std::uint32_t point, const HullContact &contact, Real side, bool is_fresh);
	void read_edges(const SolverBody &body);
	bool handle_crossing(SolverBody &a, SolverBody &b);

	NearEdges near_edges_;
	HullEdges edges_;
	const SolverBody *edges_of_ = nullptr; ///< body whose present hull the edges are
	Real h_ = 0;
	Real impulse_ = 0;
	Vec2 push_;
	ContactLog log_;
};

} // namespace softbody
