// SPDX-License-Identifier: MIT
// Decides from measured times how much detail bodies give up so that steps keep to a budget.
#include "core/dynamics/step_budget.h"

#include <algorithm>

namespace softbody {

void StepBudget::set_limit(double limit) {
	if (limit != limit_) {
		*this = {};
		limit_ = limit;
	}
}

void StepBudget::note_step(double time) {
	if (!(limit_ > 0)) {
		return;
	}
	last_ = time;
	over_ = time > limit_ ? over_ + 1 : 0;
	room_ = time < UP_SHARE * limit_ ? room_ + 1 : 0;
	++since_up_;
	if (over_ >= OVER_TICKS && depth_ < 1 + PARTS) {
		patience_ = since_up_ <= UP_TICKS ? std::min(2 * patience_, MOST_PATIENCE) : 1;
		++depth_;
		over_ = 0;
		since_up_ = UP_TICKS + 1;
	} else if (room_ >= UP_TICKS * patience_ && depth_ > 0) {
		--depth_;
		room_ = 0;
		since_up_ = 0;
	}
}

BudgetLevels StepBudget::levels() const {
	return { depth_ > 0, double(std::max(0, depth_ - 1)) / PARTS };
}

const char *StepBudget::reason() const {
	if (!(limit_ > 0)) {
		return "off";
	}
	if (last_ > limit_) {
		return "over_budget";
	}
	return depth_ == 0 ? "within_budget" : "keeps_room";
}

} // namespace softbody
