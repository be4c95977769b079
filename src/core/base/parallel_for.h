// SPDX-License-Identifier: MIT
// How the core asks for several threads without owning any.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace softbody {

/// Calls `task(i)` once for every i in [0, count), in any order and on any threads, and returns when all calls have.
/// The core's results do not depend on order or threads. Empty means: one after the other.
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

/// Into how many tasks a list is divided at most: enough to keep the threads of a large machine busy to the end, few
/// enough that a task outweighs its dispatch. Independent of the number of threads, so that results are too.
inline constexpr std::size_t MOST_SLICES = 32;

/// Calls `work(task, begin, end)` for slices of [0, count), each of at least `least` unless it is the only one. How
/// they are cut depends on the count alone.
template <class Work>
void run_slices(const ParallelFor &parallel_for, std::size_t count, std::size_t least, const Work &work) {
	const std::size_t tasks = std::clamp<std::size_t>(count / least, 1, MOST_SLICES);
	run_tasks(parallel_for, tasks,
			[&](std::size_t task) { work(task, count * task / tasks, count * (task + 1) / tasks); });
}

} // namespace softbody
