// SPDX-License-Identifier: MIT
// Threads that wait for work: a step asks for them some twenty times, too often to start new ones each time.
#pragma once

#include "core/base/parallel_for.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace bench {

/// The calling thread and `helpers` more. A helper spins a little for the next call, then sleeps; one that is late for a
/// call is not waited for. One caller at a time, never from within a task.
class ThreadPool {
public:
	explicit ThreadPool(std::size_t helpers);
	~ThreadPool();
	ThreadPool(const ThreadPool &) = delete;
	ThreadPool &operator=(const ThreadPool &) = delete;

	/// For a simulator, which the pool must outlive.
	softbody::ParallelFor parallel_for();
	/// Whether the helpers take part; else the calling thread does all. Default true.
	void set_in_use(bool in_use) { in_use_ = in_use; }

private:
	void run(std::size_t count, const std::function<void(std::size_t)> &task);
	void help();
	void work();

	std::vector<std::thread> helpers_;
	bool in_use_ = true;
	std::mutex mutex_;
	std::condition_variable wake_;
	std::atomic<std::size_t> sleepers_ = 0;
	std::atomic<bool> ends_ = false;
	std::atomic<std::uint64_t> call_ = 0; ///< odd while a call is open
	/// Helpers that may look at what follows. Whoever counts himself in here and then finds the call still open is waited
	/// for; whoever finds it closed looks at nothing.
	std::atomic<std::size_t> present_ = 0;
	std::atomic<std::size_t> next_ = 0;
	std::size_t count_ = 0;
	const std::function<void(std::size_t)> *task_ = nullptr;
};

/// How many threads this machine runs at once, at least 1.
std::size_t hardware_threads();

} // namespace bench
