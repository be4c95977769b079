// SPDX-License-Identifier: MIT
// Parallel-fors on threads of the standard library. Tests that use one belong to the suite "threads", which also runs under
// ThreadSanitizer; test_restore.cpp does not, as it makes too many threads for that.
#pragma once

#include "core/base/parallel_for.h"
#include "core/base/task_scheduler.h"

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace softbody::testing {

/// On threads that end with each call.
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

/// A team with helpers that stay from call to call, as the engine's threads do.
class HelpedTeam {
public:
	explicit HelpedTeam(std::size_t helper_count) {
		for (std::size_t i = 0; i < helper_count; ++i) {
			helpers_.emplace_back([this] { team_.help(); });
		}
	}
	~HelpedTeam() {
		team_.close();
		for (std::thread &helper : helpers_) {
			helper.join();
		}
	}
	/// To be used no longer than this.
	ParallelFor parallel_for() {
		return [this](std::size_t count, const std::function<void(std::size_t)> &task) { team_.run(count, task); };
	}

private:
	TaskScheduler team_;
	std::vector<std::thread> helpers_;
};

} // namespace softbody::testing
