// SPDX-License-Identifier: MIT
// A scene that goes on for hours: bodies at rest, bodies that are stirred for ever, bodies that come and go.
#pragma once

#include <cstddef>
#include <functional>

namespace softbody::testing {

struct SoakResult {
	double hours = 0; ///< simulated
	double drift = 0; ///< of the farthest point of a square at rest that is kept awake, from when it had settled [px]
	double round_drift = 0; ///< likewise of a circle, which rolls
	double sleeping_drift = 0; ///< likewise of those that may sleep
	std::size_t lost = 0; ///< bodies outside their walls at any look, once a second
	std::size_t resets = 0;
	std::ptrdiff_t growth = 0; ///< of the memory taken, from after the first simulated minute to the end [bytes]
};

/// Runs `seconds` of it, more than 90. `allocated`: bytes in use now.
SoakResult soak(double seconds, const std::function<std::size_t()> &allocated);

} // namespace softbody::testing
