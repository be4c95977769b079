// SPDX-License-Identifier: MIT
// What listeners were told last, where the state of a node goes other ways than the signals.
#pragma once

#include <optional>
#include <utility>

namespace softbody {

/// A value whose changes are told. A state that is put back, or steps in which nothing is told (`StepSignals::is_quiet`), change
/// it without a word. After steps in silence, the next step with signals compares it with what was told last; after a state alone,
/// with the state, so that a replay with signals tells what the first run has told.
template <class Value>
class ToldValue {
public:
	/// Before a state changes `present`.
	void note_restore(const Value &present) {
		if (!told_) {
			told_ = present;
		}
	}
	/// In a step without signals, before `present` changes.
	void note_silence(const Value &present) {
		note_restore(present);
		was_silent_ = true;
	}
	/// In a step with signals, before `present` changes: the value with which to compare.
	Value take(Value present) {
		const bool was_silent = std::exchange(was_silent_, false);
		std::optional<Value> told = std::exchange(told_, std::nullopt);
		return was_silent && told ? std::move(*told) : std::move(present);
	}

private:
	std::optional<Value> told_; ///< if it may be another than the present one
	bool was_silent_ = false;
};

} // namespace softbody
