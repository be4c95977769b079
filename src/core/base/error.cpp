// SPDX-License-Identifier: MIT
// Builds the sentences with which the core refuses bad input.
#include "core/base/error.h"

#include <cmath>
#include <cstdio>

namespace softbody {

namespace {

std::string with_unit(const std::string &text, const std::string &unit) {
	return unit.empty() ? text : text + " " + unit;
}

Error refused(const std::string &name, double value, const std::string &bound) {
	const char *remedy = std::isfinite(value) ? "give a value inside the bound"
											  : "check the computation that produced this value";
	return { name, number_text(value), "must be " + bound, remedy };
}

} // namespace

std::string Error::message() const {
	return name + " = " + value + " " + bound + "; " + remedy;
}

std::string number_text(double value) {
	if (std::isnan(value)) {
		return "nan";
	}
	if (std::isinf(value)) {
		return value > 0 ? "inf" : "-inf";
	}
	char text[32];
	std::snprintf(text, sizeof(text), "%.6g", value);
	return text;
}

Status check_finite(const std::string &name, double value, const std::string &unit) {
	if (std::isfinite(value)) {
		return {};
	}
	return refused(name, value, unit.empty() ? "finite" : "finite [" + unit + "]");
}

Status check_at_least(const std::string &name, double value, double minimum, const std::string &unit) {
	if (std::isfinite(value) && value >= minimum) {
		return {};
	}
	return refused(name, value, "finite and >= " + with_unit(number_text(minimum), unit));
}

Status check_above(const std::string &name, double value, double bound, const std::string &unit) {
	if (std::isfinite(value) && value > bound) {
		return {};
	}
	return refused(name, value, "finite and > " + with_unit(number_text(bound), unit));
}

Status check_between(const std::string &name, double value, double minimum, double maximum, const std::string &unit) {
	if (std::isfinite(value) && value >= minimum && value <= maximum) {
		return {};
	}
	return refused(name, value,
			"between " + number_text(minimum) + " and " + with_unit(number_text(maximum), unit));
}

} // namespace softbody
