// SPDX-License-Identifier: MIT
// Divides calls among threads that somebody else owns.
#pragma once

#include "core/base/parallel_for.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>

namespace softbody {

/// One thread leads and calls `run`; any others may be in `help` meanwhile, or come late, or not at all: the leader waits
/// for nobody who has not begun. A step asks for its threads some hundred times, so a helper spins a little for the next
/// call before it sleeps. Owns no thread; outlive it by every helper.
class TaskScheduler {
public:
	/// Calls `task(i)` once for every i in [0, count), by the calling thread and whoever helps, and returns when all calls
	/// have. One leader at a time, never from within a task.
	void run(std::size_t count, const std::function<void(std::size_t)> &task);
	/// Takes part in every call until the team is closed. Returns at once when it is.
	void help();
	/// From now on `help` waits for calls. A new team is open.
	void open() { closed_ = false; }
	/// Sends the helpers away, between two calls; does not wait until they are gone.
	void close();

private:
	void work();

	std::mutex mutex_;
	std::condition_variable wake_;
	std::atomic<std::size_t> sleepers_ = 0;
	std::atomic<bool> closed_ = false;
	std::atomic<std::uint64_t> call_ = 0; ///< odd while a call is open
	/// Helpers that may look at what follows. Whoever counts himself in here and then finds the call still open is waited
	/// for; whoever finds it closed looks at nothing.
	std::atomic<std::size_t> present_ = 0;
	std::atomic<std::size_t> next_ = 0;
	std::size_t count_ = 0;
	const std::function<void(std::size_t)> *task_ = nullptr;
};

} // namespace softbody
