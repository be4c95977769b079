// SPDX-License-Identifier: MIT
// Functions of mathematics whose bits are the same everywhere: how near they are, and that they are the same.
#include "core/base/elementary.h"
#include "scenes/mixed.h"
#include "support/random.h"
#include "support/skip.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr int COUNT = 200000;

// As Real may be a float, which has too few digits to draw a double from.
double draw(Random &random, double least, double most) {
	return least + (most - least) * (double(random.bits() >> 11) / 9007199254740992.0);
}

// Of either sign, with a power of two drawn evenly.
double draw_spread(Random &random, int least_power, int most_power) {
	const int power = random.integer(least_power, most_power); // a draw a line, as compilers differ in the order of arguments
	const double size = std::ldexp(draw(random, 1, 2), power);
	return random.bits() % 2 == 0 ? size : -size;
}

bool is_negative_zero(double x) {
	return x == 0 && std::signbit(x);
}

// Distance of two numbers of the wide type, in units in the last place that a double beside `exact` has.
double units(double got, long double exact) {
	const double size = std::fmax(std::abs(double(exact)), std::numeric_limits<double>::min());
	const double unit = std::nextafter(size, INFINITE) - size;
	return double(std::abs((long double)got - exact) / unit);
}

// Whether the library computes with at least 64 digits. That of Windows says so, but asks a unit for sines that knows pi to 66.
bool has_wide_library() {
#ifdef _WIN32
	return false;
#else
	return std::numeric_limits<long double>::digits >= 64;
#endif
}

using Function = std::function<double(double)>;
using Exact = std::function<long double(long double)>;

double largest_error(const Function &function, const Exact &exact, const std::function<double(Random &)> &argument) {
	Random random(24);
	double worst = 0;
	for (int i = 0; i < COUNT; ++i) {
		const double x = argument(random);
		worst = std::fmax(worst, units(function(x), exact(x)));
	}
	return worst;
}

double sine_of(double x) { return sine_cosine(x).sine; }
double cosine_of(double x) { return sine_cosine(x).cosine; }

long double wide_sine(long double x) { return std::sin(x); }
long double wide_cosine(long double x) { return std::cos(x); }

} // namespace

TEST_CASE("sine and cosine are within a unit in the last place") {
	if (!has_wide_library()) {
		SKIP_TEST("no wider library to compare with");
	}
	const auto near = [](Random &random) { return draw(random, -4, 4); };
	const auto far = [](Random &random) { return draw(random, -1e6, 1e6); };
	const auto small = [](Random &random) { return draw_spread(random, -60, 2); };
	for (const auto &argument : { std::function<double(Random &)>(near), std::function<double(Random &)>(far), std::function<double(Random &)>(small) }) {
		CHECK(largest_error(sine_of, wide_sine, argument) < 1);
		CHECK(largest_error(cosine_of, wide_cosine, argument) < 1);
	}
}

TEST_CASE("a huge angle is off by no more than half a unit of its own last place") {
	if (!has_wide_library()) {
		SKIP_TEST("no wider library to compare with");
	}
	Random random(24);
	for (int i = 0; i < COUNT; ++i) {
		const double angle = draw_spread(random, 20, 40);
		const double bound = std::abs(angle) * 0x1p-53 + 0x1p-52;
		CHECK(double(std::abs(sine_of(angle) - wide_sine(angle))) <= bound);
		CHECK(double(std::abs(cosine_of(angle) - wide_cosine(angle))) <= bound);
	}
}

TEST_CASE("the other elementary functions are as near as their headers say") {
	if (!has_wide_library()) {
		SKIP_TEST("no wider library to compare with");
	}
	const auto unit_range = [](Random &random) { return draw(random, -1, 1); };
	const auto whole_range = [](Random &random) { return draw(random, -700, 700); };
	const auto small = [](Random &random) { return draw_spread(random, -60, 3); };
	const auto positive = [](Random &random) { return std::abs(draw_spread(random, -1020, 1020)); };
	const auto near_one = [](Random &random) { return 1 + draw_spread(random, -40, -2); };
	const auto any = [](Random &random) { return draw_spread(random, -1060, 1020); };
	for (const auto &argument : { std::function<double(Random &)>(unit_range), std::function<double(Random &)>(whole_range), std::function<double(Random &)>(small) }) {
		CHECK(largest_error(exponential, [](long double x) { return std::exp(x); }, argument) < 1);
		CHECK(largest_error(exponential_minus_one, [](long double x) { return std::expm1(x); }, argument) < 2);
	}
	for (const auto &argument : { std::function<double(Random &)>(positive), std::function<double(Random &)>(near_one) }) {
		CHECK(largest_error(logarithm, [](long double x) { return std::log(x); }, argument) < 2.5);
	}
	CHECK(largest_error(cube_root, [](long double x) { return std::cbrt(x); }, any) < 1);
}

