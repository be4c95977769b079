// SPDX-License-Identifier: MIT
#include "core/base/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace softbody {

namespace {

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

// Every constant below is a quotient of the definition, rounded, or the binary digits of a number that follow those before it.
constexpr double TURN = 0x1.921fb54442d18p+2;
constexpr double PI = 0x1.921fb54442d18p+1;
constexpr double PI_REST = 0x1.1a62633145c07p-53;
// pi/2 in three parts. The first two have 33 binary digits, so their products with whole numbers below 2^20 are exact.
constexpr std::array<double, 3> QUARTER = { 0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69 };
constexpr double QUARTERS_PER_RADIAN = 0x1.45f306dc9c883p-1;
// ln 2 in two parts. The first has 32 binary digits.
constexpr std::array<double, 2> LOG_2 = { 0x1.62e42feep-1, 0x1.a39ef35793c76p-33 };
constexpr double LOG_2_INVERSE = 0x1.71547652b82fep+0;

// sum of coefficients[i] z^i, from the highest power down.
template <std::size_t COUNT>
double polynomial(const std::array<double, COUNT> &coefficients, double z) {
	double sum = coefficients[COUNT - 1];
	for (std::size_t i = COUNT - 1; i-- > 0;) {
		sum = sum * z + coefficients[i];
	}
	return sum;
}

// (-1)^(i+1) / (first (first + 1) ... ): every term of a Taylor series divides the one before it by two further factors.
template <std::size_t COUNT>
constexpr std::array<double, COUNT> alternating_factorials(int first) {
	std::array<double, COUNT> result{};
	double factorial = 1; // exact up to 18!
	for (int i = 2; i < first; ++i) {
		factorial *= i;
	}
	for (std::size_t i = 0; i < COUNT; ++i) {
		const int n = first + 2 * int(i);
		factorial *= double(n) * (i > 0 ? n - 1 : 1);
		result[i] = (i % 2 == 0 ? -1 : 1) / factorial;
	}
	return result;
}

// On |r| <= pi/4 the first term left out of the sine is below r · 2^-62, of the cosine below 2^-58.
constexpr auto SINE = alternating_factorials<8>(3); // r^3 to r^17
constexpr auto COSINE = [] { // r^4 to r^16
	auto terms = alternating_factorials<8>(2);
	std::array<double, 7> result{};
	std::copy(terms.begin() + 1, terms.end(), result.begin());
	return result;
}();

// 1/2! to 1/15!. On |r| <= ln(2)/2 the first term left out is below r · 2^-67.
constexpr auto EXPONENTIAL = [] {
	std::array<double, 14> result{};
	double factorial = 1;
	for (std::size_t i = 0; i < result.size(); ++i) {
		factorial *= double(i + 2);
		result[i] = 1 / factorial;
	}
	return result;
}();

// -1/3, 1/5 to 1/13. On |u| <= 1/16 the first term left out is below u · 2^-59.
constexpr std::array<double, 6> ARC_TANGENT = { -1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13 };

// 1/3 to 1/21. On |s| <= 3 - sqrt(8) the first term left out is below s · 2^-59.
constexpr std::array<double, 10> AREA_TANGENT = { 1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9, 1.0 / 11, 1.0 / 13, 1.0 / 15, 1.0 / 17,
	1.0 / 19, 1.0 / 21 };

// Arc tangents of k/8, and what rounding left of them.
struct Known {
	double angle;
	double rest;
};
constexpr std::array<Known, 9> KNOWN_ANGLES = { {
		{ 0, 0 },
		{ 0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59 },
		{ 0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57 },
		{ 0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56 },
		{ 0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56 },
		{ 0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58 },
		{ 0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56 },
		{ 0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56 },
		{ 0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55 },
} };

// x = power · ln(2) + remainder, and e^remainder - 1. Needs |x| < 1024.
struct Reduced {
	int power;
	double growth;
};
Reduced reduce_exponent(double x) {
	const double power = std::floor(x * LOG_2_INVERSE + 0.5);
	const double near = x - power * LOG_2[0]; // exact
	const double rest = power * LOG_2[1];
	const double r = near - rest;
	const double lost = (near - r) - rest;
	return { int(power), r + (r * r * polynomial(EXPONENTIAL, r) + lost) };
}

} // namespace

