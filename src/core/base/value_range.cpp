// SPDX-License-Identifier: MIT
// A range as a value, for tables of parameters.
#include "core/base/value_range.h"

#include "core/base/real.h"

#include <cmath>

namespace softbody {

Status ValueRange::check(const std::string &name, double value) const {
	if (excludes_minimum) {
		return check_above(name, double(Real(value)), minimum, unit);
	}
	if (std::isfinite(maximum)) {
		return check_between(name, value, minimum, maximum, unit);
	}
	return std::isfinite(minimum) ? check_at_least(name, value, minimum, unit) : check_finite(name, value, unit);
}

} // namespace softbody
