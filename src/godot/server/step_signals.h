// SPDX-License-Identifier: MIT
// Signals of a step, kept until every node is up to date.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace softbody {

/// Signals of one step. A listener may free any node, change any property, add and remove bodies: a sender is known by
/// its instance id, and looked up only when its signal is emitted.
class StepSignals {
public:
	/// Quiet signals are dropped, as in a replay.
	explicit StepSignals(bool p_is_quiet = false) : is_quiet_(p_is_quiet) {}
	bool is_quiet() const { return is_quiet_; }
	/// `p_emit` is called by `emit` if the object `p_sender` still exists, and may use it until a listener has been
	/// called.
	void add(uint64_t p_sender, std::function<void()> p_emit) {
		if (!is_quiet_) {
			pending_.push_back({ p_sender, std::move(p_emit) });
		}
	}
	/// Emits the signals in the order in which they were added.
	void emit();

private:
	struct Pending {
		uint64_t sender; ///< instance id
		std::function<void()> emit;
	};
	std::vector<Pending> pending_;
	bool is_quiet_;
};

} // namespace softbody
