// SPDX-License-Identifier: MIT
// How the core asks for several threads without owning any.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace softbody {

/// Calls `task(i)` once for every i in [0, count), in any order and on any threads, and returns when all calls have
/// returned. Results of the core do not depend on order or threads. An empty one runs the tasks one after the other.
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t)> &task)>;

inline void run_tasks(const ParallelFor &parallel_for, std::size_t count, const std::function<void(std::size_t)> &task) {
	if (parallel_for && count > 1) {
		parallel_for(count, task);
		return;
	}
	for (std::size_t i = 0; i < count; ++i) {
		task(i);
	}
}

/// Most tasks into which a list is divided: enough to keep the threads of a large machine busy, few enough that a task
/// outweighs its dispatch. It is independent of the number of threads, so that results are too.
inline constexpr std::size_t MOST_SLICES = 32;

/// Calls `work(task, begin, end)` for slices of [0, count), each of at least `least` unless it is the only one. The
/// slices depend on the count alone.
template <class Work>
void run_slices(const ParallelFor &parallel_for, std::size_t count, std::size_t least, const Work &work) {
	const std::size_t tasks = std::clamp<std::size_t>(count / least, 1, MOST_SLICES);
	run_tasks(parallel_for, tasks,
			[&](std::size_t task) { work(task, count * task / tasks, count * (task + 1) / tasks); });
}

} // namespace softbody
