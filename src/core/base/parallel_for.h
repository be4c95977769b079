// SPDX-License-Identifier: MIT
// How the core asks for several threads without owning any.
#pragma once

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

} // namespace softbody
