// SPDX-License-Identifier: MIT
// Builds the sentences with which the core refuses bad input.
#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace softbody {

namespace {

std::string with_unit(const std::string &text, const std::string &unit) {
	return unit.empty() ? text : text + " " + unit;
}

constexpr const char *CHECK_COMPUTATION = "check the computation that produced this value";

Error refused(const std::string &name, double value, const std::string &bound) {
	return { name, number_text(value), "must be " + bound,
		std::isfinite(value) ? "give a value inside the bound" : CHECK_COMPUTATION };
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

Status check_finite(const std::string &name, Vec2 value) {
	if (is_finite(value)) {
		return {};
	}
	return Error{ name, "(" + number_text(value.x) + ", " + number_text(value.y) + ")", "must be finite", CHECK_COMPUTATION };
}

Status check_all_finite(const std::string &name, std::span<const Vec2> values) {
	const auto bad = std::ranges::find_if_not(values, is_finite);
	return bad == values.end() ? Status() : check_finite(name + "[" + std::to_string(bad - values.begin()) + "]", *bad);
}

Status check_unit_length(const std::string &name, Vec2 value, const std::string &remedy) {
	if (std::abs(length(value) - 1) <= Real(1e-3)) { // false for NaN
		return {};
	}
	return Error{ name, "length " + number_text(length(value)), "must have unit length", remedy };
}

Status check_index(const std::string &name, std::size_t index, std::size_t count, const std::string &remedy) {
	if (index < count) {
		return {};
	}
	return Error{ name, std::to_string(index), "must be below " + std::to_string(count), remedy };
}

Status first_error(std::initializer_list<Status> checks) {
	const auto refusal = std::ranges::find_if(checks, [](const Status &check) { return check.has_value(); });
	return refusal == checks.end() ? Status() : *refusal;
}

} // namespace softbody
