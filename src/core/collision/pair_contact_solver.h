// SPDX-License-Identifier: MIT
// Contacts of soft bodies with one another.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/collision/contact_log.h"
#include "core/collision/hull_contact.h"
#include "core/collision/pair_constraint.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Finds and solves the contacts of pairs of bodies, each hull point against the other's hull edges. One object
/// serves one thread; several may work at once on pairs that share no body.
///
/// Where two bodies move far in a substep (SWEEP_SHARE), each point is also followed on its way through the moving
/// edges, so that nothing passes through. Bodies that lie across each other, the middles of both inside both, are
/// parted as wholes before any point is looked at.
class alignas(128) PairContactSolver {
public:
	/// Length of the coming substep [s].
	void begin_substep(Real h);

	/// Answers every contact between the two bodies. Returns how many.
	/// O(points within the other's circle × hull points).
	std::size_t handle(SolverBody &a, SolverBody &b);
	/// Sum of the normal impulses that the last `handle` solved with [mass·length/s].
	Real last_impulse() const { return impulse_; }
	/// The same with their directions, as they act on the first body.
	Vec2 last_push() const { return push_; }
	/// The contacts solved between bodies of which one at least is monitored, since it was last cleared.
	ContactLog &log() { return log_; }

private:
	std::size_t handle_points(SolverBody &a, SolverBody &b, bool are_fast);
	bool handle_point(SolverBody &body, SolverBody &other, std::uint32_t point, Real side, bool are_fast);
	bool handle_crossing(SolverBody &a, SolverBody &b);

	HullEdges edges_;
	const SolverBody *edges_of_ = nullptr; ///< whose hull they are, as it is now
	Real h_ = 0;
	Real impulse_ = 0;
	Vec2 push_;
	ContactLog log_;
};

} // namespace softbody
