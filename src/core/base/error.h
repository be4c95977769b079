// SPDX-License-Identifier: MIT
// How the core refuses bad input: a value that says what was wrong and what to do, never an exception.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

namespace softbody {

/// One refused input. Every field is filled, so that a caller can build its own sentence.
struct Error {
	std::string name; ///< the parameter, as the public interface spells it ("stiffness", "hull[3]")
	std::string value; ///< what was given, as text ("-5", "nan", "points 1 and 4")
	std::string bound; ///< what is allowed ("must be finite and >= 0 N/m")
	std::string remedy; ///< what to do about it

	/// "stiffness = -5 must be finite and >= 0 N/m; give a positive value"
	std::string message() const;
};

/// Outcome of a check or setter: empty when accepted. After an error the state is unchanged.
using Status = std::optional<Error>;

/// Either a value or the error that kept it from being made.
template <typename T>
class [[nodiscard]] Result {
public:
	Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
	Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

	bool has_value() const { return content_.index() == 0; }
	explicit operator bool() const { return has_value(); }
	/// Precondition: `has_value()`.
	T &value() { return *std::get_if<0>(&content_); }
	const T &value() const { return *std::get_if<0>(&content_); }
	/// Precondition: `!has_value()`.
	const Error &error() const { return *std::get_if<1>(&content_); }

private:
	std::variant<T, Error> content_;
};

/// Range checks that all setters and creators share. Bounds are inclusive; `unit` may be empty.
Status check_finite(const std::string &name, double value, const std::string &unit);
Status check_at_least(const std::string &name, double value, double minimum, const std::string &unit);
Status check_above(const std::string &name, double value, double bound, const std::string &unit);
Status check_between(const std::string &name, double value, double minimum, double maximum, const std::string &unit);
/// Both coordinates; of several vectors the first that is not finite is refused as "name[i]".
Status check_finite(const std::string &name, Vec2 value);
Status check_all_finite(const std::string &name, std::span<const Vec2> values);
/// Refuses vectors that are not of unit length (to 1e-3).
Status check_unit_length(const std::string &name, Vec2 value, const std::string &remedy = "normalize the vector");
Status check_index(const std::string &name, std::size_t index, std::size_t count, const std::string &remedy);

/// The first refusal of several checks, which are all made.
Status first_error(std::initializer_list<Status> checks);

/// Number as a person would write it (shortest form, "nan", "inf").
std::string number_text(double value);

} // namespace softbody
