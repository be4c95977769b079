// SPDX-License-Identifier: MIT
// Turns the bytes of a fuzzer into numbers, most of them ordinary and some of them awful.
#pragma once

#include "core/base/vec2.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace softbody::fuzzing {

/// Reads on and on: at the end come zeros.
class Bytes {
public:
	explicit Bytes(std::span<const std::uint8_t> data) :
			rest_(data) {}

	bool is_empty() const { return rest_.empty(); }
	std::span<const std::uint8_t> rest() const { return rest_; }

	std::uint8_t byte() {
		if (rest_.empty()) {
			return 0;
		}
		const std::uint8_t first = rest_.front();
		rest_ = rest_.subspan(1);
		return first;
	}
	/// In [least, most], which are at most 255 apart.
	int integer(int least, int most) { return least + byte() % (most - least + 1); }
	bool chance() { return byte() % 2 != 0; }
	/// In [-size, size], in 65,536 steps.
	Real real(double size) {
		const int high = byte();
		return Real(size * (double(high * 256 + byte()) / 32767.5 - 1));
	}
	/// In [0, size].
	Real positive(double size) {
		const int high = byte();
		return Real(size * double(high * 256 + byte()) / 65535);
	}
	/// An ordinary number; one time in sixteen one that arithmetic stumbles over.
	Real any(double size) {
		using Limits = std::numeric_limits<Real>;
		static constexpr std::array<Real, 16> AWFUL = { Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
			Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min(), Limits::epsilon(), Real(-0.0), 0, 1, -1,
			Real(1e30), Real(-1e18), Real(1e-20), Real(16777216) };
		const std::uint8_t kind = byte();
		return kind < 16 ? AWFUL[kind] : real(size);
	}
	Vec2 vector(double size) {
		const Real x = real(size);
		return { x, real(size) };
	}
	Vec2 any_vector(double size) {
		const Real x = any(size);
		return { x, any(size) };
	}

private:
	std::span<const std::uint8_t> rest_;
};

} // namespace softbody::fuzzing
