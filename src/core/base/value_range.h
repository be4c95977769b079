// SPDX-License-Identifier: MIT
// A range as a value, for tables of parameters.
#pragma once

#include "core/base/error.h"

#include <limits>
#include <string>

namespace softbody {

/// The numbers that a parameter takes. All are finite.
struct ValueRange {
	double minimum = -std::numeric_limits<double>::infinity();
	double maximum = std::numeric_limits<double>::infinity();
	const char *unit = "";
	bool excludes_minimum = false;

	static constexpr ValueRange at_least(double least, const char *unit = "") { return { .minimum = least, .unit = unit }; }
	static constexpr ValueRange above(double bound, const char *unit = "") {
		return { .minimum = bound, .unit = unit, .excludes_minimum = true };
	}
	static constexpr ValueRange between(double least, double most) { return { least, most }; }

	/// Refuses a value outside, by this name. Above a bound means above it as a `Real`, too.
	Status check(const std::string &name, double value) const;
};

} // namespace softbody
