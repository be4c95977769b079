// SPDX-License-Identifier: MIT
// A budget of time for a step: what is given up follows from the times alone, in order, and comes back.
#include "core/dynamics/step_budget.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

using namespace softbody;
using namespace softbody::testing;

namespace {

StepBudget budget_of(double limit) {
	StepBudget budget;
	budget.set_limit(limit);
	return budget;
}

void note(StepBudget &budget, double time, int count) {
	for (int i = 0; i < count; ++i) {
		budget.note_step(time);
	}
}

} // namespace

TEST_CASE("without a budget nothing is given up, whatever steps take") {
	StepBudget budget;
	note(budget, 1e6, 1000);
	CHECK(budget.levels() == BudgetLevels{});
	CHECK(std::strcmp(budget.reason(), "off") == 0);
}

TEST_CASE("steps over the budget take the levels down in order: rigid flight, then unseen bodies") {
	StepBudget budget = budget_of(4);
	note(budget, 5, StepBudget::OVER_TICKS - 1);
	CHECK(budget.levels() == BudgetLevels{});
	note(budget, 5, 1);
	CHECK(budget.levels() == BudgetLevels{ true, 0 });
	CHECK(std::strcmp(budget.reason(), "over_budget") == 0);
	double share = 0;
	for (int part = 1; part <= StepBudget::PARTS; ++part) {
		note(budget, 5, StepBudget::OVER_TICKS);
		CHECK(budget.levels().rigid_flight);
		CHECK(budget.levels().paused_share > share);
		share = budget.levels().paused_share;
	}
	CHECK(share == 1);
	note(budget, 5, 1000);
	CHECK(budget.depth() == 1 + StepBudget::PARTS);
}

TEST_CASE("a spike changes nothing") {
	StepBudget budget = budget_of(4);
	for (int i = 0; i < 1000; ++i) {
		budget.note_step(i % 4 == 0 ? 1 : 40);
		CHECK(budget.depth() == 0);
	}
}

TEST_CASE("levels come back one by one where there is room, and stay where there is hardly any") {
	StepBudget budget = budget_of(4);
	note(budget, 5, 3 * StepBudget::OVER_TICKS);
	REQUIRE(budget.depth() == 3);
	note(budget, 3.5, 10000); // less than the budget, but more than its share for the way up
	CHECK(budget.depth() == 3);
	CHECK(std::strcmp(budget.reason(), "keeps_room") == 0);
	note(budget, 1, StepBudget::UP_TICKS - 1);
	CHECK(budget.depth() == 3);
	note(budget, 1, 1);
	CHECK(budget.depth() == 2);
	note(budget, 1, 2 * StepBudget::UP_TICKS);
	CHECK(budget.depth() == 0);
	CHECK(std::strcmp(budget.reason(), "within_budget") == 0);
}

TEST_CASE("the first level that is given up comes back as soon as any, however early it was needed") {
	StepBudget budget = budget_of(4);
	note(budget, 5, StepBudget::OVER_TICKS);
	REQUIRE(budget.depth() == 1);
	note(budget, 1, StepBudget::UP_TICKS);
	CHECK(budget.depth() == 0);
}

TEST_CASE("a budget that is set anew, or taken away, gives all back") {
	StepBudget budget = budget_of(4);
	note(budget, 5, 100);
	budget.set_limit(4);
	CHECK(budget.depth() > 0);
	budget.set_limit(8);
	CHECK(budget.depth() == 0);
	note(budget, 9, 100);
	budget.set_limit(0);
	CHECK(budget.levels() == BudgetLevels{});
}

TEST_CASE("a level that helps just enough does not flicker: changes become rarer") {
	// Steps of 5 ms at full detail and of 2 ms with one level down: there always seems to be room.
	for (std::uint64_t seed = 0; seed < 100; ++seed) {
		Random random(seed);
		StepBudget budget = budget_of(4);
		int changes = 0;
		int late_changes = 0;
		constexpr int TICKS = 60 * 60;
		for (int tick = 0; tick < TICKS; ++tick) {
			const int before = budget.depth();
			budget.note_step((before == 0 ? 5 : 2) + double(random.real(-0.2, 0.2)));
			changes += before != budget.depth();
			late_changes += tick >= TICKS / 2 && before != budget.depth();
		}
		CHECK(changes > 2);
		CHECK(late_changes <= 2 * (TICKS / 2) / (StepBudget::MOST_PATIENCE * StepBudget::UP_TICKS) + 2);
	}
}

TEST_CASE("levels follow from the times alone") {
	for (std::uint64_t seed = 0; seed < 200; ++seed) {
		Random random(seed);
		StepBudget a = budget_of(4);
		StepBudget b = budget_of(4);
		for (int tick = 0; tick < 500; ++tick) {
			const double time = double(random.real(0, 8));
			a.note_step(time);
			b.note_step(time);
			REQUIRE(a.levels() == b.levels());
			REQUIRE(a.levels().paused_share >= 0);
			REQUIRE(a.levels().paused_share <= 1);
		}
	}
}
