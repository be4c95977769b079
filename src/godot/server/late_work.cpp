// SPDX-License-Identifier: MIT
// Work that may take longer than a tick: done on another thread, taken over at a tick that does not depend on its speed.
#include "godot/server/late_work.h"

#include <godot_cpp/classes/worker_thread_pool.hpp>
#include <godot_cpp/core/object.hpp>

#include <memory>
#include <utility>

using namespace godot;

namespace softbody {

LateWork::~LateWork() {
	for (const Task &task : tasks_) {
		WorkerThreadPool::get_singleton()->wait_for_task_completion(task.task);
	}
}

void LateWork::add(uint64_t p_owner, std::function<void()> p_work, std::function<void()> p_take) {
	auto *lent = new std::function<void()>(std::move(p_work));
	const int64_t task = WorkerThreadPool::get_singleton()->add_native_task(
			[](void *p_lent) {
				const std::unique_ptr<std::function<void()>> work(static_cast<std::function<void()> *>(p_lent));
				(*work)();
			},
			lent, false, "SoftBody2D modes");
	tasks_.push_back({ p_owner, task, steps_ + LATENCY, std::move(p_take) });
}

void LateWork::take_one() {
	steps_++;
	if (tasks_.empty() || tasks_.front().due > steps_) {
		return;
	}
	const Task task = std::move(tasks_.front());
	tasks_.pop_front();
	WorkerThreadPool::get_singleton()->wait_for_task_completion(task.task);
	if (ObjectDB::get_instance(task.owner) != nullptr) {
		task.take();
	}
}

} // namespace softbody
