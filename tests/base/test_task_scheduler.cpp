// SPDX-License-Identifier: MIT
#include "core/base/task_scheduler.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

using namespace softbody;

namespace {

// Runs `calls` calls of different sizes and tells whether each index was called just once in each, and before the call
// returned.
bool calls_each_once(TaskScheduler &team, int calls) {
	for (int c = 0; c < calls; ++c) {
		std::vector<int> called(std::size_t(c % 17), 0);
		team.run(called.size(), [&](std::size_t i) { ++called[i]; });
		for (const int times : called) {
			if (times != 1) {
				return false;
			}
		}
	}
	return true;
}

} // namespace

TEST_CASE("a team calls every index once, and all calls are over when it returns" * doctest::test_suite("threads")) {
	for (const int helpers : { 0, 1, 3 }) {
		TaskScheduler team;
		std::vector<std::thread> threads;
		for (int i = 0; i < helpers; ++i) {
			threads.emplace_back([&] { team.help(); });
		}
		CHECK(calls_each_once(team, 20000));
		team.close();
		for (std::thread &thread : threads) {
			thread.join();
		}
	}
}

TEST_CASE("helpers take part" * doctest::test_suite("threads")) {
	TaskScheduler team;
	std::atomic<bool> helper_came = false;
	const std::thread::id leader = std::this_thread::get_id();
	std::thread helper([&] { team.help(); });
	// The leader's task does not return until a helper has had one: without help this would not end.
	team.run(2, [&](std::size_t) {
		if (std::this_thread::get_id() != leader) {
			helper_came = true;
		}
		while (!helper_came) {
			std::this_thread::yield();
		}
	});
	CHECK(helper_came);
	team.close();
	helper.join();
}

TEST_CASE("helpers that sleep are woken by a call" * doctest::test_suite("threads")) {
	TaskScheduler team;
	std::thread helper([&] { team.help(); });
	const std::thread::id leader = std::this_thread::get_id();
	for (int round = 0; round < 5; ++round) {
		std::this_thread::sleep_for(std::chrono::milliseconds(20)); // by then it has given up spinning
		std::atomic<bool> helper_came = false;
		team.run(2, [&](std::size_t) {
			if (std::this_thread::get_id() != leader) {
				helper_came = true;
			}
			while (!helper_came) {
				std::this_thread::yield();
			}
		});
		CHECK(helper_came);
	}
	team.close();
	helper.join();
}

TEST_CASE("a team that closes sends its helpers away, and can open again" * doctest::test_suite("threads")) {
	TaskScheduler team;
	for (int session = 0; session < 200; ++session) {
		team.open();
		std::thread helper([&] { team.help(); });
		CHECK(calls_each_once(team, session % 20));
		team.close();
		helper.join(); // or the test does not end
	}
	team.help(); // returns at once
}
