// SPDX-License-Identifier: MIT
// Work that may take longer than a tick: done on another thread, taken over at a tick that does not depend on its speed.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>

namespace softbody {

/// Work for one thread of Godot's WorkerThreadPool. The step in which a result is taken over follows from the order of calls
/// alone: results are those of any other machine. If the thread has not begun with it by then, that step does the work itself;
/// if it has, the step waits for it.
class LateWork {
public:
	LateWork() = default;
	/// What has not begun is dropped.
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
	struct Work {
		std::function<void()> run;
		bool begun = false;
		bool ended = false;
	};
	struct Task {
		uint64_t owner = 0; ///< instance id
		int64_t due = 0; ///< number of the first step that may take it
		std::shared_ptr<Work> work;
		std::function<void()> take;
	};

	void work_off();

	std::deque<Task> tasks_; ///< the oldest first
	int64_t steps_ = 0;
	int64_t pool_task_ = -1; ///< of the pool, the newest; -1 if there was none

	std::mutex mutex_; ///< of what follows, and of the flags of all work
	std::condition_variable ended_;
	std::deque<std::shared_ptr<Work>> waiting_; ///< not begun by the pool's thread
	bool working_ = false; ///< whether a thread of the pool takes from `waiting_`
};

} // namespace softbody
