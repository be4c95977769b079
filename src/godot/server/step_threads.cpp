// SPDX-License-Identifier: MIT
// Lends threads of Godot's WorkerThreadPool to the step.
#include "godot/server/step_threads.h"

#include <godot_cpp/classes/os.hpp>
#include <godot_cpp/classes/worker_thread_pool.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>

using namespace godot;

namespace softbody {

namespace {

// Most threads by default: more gain little for a step of a few milliseconds, and the game needs threads too.
constexpr int MAX_AUTOMATIC = 8;

} // namespace

StepThreads::StepThreads() : scheduler_(std::make_shared<TaskScheduler>()) {
	set_thread_count(0);
}

StepThreads::~StepThreads() {
	scheduler_->close();
	forget_finished(true);
}

void StepThreads::set_thread_count(int p_count) {
	const OS *os = OS::get_singleton();
	// Without threads the pool runs a task at once within the call: a helper would wait for its own leader.
	if (os->has_feature("nothreads")) {
		thread_count_ = 1;
		return;
	}
	const int available = std::max(1, os->get_processor_count());
	thread_count_ = p_count == 0 ? std::min(available, MAX_AUTOMATIC) : std::min(available, p_count);
}

ParallelFor StepThreads::parallel_for() {
	return [this](std::size_t p_count, const std::function<void(std::size_t)> &p_task) {
		ask_for_helpers();
		scheduler_->run(p_count, p_task);
	};
}

void StepThreads::ask_for_helpers() {
	if (asked_) {
		return;
	}
	asked_ = true;
	scheduler_->open();
	forget_finished(false);
	// Helpers of earlier steps that have not begun yet are still queued.
	while (int(tasks_.size()) < thread_count_ - 1) {
		auto *lent = new std::shared_ptr<TaskScheduler>(scheduler_);
		tasks_.push_back(WorkerThreadPool::get_singleton()->add_native_task(
				[](void *p_lent) {
					const std::unique_ptr<std::shared_ptr<TaskScheduler>> scheduler(static_cast<std::shared_ptr<TaskScheduler> *>(p_lent));
					(*scheduler)->help();
				},
				lent, true, "SoftBody2D step"));
	}
}

void StepThreads::end_step() {
	if (asked_) {
		scheduler_->close();
		asked_ = false;
	}
}

// The pool keeps a task until its end is awaited.
void StepThreads::forget_finished(bool p_wait) {
	WorkerThreadPool *pool = WorkerThreadPool::get_singleton();
	std::erase_if(tasks_, [&](int64_t p_task) {
		if (!p_wait && !pool->is_task_completed(p_task)) {
			return false;
		}
		pool->wait_for_task_completion(p_task);
		return true;
	});
}

} // namespace softbody
