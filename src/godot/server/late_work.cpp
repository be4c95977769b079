// SPDX-License-Identifier: MIT
// Work that may take longer than a tick: done on another thread, taken over at a tick that does not depend on its speed.
#include "godot/server/late_work.h"

#include <godot_cpp/classes/worker_thread_pool.hpp>
#include <godot_cpp/core/object.hpp>

#include <utility>

using namespace godot;

namespace softbody {

LateWork::~LateWork() {
	{
		const std::lock_guard lock(mutex_);
		waiting_.clear();
	}
	if (pool_task_ >= 0) {
		WorkerThreadPool::get_singleton()->wait_for_task_completion(pool_task_);
	}
}

void LateWork::add(uint64_t p_owner, std::function<void()> p_work, std::function<void()> p_take) {
	auto work = std::make_shared<Work>();
	work->run = std::move(p_work);
	tasks_.push_back({ p_owner, steps_ + LATENCY, work, std::move(p_take) });
	{
		const std::lock_guard lock(mutex_);
		waiting_.push_back(std::move(work));
		if (working_) {
			return;
		}
		working_ = true;
	}
	WorkerThreadPool *pool = WorkerThreadPool::get_singleton();
	if (pool_task_ >= 0) {
		pool->wait_for_task_completion(pool_task_); // It has nothing left to do, and the pool keeps it until its end is awaited.
	}
	// One task at a time leaves the pool to others. It is of high priority: Godot 4.6 never ends if tasks of low priority are
	// queued when the game quits.
	pool_task_ = pool->add_native_task([](void *p_self) { static_cast<LateWork *>(p_self)->work_off(); }, this, true, "SoftBody2D modes");
}

void LateWork::work_off() {
	std::unique_lock lock(mutex_);
	while (!waiting_.empty()) {
		const std::shared_ptr<Work> work = std::move(waiting_.front());
		waiting_.pop_front();
		if (work->begun) {
			continue; // by the step
		}
		work->begun = true;
		lock.unlock();
		work->run();
		lock.lock();
		work->ended = true;
		ended_.notify_all();
	}
	working_ = false;
}

void LateWork::take_one() {
	steps_++;
	if (tasks_.empty() || tasks_.front().due > steps_) {
		return;
	}
	const Task task = std::move(tasks_.front());
	tasks_.pop_front();
	const bool wanted = ObjectDB::get_instance(task.owner) != nullptr;
	std::unique_lock lock(mutex_);
	if (!task.work->begun) {
		task.work->begun = true;
		lock.unlock();
		if (wanted) {
			task.work->run();
		}
	} else {
		ended_.wait(lock, [&] { return task.work->ended; });
		lock.unlock();
	}
	if (wanted) {
		task.take();
	}
}

} // namespace softbody