SineCosine sine_cosine(double angle) {
	if (!std::isfinite(angle)) {
		return { NOT_A_NUMBER, NOT_A_NUMBER };
	}
	if (angle == 0) {
		return { angle, 1 }; // keeps the sign of zero
	}
	if (std::abs(angle) > 1e6) {
		angle = std::remainder(angle, TURN);
	}
	// The angle is a whole number of quarter turns and r + lost, |r| <= pi/4.
	const double quarters = std::floor(angle * QUARTERS_PER_RADIAN + 0.5);
	const double near = angle - quarters * QUARTER[0]; // exact
	const double second = quarters * QUARTER[1]; // exact
	const double first = near - second;
	const double back = near - first;
	const double rest = (near - (first + back)) + (back - second) - quarters * QUARTER[2]; // with the rounding error of `first`
	const double r = first + rest;
	const double lost = (first - r) + rest;

	const double z = r * r;
	const double sine = r + (r * z * polynomial(SINE, z) + lost * (1 - z / 2));
	const double large = 1 - z / 2;
	const double cosine = large + (((1 - large) - z / 2) + (z * z * polynomial(COSINE, z) - r * lost));
	switch (int(quarters) & 3) {
		case 0: return { sine, cosine };
		case 1: return { cosine, -sine };
		case 2: return { -sine, -cosine };
		default: return { -cosine, sine };
	}
}

double angle_of(double y, double x) {
	double small = std::min(std::abs(x), std::abs(y));
	double large = std::max(std::abs(x), std::abs(y));
	if (std::isnan(x) || std::isnan(y) || small == INFINITE) {
		return NOT_A_NUMBER;
	}
	if (large > 0x1p+1000) { // so that no sum overflows
		small *= 0x1p-100;
		large *= 0x1p-100;
	} else if (large < 0x1p-900) { // so that products with eighths are exact
		small *= 0x1p+200;
		large *= 0x1p+200;
	}
	// arctan t = arctan c + arctan((t - c) / (1 + t c)), where t is the ratio and c the nearest eighth.
	const int eighths = large > 0 ? int(std::floor(small / large * 8 + 0.5)) : 0;
	double above = small;
	for (int bit = 8; bit > 0; bit /= 2) {
		if ((eighths & bit) != 0) {
			above -= large * (bit / 8.0); // exact: both are within a factor of two of one another
		}
	}
	const double below = eighths > 0 ? large + small * (eighths / 8.0) : large;
	const double u = large > 0 ? above / below : 0;
	const double z = u * u;
	const Known &known = KNOWN_ANGLES[std::size_t(eighths)];
	double angle = known.angle + (u + (u * z * polynomial(ARC_TANGENT, z) + known.rest));
	if (std::abs(y) > std::abs(x)) {
		angle = PI / 2 - (angle - PI_REST / 2);
	}
	if (std::signbit(x)) {
		angle = PI - (angle - PI_REST);
	}
	return std::copysign(angle, y);
}

double hypotenuse(double x, double y) {
	const double large = std::max(std::abs(x), std::abs(y));
	if (large > 0x1p-400 && large < 0x1p+500) {
		return std::sqrt(x * x + y * y);
	}
	if (std::isnan(x) || std::isnan(y)) {
		return NOT_A_NUMBER;
	}
	if (large == 0 || large == INFINITE) {
		return large;
	}
	const int power = large > 1 ? 600 : -600;
	const double a = std::ldexp(x, -power);
	const double b = std::ldexp(y, -power);
	return std::ldexp(std::sqrt(a * a + b * b), power);
}

double exponential(double x) {
	if (!(std::abs(x) < 746)) {
		return std::isnan(x) ? x : (x > 0 ? INFINITE : 0);
	}
	const Reduced reduced = reduce_exponent(x);
	return std::ldexp(1 + reduced.growth, reduced.power);
}

double exponential_minus_one(double x) {
	if (std::abs(x) < 0x1p-54) {
		return x; // keeps the sign of zero
	}
	if (x < -40) {
		return -1;
	}
	if (!(x < 700)) {
		return exponential(x); // one less is the same number
	}
	const Reduced reduced = reduce_exponent(x);
	const double scale = std::ldexp(1.0, reduced.power);
	return (scale - 1) + scale * reduced.growth;
}

double logarithm(double x) {
	int power = 0;
	double m = std::frexp(x, &power);
	if (m < 0.70710678118654752) {
		m *= 2;
		power -= 1;
	}
	const double s = (m - 1) / (m + 1); // ln m = 2 artanh s
	const double z = s * s;
	return power * LOG_2[0] + (2 * s + (2 * s * z * polynomial(AREA_TANGENT, z) + power * LOG_2[1]));
}

double cube_root(double x) {
	if (x == 0 || !std::isfinite(x)) {
		return x;
	}
	int power = 0;
	double m = std::frexp(std::abs(x), &power);
	const int third = (power + 3000) / 3 - 1000; // rounds down, as no power is below -1100
	m = std::ldexp(m, power - 3 * third); // in [1/2, 4)
	double root = 0.7 + 0.24 * m; // within 7 percent, which each step of Newton's squares
	for (int i = 0; i < 4; ++i) {
		root -= (root - m / (root * root)) / 3;
	}
	return std::copysign(std::ldexp(root, third), x);
}

} // namespace softbody
