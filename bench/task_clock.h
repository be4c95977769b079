// SPDX-License-Identifier: MIT
// The processor time of a step's tasks, one by one.
#pragma once

#include "core/base/parallel_for.h"

namespace bench {

/// Runs tasks one after the other on the calling thread, and takes the processor time of each.
class TaskClock {
public:
	softbody::ParallelFor parallel_for();
	/// Time that would be saved if two threads took the tasks from one list, each the next one when it is done [s]. Since the
	/// last call.
	double take_saved_by_two();

private:
	double saved_by_two_ = 0;
};

/// Processor time of the calling thread [s].
double thread_seconds();

} // namespace bench
