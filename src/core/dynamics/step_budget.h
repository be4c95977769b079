// SPDX-License-Identifier: MIT
// Decides from measured times how much detail bodies give up so that steps keep to a budget.
#pragma once

namespace softbody {

/// What bodies give up, none of them that is important.
struct BudgetLevels {
	bool rigid_flight = false; ///< calm bodies in the air move as rigid ones (`WorldData::set_rigid_flight`)
	double paused_share = 0; ///< of the bodies that nobody sees, which stand still [1], 0..1

	friend bool operator==(const BudgetLevels &, const BudgetLevels &) = default;
};

/// Goes down a level when OVER_TICKS steps in a row took longer than the budget, and up again when UP_TICKS in a row took less than
/// UP_SHARE of it: first rigid flight, then the unseen bodies in parts of 1 / PARTS. A level that was left because there was room,
/// and that is needed again at once, is left later the next time: up to MOST_PATIENCE times as late.
///
/// Times differ from run to run and from machine to machine, and so do levels: a game that must run the same way twice uses none.
class StepBudget {
public:
	static constexpr int OVER_TICKS = 4; ///< more: spikes of a single tick change nothing
	static constexpr int UP_TICKS = 60; ///< more: levels change less often
	static constexpr double UP_SHARE = 0.7; ///< of the budget [1]; more: levels go up and down
	static constexpr int PARTS = 8; ///< more: less is given up than needed, more slowly
	static constexpr int MOST_PATIENCE = 16;

	/// The budget of a step [ms], > 0; 0: none, and all levels are back at once.
	void set_limit(double limit);
	double limit() const { return limit_; }
	/// Takes the time of a step [ms].
	void note_step(double time);
	/// Number of levels that are down, 0..1 + PARTS.
	int depth() const { return depth_; }
	BudgetLevels levels() const;
	/// Why the levels are as they are: "off", "within_budget", "over_budget" (the last steps took too long) or "keeps_room" (there is not yet enough
	/// room to go up).
	const char *reason() const;

private:
	double limit_ = 0;
	double last_ = 0;
	int depth_ = 0;
	int over_ = 0; ///< steps in a row
	int room_ = 0; ///< steps in a row
	int since_up_ = UP_TICKS + 1; ///< steps since the last level up; as after a long time if there was none
	int patience_ = 1;
};

} // namespace softbody
