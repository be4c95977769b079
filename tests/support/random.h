// SPDX-License-Identifier: MIT
// Seeded random numbers that are the same on every platform, unlike the distributions of <random>.
#pragma once

#include "core/base/vec2.h"

#include <cstdint>

namespace softbody::testing {

/// SplitMix64 (Steele, Lea and Flood 2014): one addition and a mix, any seed is a good one.
class Random {
public:
	explicit Random(std::uint64_t seed) :
			state_(seed) {}

	std::uint64_t bits() {
		std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
		z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
		z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
		return z ^ (z >> 31);
	}

	/// An integer in [least, most].
	int integer(int least, int most) { return least + int(bits() % std::uint64_t(most - least + 1)); }

	/// A number in [least, most).
	Real real(double least, double most) {
		return Real(least + (most - least) * (double(bits() >> 11) / 9007199254740992.0)); // 2^53
	}

	bool chance(double share) { return real(0, 1) < share; }

	/// A point of the square [-size, size)².
	Vec2 vector(double size) {
		const Real x = real(-size, size);
		return { x, real(-size, size) };
	}

private:
	std::uint64_t state_;
};

} // namespace softbody::testing
