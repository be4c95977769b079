// SPDX-License-Identifier: MIT
// The functions of mathematics that a library may round as it likes, computed by the same operations everywhere.
#pragma once

namespace softbody {

// IEEE 754 rounds sums, products, quotients and square roots. It does not round sines or exponentials, so the last digit of
// std::sin, std::hypot or std::exp depends on the library. A step may call none of them. These functions use rounded
// operations in a fixed order and exact ones (floor, ldexp, frexp), so their bits are the same wherever -ffp-contract=off
// holds. Every function takes and returns doubles. Rounded to float, its result is the correctly rounded one except beside a
// midpoint of two floats. Errors are in units in the last place of the double result; tests/base/test_elementary.cpp holds
// them against long double.

struct SineCosine {
	double sine = 0;
	double cosine = 1;
};

/// Sine and cosine of an angle [rad], each within 1 unit in the last place where |angle| <= 1e6. A larger angle is first
/// brought below a turn by a remainder whose error is at most |angle| · 2^-53, half a unit in the last place of the angle.
/// NaN for an infinite angle.
SineCosine sine_cosine(double angle);

/// Angle of (x, y) in [-pi, pi], positive from x towards y, within 2 units in the last place. Signs of zeros decide as in
/// std::atan2: (-1, 0) has pi, (-1, -0.0) has -pi. NaN for NaN and for two infinite coordinates.
double angle_of(double y, double x);

/// Length of (x, y), within 2 units in the last place, without overflow or underflow in between.
double hypotenuse(double x, double y);

/// e^x, within 1 unit in the last place. Results below 2^-1022 are rounded once more, and are 0 below e^-746.
double exponential(double x);

/// e^x - 1, within 2 units in the last place, for any x: also where e^x is near 1.
double exponential_minus_one(double x);

/// Natural logarithm, within 2.5 units in the last place. Needs x > 0 and finite.
double logarithm(double x);

/// Cube root, within 1 unit in the last place. 0, infinity and NaN are their own cube roots.
double cube_root(double x);

} // namespace softbody
