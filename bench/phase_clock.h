// SPDX-License-Identifier: MIT
// What the parts of a step take, seen from outside: by the parallel-for that the simulator is given.
#pragma once

#include "core/base/parallel_for.h"

#include <array>
#include <cstddef>

namespace bench {

/// Hands out tasks one after the other on the calling thread and takes the processor time of each. The type of a task is
/// named after the function of the simulator that asks for it: that tells the phase. What happens between the calls,
/// and where a small world asks for no division at all, stays unseen.
class PhaseClock {
public:
	enum Phase { FORCES, BROAD_PHASE, CONTACTS, OTHER, PHASES };
	struct Times {
		std::array<double, PHASES> spent{}; ///< [s]
		/// What would be saved if two threads took these tasks from one list, each the next one when it is done [s].
		double saved_by_two = 0;
	};

	softbody::ParallelFor parallel_for();
	/// Since it was last asked.
	Times take();

private:
	Times times_;
};

/// Processor time of the calling thread [s].
double thread_seconds();

} // namespace bench
