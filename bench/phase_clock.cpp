// SPDX-License-Identifier: MIT
// What the parts of a step take, seen from outside.
#include "phase_clock.h"

#include <algorithm>
#include <ctime>
#include <functional>
#include <string_view>
#include <utility>

namespace bench {

namespace {

PhaseClock::Phase phase_of(std::string_view name) {
	const auto is = [&](const char *function) { return name.find(function) != std::string_view::npos; };
	if (is("PairContacts6answer")) { // as compilers spell PairContacts::answer
		return PhaseClock::CONTACTS;
	}
	if (is("find_all_pairs") || is("PairContacts10begin_step")) {
		return PhaseClock::BROAD_PHASE;
	}
	return is("advance_batches") || is("for_batches") ? PhaseClock::FORCES : PhaseClock::OTHER;
}

} // namespace

softbody::ParallelFor PhaseClock::parallel_for() {
	return [this](std::size_t count, const std::function<void(std::size_t)> &task) {
		const double begin = thread_seconds();
		double last = begin;
		std::array<double, 2> threads{};
		for (std::size_t i = 0; i < count; ++i) {
			task(i);
			const double now = thread_seconds();
			*std::min_element(threads.begin(), threads.end()) += now - last;
			last = now;
		}
		times_.spent[phase_of(task.target_type().name())] += last - begin;
		times_.saved_by_two += std::min(threads[0], threads[1]);
	};
}

PhaseClock::Times PhaseClock::take() {
	return std::exchange(times_, {});
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
