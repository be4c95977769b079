// SPDX-License-Identifier: MIT
// The time of a step by its phases, where the caller gives a clock.
#pragma once

#include <functional>

namespace softbody {

/// Returns a time [s] that grows. The core owns no clock.
using Clock = std::function<double()>;

/// Time of the phases of a step [s]. All are 0 without a clock.
struct StepProfile {
	double begin = 0; ///< taking over changes, sorting colliders, waking
	double broad_phase = 0; ///< finding pairs of bodies that may touch, and choosing substeps
	double bodies = 0; ///< forces, integration, environment contacts, limits
	double pair_contacts = 0; ///< contacts between bodies
	double couplings = 0; ///< joints, rigid bodies, contacts of bodies with themselves
	double end = 0; ///< reports and sleep

	double total() const { return begin + broad_phase + bodies + pair_contacts + couplings + end; }
};

/// Adds the time since the last lap to a phase.
class PhaseTimer {
public:
	explicit PhaseTimer(const Clock &clock) : clock_(clock) {}
	void start() { last_ = clock_ ? clock_() : 0; }
	void lap(double &phase) {
		if (clock_) {
			const double now = clock_();
			phase += now - last_;
			last_ = now;
		}
	}

private:
	const Clock &clock_;
	double last_ = 0;
};

} // namespace softbody
