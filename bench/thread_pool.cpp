// SPDX-License-Identifier: MIT
// Threads of the bench's own.
#include "thread_pool.h"

#include <algorithm>
#include <functional>

namespace bench {

ThreadPool::ThreadPool(std::size_t helpers) {
	for (std::size_t i = 0; i < helpers; ++i) {
		helpers_.emplace_back([this] { team_.help(); });
	}
}

ThreadPool::~ThreadPool() {
	team_.close();
	for (std::thread &helper : helpers_) {
		helper.join();
	}
}

softbody::ParallelFor ThreadPool::parallel_for() {
	return [this](std::size_t count, const std::function<void(std::size_t)> &task) {
		if (in_use_ && !helpers_.empty()) {
			team_.run(count, task);
		} else {
			softbody::run_tasks({}, count, task);
		}
	};
}

std::size_t hardware_threads() {
	return std::max(1u, std::thread::hardware_concurrency());
}

} // namespace bench
