// SPDX-License-Identifier: MIT
// Claims about how the core refuses bad input.
#include "core/base/error.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <array>
#include <span>
#include <string>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("a refusal names the parameter, the value, the bound with its unit, and a remedy") {
	const Status status = check_at_least("stiffness", -5, 0, "N/m");
	REQUIRE(status.has_value());
	CHECK(status->name == "stiffness");
	CHECK(status->value == "-5");
	CHECK(mentions(status->bound, ">= 0 N/m"));
	CHECK_FALSE(status->remedy.empty());
	const std::string message = status->message();
	for (const std::string &part : { status->name, status->value, status->bound, status->remedy }) {
		CHECK(mentions(message, part));
	}
}

TEST_CASE("the remedy for a number out of range differs from that for a failed computation") {
	const Status out_of_range = check_above("mass", -1, 0, "kg");
	const Status failed = check_above("mass", NAN, 0, "kg");
	REQUIRE((out_of_range && failed));
	CHECK(out_of_range->remedy != failed->remedy);
	CHECK(mentions(failed->remedy, "computation"));
}

TEST_CASE("bounds are inclusive in check_at_least and check_between, exclusive in check_above") {
	CHECK_FALSE(check_at_least("value", 2, 2, ""));
	CHECK(check_at_least("value", std::nextafter(2.0, 0.0), 2, ""));
	CHECK(check_above("value", 2, 2, ""));
	CHECK_FALSE(check_above("value", std::nextafter(2.0, 3.0), 2, ""));
	CHECK_FALSE(check_between("value", 1, 1, 3, ""));
	CHECK_FALSE(check_between("value", 3, 1, 3, ""));
	CHECK(check_between("value", std::nextafter(1.0, 0.0), 1, 3, ""));
	CHECK(check_between("value", std::nextafter(3.0, 4.0), 1, 3, ""));
}

TEST_CASE("no check accepts nan or an infinity") {
	for (const double bad : { double(NAN), double(INFINITY), -double(INFINITY) }) {
		CAPTURE(bad);
		CHECK(check_finite("value", bad, ""));
		CHECK(check_at_least("value", bad, -1e300, ""));
		CHECK(check_above("value", bad, -1e300, ""));
		CHECK(check_between("value", bad, -1e300, 1e300, ""));
	}
	CHECK_FALSE(check_finite("value", 1e300, ""));
}

TEST_CASE("both ends of a range and the unit stand in the message") {
	const Status status = check_between("friction", 3, 0.25, 2, "apples");
	REQUIRE(status.has_value());
	CHECK(mentions(status->bound, "0.25"));
	CHECK(mentions(status->bound, "2 apples"));
	const Status finite = check_finite("angle", NAN, "rad");
	REQUIRE(finite.has_value());
	CHECK(mentions(finite->bound, "rad"));
}

TEST_CASE("numbers are written as a person would") {
	CHECK(number_text(0.1) == "0.1");
	CHECK(number_text(-5) == "-5");
	CHECK(number_text(4096) == "4096");
	CHECK(number_text(NAN) == "nan");
	CHECK(number_text(INFINITY) == "inf");
	CHECK(number_text(-INFINITY) == "-inf");
}

TEST_CASE("a result holds either its value or its error") {
	const Result<int> good(7);
	CHECK(good.has_value());
	CHECK(bool(good));
	CHECK(good.value() == 7);
	const Result<int> bad(Error{ "name", "value", "bound", "remedy" });
	CHECK_FALSE(bad.has_value());
	CHECK_FALSE(bool(bad));
	CHECK(bad.error().name == "name");
}

TEST_CASE("of several checks the first refusal counts") {
	CHECK_FALSE(first_error({}));
	CHECK_FALSE(first_error({ check_finite("a", 1, ""), check_finite("b", 2, "") }));
	const Status status = first_error({ check_finite("a", 1, ""), check_finite("b", NAN, ""), check_finite("c", NAN, "") });
	REQUIRE(status.has_value());
	CHECK(status->name == "b");
}

TEST_CASE("vectors are refused with both coordinates, of several the first by its index") {
	const Vec2 bad{ 3, Real(NAN) };
	CHECK_FALSE(check_finite("place", Vec2{ 3, 4 }));
	const Status one = check_finite("place", bad);
	REQUIRE(one.has_value());
	CHECK(one->value == "(3, nan)");
	const std::array<Vec2, 3> places = { Vec2{}, bad, bad };
	const Status several = check_all_finite("places", places);
	REQUIRE(several.has_value());
	CHECK(several->name == "places[1]");
	CHECK_FALSE(check_all_finite("places", std::span(places).first(1)));
}

TEST_CASE("indices end before the count, and unit vectors may be off by a thousandth") {
	CHECK_FALSE(check_index("point", 2, 3, "count again"));
	CHECK(check_index("point", 3, 3, "count again")->remedy == "count again");
	CHECK_FALSE(check_unit_length("normal", { 0, Real(1.0005) }));
	CHECK(check_unit_length("normal", { 0, Real(1.002) }));
	CHECK(check_unit_length("normal", { Real(NAN), 1 }));
}
