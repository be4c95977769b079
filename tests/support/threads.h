// SPDX-License-Identifier: MIT
// A parallel-for on threads of the standard library, which end with each call.
#pragma once

#include "core/base/parallel_for.h"

#include <atomic>
#include <thread>
#include <vector>

namespace softbody::testing {

inline ParallelFor on_threads(std::size_t thread_count) {
	return [thread_count](std::size_t count, const std::function<void(std::size_t)> &task) {
		std::atomic<std::size_t> next = 0;
		const auto work = [&] {
			for (std::size_t i = next++; i < count; i = next++) {
				task(i);
			}
		};
		std::vector<std::thread> others;
		for (std::size_t i = 1; i < thread_count; ++i) {
			others.emplace_back(work);
		}
		work();
		for (std::thread &thread : others) {
			thread.join();
		}
	};
}

} // namespace softbody::testing
