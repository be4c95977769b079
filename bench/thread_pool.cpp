// SPDX-License-Identifier: MIT
// Threads that wait for work.
#include "thread_pool.h"

#include <algorithm>
#include <chrono>

namespace bench {

namespace {

// Longer than the gaps between the calls of one step, shorter than what others on the machine would miss.
constexpr std::chrono::microseconds SPIN{ 100 };

// Waits for the condition at most that long. The clock is read now and then only.
template <class Condition>
bool spin_until(const Condition &condition) {
	const auto end = std::chrono::steady_clock::now() + SPIN;
	do {
		for (int i = 0; i < 64; ++i) {
			if (condition()) {
				return true;
			}
#if defined(__x86_64__)
			__builtin_ia32_pause();
#endif
		}
	} while (std::chrono::steady_clock::now() < end);
	return false;
}

} // namespace

ThreadPool::ThreadPool(std::size_t helpers) {
	for (std::size_t i = 0; i < helpers; ++i) {
		helpers_.emplace_back([this] { help(); });
	}
}

ThreadPool::~ThreadPool() {
	{
		const std::lock_guard lock(mutex_);
		ends_ = true;
	}
	wake_.notify_all();
	for (std::thread &helper : helpers_) {
		helper.join();
	}
}

softbody::ParallelFor ThreadPool::parallel_for() {
	return [this](std::size_t count, const std::function<void(std::size_t)> &task) { run(count, task); };
}

void ThreadPool::run(std::size_t count, const std::function<void(std::size_t)> &task) {
	if (!in_use_ || helpers_.empty()) {
		for (std::size_t i = 0; i < count; ++i) {
			task(i);
		}
		return;
	}
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

void ThreadPool::work() {
	for (std::size_t i = next_++; i < count_; i = next_++) {
		(*task_)(i);
	}
}

void ThreadPool::help() {
	std::uint64_t served = 0;
	const auto has_call = [&] {
		const std::uint64_t call = call_;
		return ends_ || (call % 2 == 1 && call != served);
	};
	for (;;) {
		if (!spin_until(has_call)) {
			std::unique_lock lock(mutex_);
			++sleepers_;
			wake_.wait(lock, has_call);
			--sleepers_;
		}
		if (ends_) {
			return;
		}
		const std::uint64_t call = call_;
		if (call % 2 == 0) {
			continue; // over before it was noticed
		}
		served = call;
		++present_;
		if (call_ == call) {
			work();
		}
		--present_;
	}
}

std::size_t hardware_threads() {
	return std::max(1u, std::thread::hardware_concurrency());
}

} // namespace bench