TEST_CASE("angles and lengths of vectors are within two units in the last place") {
	if (!has_wide_library()) {
		SKIP_TEST("no wider library to compare with");
	}
	Random random(24);
	double worst_angle = 0;
	double worst_length = 0;
	for (const int powers : { 1, 60, 1000 }) {
		for (int i = 0; i < COUNT; ++i) {
			const double x = draw_spread(random, -powers, powers);
			const double y = draw_spread(random, -powers, powers);
			const long double angle = std::atan2((long double)y, (long double)x);
			if (std::abs(angle) > (long double)std::numeric_limits<double>::min()) {
				worst_angle = std::fmax(worst_angle, units(angle_of(y, x), angle));
			}
			worst_length = std::fmax(worst_length, units(hypotenuse(x, y), std::hypot((long double)x, (long double)y)));
		}
	}
	CHECK(worst_angle < 2);
	CHECK(worst_length < 2);
}

// Computed with 300 binary digits by another program. The first six angles are the doubles below 1e6 that lie nearest to a
// multiple of pi/2.
TEST_CASE("values next to where digits cancel agree with a program of many digits") {
	struct Turn {
		double angle, sine, cosine;
	};
	for (const Turn &turn : {
				 Turn{ 0x1.6c6cbc45dc8dep+5, 0x1.0000000000000p+0, -0x1.6d61b58c99c43p-61 },
				 Turn{ 0x1.6c6cbc45dc8dep+6, -0x1.6d61b58c99c43p-60, -0x1.0000000000000p+0 },
				 Turn{ 0x1.6c6cbc45dc8dep+7, 0x1.6d61b58c99c43p-59, 0x1.0000000000000p+0 },
				 Turn{ 0x1.6c6cbc45dc8dep+8, 0x1.6d61b58c99c43p-58, 0x1.0000000000000p+0 },
				 Turn{ 0x1.6c6cbc45dc8dep+9, 0x1.6d61b58c99c43p-57, 0x1.0000000000000p+0 },
				 Turn{ 0x1.6c6cbc45dc8dep+10, 0x1.6d61b58c99c43p-56, 0x1.0000000000000p+0 },
				 Turn{ 0x1.4f8b588e368f1p-17, 0x1.4f8b588e1e8a2p-17, 0x1.ffffffff920c8p-1 },
				 Turn{ 0x1.921fb54442d15p-1, 0x1.6a09e667f3bcap-1, 0x1.6a09e667f3bcfp-1 },
				 Turn{ 0x1.921fb54442d1ep-1, 0x1.6a09e667f3bd1p-1, 0x1.6a09e667f3bc9p-1 },
				 Turn{ 0x1.4000000000000p+1, 0x1.326af0dcfcab1p-1, -0x1.9a2f7ef858b7dp-1 },
				 Turn{ 0x1.9000000000000p+6, -0x1.03425b78c4db8p-1, 0x1.b981dbf665fdfp-1 },
				 Turn{ 0x1.6000000000000p+4, -0x1.220a29f6eb9f4p-7, -0x1.fffadd8d4acdap-1 },
				 Turn{ 0x1.6300000000000p+8, -0x1.f9bd0307d1de3p-16, -0x1.fffffffc18e4cp-1 },
				 Turn{ 0x1.e847fc0000000p+19, -0x1.db3076758c873p-2, 0x1.c5889dec64d25p-1 },
		}) {
		CAPTURE(turn.angle);
		CHECK(units(sine_of(turn.angle), turn.sine) <= 1);
		CHECK(units(cosine_of(turn.angle), turn.cosine) <= 1);
	}
	struct Value {
		Function function;
		double x, exact;
	};
	for (const Value &value : {
				 Value{ exponential, -0x1.6200000000000p+9, 0x1.7c8ab2288c9abp-1022 },
				 Value{ exponential, -0x1.0000000000000p+0, 0x1.78b56362cef38p-2 },
				 Value{ exponential, 0x1.62e42fefa39efp-2, 0x1.6a09e667f3bccp+0 },
				 Value{ exponential, 0x1.0000000000000p+0, 0x1.5bf0a8b145769p+1 },
				 Value{ exponential, 0x1.62c0000000000p+9, 0x1.81e9b4b52d0c9p+1023 },
				 Value{ exponential_minus_one, -0x1.e000000000000p+4, -0x1.ffffffffffcb5p-1 },
				 Value{ exponential_minus_one, -0x1.62e42fefa39efp-2, -0x1.2bec333018867p-2 },
				 Value{ exponential_minus_one, -0x1.12e0be826d695p-30, -0x1.12e0be801f1d9p-30 },
				 Value{ exponential_minus_one, 0x1.0624dd2f1a9fcp-10, 0x1.06466dfb8cf3ap-10 },
				 Value{ exponential_minus_one, 0x1.6666666666666p-2, 0x1.ad200b20177b2p-2 },
				 Value{ exponential_minus_one, 0x1.9000000000000p+5, 0x1.19103e4080b45p+72 },
				 Value{ exponential_minus_one, 0x1.6280000000000p+9, 0x1.d422d2be5dc9bp+1022 },
				 Value{ logarithm, 0x1.6a09e667f3bccp-1, -0x1.62e42fefa39f1p-2 },
				 Value{ logarithm, 0x1.6a09e667f3bcdp-1, -0x1.62e42fefa39eep-2 },
				 Value{ logarithm, 0x1.fffffffffffffp-1, -0x1.0000000000000p-53 },
				 Value{ logarithm, 0x1.0000000000001p+0, 0x1.fffffffffffffp-53 },
				 Value{ logarithm, 0x1.56e1fc2f8f359p-997, -0x1.5963447f87fb5p+9 },
				 Value{ logarithm, 0x1.4000000000000p+3, 0x1.26bb1bbb55516p+1 },
				 Value{ cube_root, 0x1.0000000000000p+1, 0x1.428a2f98d728bp+0 },
				 Value{ cube_root, 0x0.00000000007e8p-1022, 0x1.94c7f15ef7ddfp-355 },
				 Value{ cube_root, 0x1.fffffffffffffp+1, 0x1.965fea53d6e3cp+0 },
				 Value{ cube_root, 0x1.999999999999ap-4, 0x1.db4c7760bcff3p-2 },
				 Value{ cube_root, 0x1.7e43c8800759cp+996, 0x1.249ad2594c37dp+332 },
		}) {
		CAPTURE(value.x);
		CHECK(units(value.function(value.x), value.exact) <= 1);
	}
	struct Vector {
		double x, y, angle, length;
	};
	for (const Vector &vector : {
				 Vector{ 0x1.0000000000000p+0, 0x1.0000000000000p-4, 0x1.ff55bb72cfdeap-5, 0x1.007fe00ff6070p+0 },
				 Vector{ 0x1.0000000000000p+3, 0x1.0000000000000p+0, 0x1.fd5ba9aac2f6ep-4, 0x1.01fe03f61bad0p+3 },
				 Vector{ -0x1.8000000000000p+1, 0x1.0000000000000p+0, 0x1.68f095fdf593cp+1, 0x1.94c583ada5b53p+1 },
				 Vector{ 0x1.5798ee2308c3ap-27, -0x1.0000000000000p+0, -0x1.921fb5194fb3cp+0, 0x1.0000000000000p+0 },
				 Vector{ -0x1.0000000000000p+0, 0x1.70ef54646d497p-57, 0x1.921fb54442d18p+1, 0x1.0000000000000p+0 },
				 Vector{ 0x1.3333333333333p-2, 0x1.999999999999ap-2, 0x1.dac670561bb50p-1, 0x1.0000000000000p-1 },
				 Vector{ -0x1.6666666666666p-1, -0x1.666669c164b9cp-1, -0x1.2d97c759cdd82p+1, 0x1.fadaab5755437p-1 },
				 Vector{ 0x1.0000000000000p+0, 0x1.bffff94a03595p-2, 0x1.a64ee69ac6b9ap-2, 0x1.176d8fe4a11c7p+0 },
				 Vector{ 0x1.87e92154ef7acp-665, 0x1.39874ddd8c623p-668, 0x1.983e282e2cc4cp-4, 0x1.89dd8729181ecp-665 },
		}) {
		CAPTURE(vector.x);
		CAPTURE(vector.y);
		CHECK(units(angle_of(vector.y, vector.x), vector.angle) <= 1);
		CHECK(units(hypotenuse(vector.x, vector.y), vector.length) <= 1);
	}
}

