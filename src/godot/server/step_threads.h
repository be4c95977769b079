// SPDX-License-Identifier: MIT
// Lends threads of Godot's WorkerThreadPool to the step.
#pragma once

#include "core/base/parallel_for.h"
#include "core/base/task_scheduler.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace softbody {

/// A step divides its work some hundred times. A task of the pool each time would cost more than it saves, so helpers
/// are asked for once a step, and stay with it to its end. The pool may be busy with other things: nobody waits for a
/// helper that has not come, and one that comes late helps the next step or leaves.
class StepThreads {
public:
	StepThreads();
	~StepThreads();
	StepThreads(const StepThreads &) = delete;
	StepThreads &operator=(const StepThreads &) = delete;

	/// How many threads a step may use, the calling one included; 0: as many as the machine has, at most MAX_AUTOMATIC.
	void set_thread_count(int p_count);
	int get_thread_count() const { return thread_count_; }

	/// For simulators, which this object must outlive.
	ParallelFor parallel_for();
	/// Sends the helpers away that came since the last call.
	void end_step();

private:
	struct Shared; ///< the team; helpers that come late keep it alive

	void ask_for_helpers();
	void forget_finished(bool p_wait);

	std::shared_ptr<Shared> shared_;
	std::vector<int64_t> tasks_; ///< of the pool, not known to have ended
	int thread_count_ = 1;
	bool asked_ = false; ///< for helpers, in this step
};

} // namespace softbody
