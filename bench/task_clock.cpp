// SPDX-License-Identifier: MIT
// The processor time of a step's tasks, one by one.
#include "task_clock.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <functional>
#include <utility>

namespace bench {

softbody::ParallelFor TaskClock::parallel_for() {
	return [this](std::size_t count, const std::function<void(std::size_t)> &task) {
		double last = thread_seconds();
		std::array<double, 2> threads{};
		for (std::size_t i = 0; i < count; ++i) {
			task(i);
			const double now = thread_seconds();
			*std::min_element(threads.begin(), threads.end()) += now - last;
			last = now;
		}
		saved_by_two_ += std::min(threads[0], threads[1]);
	};
}

double TaskClock::take_saved_by_two() {
	return std::exchange(saved_by_two_, 0);
}

double thread_seconds() {
#if defined(CLOCK_THREAD_CPUTIME_ID)
	timespec now;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
	return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
#else
	return double(std::clock()) / CLOCKS_PER_SEC; // of all threads
#endif
}

} // namespace bench