TEST_CASE("borders of elementary functions are those of IEEE 754") {
	CHECK(std::isnan(sine_cosine(INFINITE).sine));
	CHECK(std::isnan(sine_cosine(NOT_A_NUMBER).cosine));
	CHECK(is_negative_zero(sine_of(-0.0)));
	CHECK(cosine_of(-0.0) == 1);

	CHECK(angle_of(0, 1) == 0);
	CHECK(is_negative_zero(angle_of(-0.0, 1)));
	CHECK(angle_of(0, -1) == 0x1.921fb54442d18p+1);
	CHECK(angle_of(-0.0, -1) == -0x1.921fb54442d18p+1);
	CHECK(angle_of(0, 0) == 0);
	CHECK(angle_of(0, -0.0) == 0x1.921fb54442d18p+1);
	CHECK(angle_of(-1, 0) == -0x1.921fb54442d18p+0);
	CHECK(angle_of(INFINITE, 5) == 0x1.921fb54442d18p+0);
	CHECK(angle_of(5, INFINITE) == 0);
	CHECK(angle_of(5, -INFINITE) == 0x1.921fb54442d18p+1);
	CHECK(angle_of(1e308, 1e308) == 0x1.921fb54442d18p-1);
	CHECK(angle_of(5e-324, 5e-324) == 0x1.921fb54442d18p-1);
	CHECK(std::isnan(angle_of(NOT_A_NUMBER, 1)));
	CHECK(std::isnan(angle_of(1, NOT_A_NUMBER)));

	CHECK(hypotenuse(0, -0.0) == 0);
	CHECK(hypotenuse(-3, 4) == 5);
	CHECK(hypotenuse(0x1.8p+1000, 0x1p+1001) == 0x1.4p+1001);
	CHECK(hypotenuse(0x1.8p-1000, 0x1p-999) == 0x1.4p-999);
	CHECK(hypotenuse(-INFINITE, 1) == INFINITE);
	CHECK(std::isnan(hypotenuse(1, NOT_A_NUMBER)));
	CHECK(std::isnan(hypotenuse(NOT_A_NUMBER, 1)));

	CHECK(exponential(0) == 1);
	CHECK(exponential(710) == INFINITE);
	CHECK(exponential(INFINITE) == INFINITE);
	CHECK(exponential(-746) == 0);
	CHECK(exponential(-INFINITE) == 0);
	CHECK(exponential(-745) == 5e-324);
	CHECK(std::isnan(exponential(NOT_A_NUMBER)));
	CHECK(is_negative_zero(exponential_minus_one(-0.0)));
	CHECK(exponential_minus_one(1e-300) == 1e-300);
	CHECK(exponential_minus_one(-INFINITE) == -1);
	CHECK(exponential_minus_one(INFINITE) == INFINITE);
	CHECK(std::isnan(exponential_minus_one(NOT_A_NUMBER)));

	CHECK(logarithm(1) == 0);
	CHECK(logarithm(2) == 0x1.62e42fefa39efp-1);
	CHECK(cube_root(27) == 3);
	CHECK(cube_root(-8) == -2);
	CHECK(is_negative_zero(cube_root(-0.0)));
	CHECK(cube_root(-INFINITE) == -INFINITE);
	CHECK(std::isnan(cube_root(NOT_A_NUMBER)));
}

// The one claim here of bits: found on x86-64, and what every other processor and system must find as well.
TEST_CASE("elementary functions have the same bits everywhere") {
	Random random(5);
	BitHash hash;
	for (int i = 0; i < 20000; ++i) {
		const double angle = draw_spread(random, -30, 30);
		const SineCosine turn = sine_cosine(angle);
		hash.add(turn.sine);
		hash.add(turn.cosine);
		hash.add(angle_of(turn.sine, turn.cosine));
		const double x = draw_spread(random, -20, 8);
		hash.add(hypotenuse(angle, x));
		hash.add(exponential(x));
		hash.add(exponential_minus_one(-std::abs(x)));
		hash.add(logarithm(std::abs(angle)));
		hash.add(cube_root(angle));
	}
	CHECK(hash.value() == 0xf00e0473fc48b165u);
}
