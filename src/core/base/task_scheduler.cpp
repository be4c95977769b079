// SPDX-License-Identifier: MIT
// Divides calls among threads of the caller.
#include "core/base/task_scheduler.h"

#include <thread>

#if defined(_MSC_VER) && (defined(_M_X64) || defined(_M_IX86))
#include <intrin.h>
#endif

namespace softbody {

namespace {

// Some fifty microseconds: longer than the gaps between the calls of one step, too short to slow other programs.
constexpr int SPINS = 1500;

// Tells the processor that this thread waits.
void pause() {
#if defined(__x86_64__) || defined(__i386__)
	__builtin_ia32_pause();
#elif defined(_MSC_VER) && (defined(_M_X64) || defined(_M_IX86))
	_mm_pause();
#elif defined(__aarch64__) && (defined(__GNUC__) || defined(__clang__))
	__asm__ __volatile__("yield");
#endif
}

template <class Condition>
bool spin_until(const Condition &condition) {
	for (int i = 0; i < SPINS; ++i) {
		if (condition()) {
			return true;
		}
		pause();
	}
	return condition();
}

} // namespace

void TaskScheduler::run(std::size_t count, const std::function<void(std::size_t)> &task) {
	task_ = &task;
	count_ = count;
	next_ = 0;
	++call_;
	// Sequentially consistent, like the helper's count of itself before it looks at the call: one sees the other.
	if (sleepers_ > 0) {
		{ const std::lock_guard lock(mutex_); }
		wake_.notify_all();
	}
	work();
	++call_;
	while (!spin_until([this] { return present_ == 0; })) {
		std::this_thread::yield();
	}
}

void TaskScheduler::work() {
	for (std::size_t i = next_++; i < count_; i = next_++) {
		(*task_)(i);
	}
}

void TaskScheduler::help() {
	std::uint64_t served = 0;
	const auto has_news = [&] {
		const std::uint64_t call = call_;
		return closed_ || (call % 2 == 1 && call != served);
	};
	for (;;) {
		if (!spin_until(has_news)) {
			std::unique_lock lock(mutex_);
			++sleepers_;
			wake_.wait(lock, has_news);
			--sleepers_;
		}
		if (closed_) {
			return;
		}
		const std::uint64_t call = call_;
		if (call % 2 == 0) {
			continue; // the call ended before this helper noticed it
		}
		served = call;
		++present_;
		if (call_ == call) {
			work();
		}
		--present_;
	}
}

void TaskScheduler::close() {
	{
		const std::lock_guard lock(mutex_);
		closed_ = true;
	}
	wake_.notify_all();
}

} // namespace softbody
