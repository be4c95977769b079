// SPDX-License-Identifier: MIT
// Lends threads of Godot's WorkerThreadPool to the step.
#pragma once

#include "core/base/parallel_for.h"
#include "core/base/task_scheduler.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace softbody {

/// Requests helpers from the pool once a step; they stay to its end. The step never waits for a helper that has not
/// begun, and a late helper joins the next step or leaves. See docs/decisions/step-threads.md.
class StepThreads {
public:
	StepThreads();
	~StepThreads();
	StepThreads(const StepThreads &) = delete;
	StepThreads &operator=(const StepThreads &) = delete;

	/// Number of threads of a step, including the calling one; 0: as many as the machine has, at most MAX_AUTOMATIC.
	void set_thread_count(int p_count);
	int get_thread_count() const { return thread_count_; }

	/// The parallel-for of simulators, which this object must outlive.
	ParallelFor parallel_for();
	/// Sends away the helpers of this step. The next division of work asks for helpers again.
	void end_step();

private:
	void ask_for_helpers();
	void forget_finished(bool p_wait);

	std::shared_ptr<TaskScheduler> scheduler_; ///< late helpers keep it alive
	std::vector<int64_t> tasks_; ///< of the pool, not known to have ended
	int thread_count_ = 1;
	bool asked_ = false; ///< whether this step has requested helpers
};

} // namespace softbody
