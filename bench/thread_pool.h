// SPDX-License-Identifier: MIT
// Threads of the bench's own, for a simulator.
#pragma once

#include "core/base/parallel_for.h"
#include "core/base/task_scheduler.h"

#include <cstddef>
#include <thread>
#include <vector>

namespace bench {

/// The calling thread and `helpers` more. One caller at a time, never from within a task.
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
	softbody::TaskScheduler team_;
	std::vector<std::thread> helpers_;
	bool in_use_ = true;
};

/// How many threads this machine runs at once, at least 1.
std::size_t hardware_threads();

} // namespace bench
