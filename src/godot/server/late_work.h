// SPDX-License-Identifier: MIT
// Work that may take longer than a tick: done on another thread, taken over at a tick that does not depend on its speed.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>

namespace softbody {

/// Tasks for Godot's WorkerThreadPool. The step in which the result of a task is taken over follows from the order of calls
/// alone: results are those of any other machine. If a task has not ended by then, that step waits for it.
class LateWork {
public:
	LateWork() = default;
	~LateWork();
	LateWork(const LateWork &) = delete;
	LateWork &operator=(const LateWork &) = delete;

	/// `p_work` is called on any thread, and touches nothing that others use. `p_take` is called before a later step, on
	/// the main thread, if the object `p_owner` still exists.
	void add(uint64_t p_owner, std::function<void()> p_work, std::function<void()> p_take);
	/// To be called before each step: takes over the oldest result, if it is at least LATENCY steps old.
	void take_one();

	static constexpr int64_t LATENCY = 3;

private:
	struct Task {
		uint64_t owner = 0; ///< instance id
		int64_t task = 0; ///< of the pool
		int64_t due = 0; ///< number of the first step that may take it
		std::function<void()> take;
	};
	std::deque<Task> tasks_; ///< the oldest first
	int64_t steps_ = 0;
};

} // namespace softbody
