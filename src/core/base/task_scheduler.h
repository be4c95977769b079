// SPDX-License-Identifier: MIT
// Divides calls among threads of the caller.
#pragma once

#include "core/base/parallel_for.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>

namespace softbody {

/// One thread leads and calls `run`. Any others may be in `help` meanwhile, come late, or not come: the leader never
/// waits for a thread that has not begun. A step divides work some hundred times, so a helper spins a little for the
/// next call before it sleeps. Owns no thread, and must outlive every helper.
class TaskScheduler {
public:
	/// Calls `task(i)` once for every i in [0, count), on the calling thread and all helpers, and returns when all
	/// calls have returned. One leader at a time, never from within a task.
	void run(std::size_t count, const std::function<void(std::size_t)> &task);
	/// Takes part in every call until the scheduler is closed. Returns at once if it is closed.
	void help();
	/// From now on `help` waits for calls. A new scheduler is open.
	void open() { closed_ = false; }
	/// Sends the helpers away, between two calls. Does not wait until they are gone.
	void close();

private:
	void work();

	std::mutex mutex_;
	std::condition_variable wake_;
	std::atomic<std::size_t> sleepers_ = 0;
	std::atomic<bool> closed_ = false;
	std::atomic<std::uint64_t> call_ = 0; ///< odd while a call is open
	/// Helpers that may read the fields below. The leader waits for a helper that counts itself in here and then finds
	/// the call still open; a helper that finds it closed reads nothing.
	std::atomic<std::size_t> present_ = 0;
	std::atomic<std::size_t> next_ = 0;
	std::size_t count_ = 0;
	const std::function<void(std::size_t)> *task_ = nullptr;
};

} // namespace softbody
