// SPDX-License-Identifier: MIT
// Several scalars side by side, so that one instruction steps several like bodies.
#pragma once

#include "core/base/real.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace softbody {

/// How many bodies are stepped side by side. Four floats fill the vector registers that every 64-bit
/// x86 and ARM processor has; a pack of doubles takes two of them.
inline constexpr std::size_t PACK_WIDTH = 4;

namespace detail {

#if defined(__GNUC__) || defined(__clang__)
#define SOFTBODY_VECTOR_EXTENSION
typedef Real PackReals __attribute__((vector_size(PACK_WIDTH * sizeof(Real))));
typedef decltype(PackReals{} < PackReals{}) PackBits;
#else
using PackReals = std::array<Real, PACK_WIDTH>;
using PackBits = std::array<bool, PACK_WIDTH>;
#endif

} // namespace detail

/// The answer of a comparison for every lane of a pack.
struct PackMask {
	detail::PackBits lanes;

	bool operator[](std::size_t lane) const { return lanes[lane]; }
#ifdef SOFTBODY_VECTOR_EXTENSION
	friend PackMask both(PackMask a, PackMask b) { return { a.lanes & b.lanes }; }
	friend PackMask operator!(PackMask a) { return { ~a.lanes }; }
#else
	friend PackMask both(PackMask a, PackMask b) {
		for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
			a.lanes[i] = a.lanes[i] && b.lanes[i];
		}
		return a;
	}
	friend PackMask operator!(PackMask a) {
		for (bool &lane : a.lanes) {
			lane = !lane;
		}
		return a;
	}
#endif
};

/// PACK_WIDTH scalars, each of which goes through the same operations as a single `Real` would, with the
/// same roundings: code written for any scalar type T gives the same bits for `Real` as for a lane of this.
/// A `Real` converts to a pack of equal lanes.
class RealPack {
public:
	RealPack() = default;
	RealPack(Real value) { set_all(value); }

	Real operator[](std::size_t lane) const { return lanes_[lane]; }
	void set(std::size_t lane, Real value) { lanes_[lane] = value; }
	const detail::PackReals &lanes() const { return lanes_; }
	static RealPack of_lanes(detail::PackReals lanes) { return RealPack(lanes); }

#ifdef SOFTBODY_VECTOR_EXTENSION
	friend RealPack operator+(RealPack a, RealPack b) { return RealPack(a.lanes_ + b.lanes_); }
	friend RealPack operator-(RealPack a, RealPack b) { return RealPack(a.lanes_ - b.lanes_); }
	friend RealPack operator*(RealPack a, RealPack b) { return RealPack(a.lanes_ * b.lanes_); }
	friend RealPack operator/(RealPack a, RealPack b) { return RealPack(a.lanes_ / b.lanes_); }
	friend RealPack operator-(RealPack a) { return RealPack(-a.lanes_); }
	friend PackMask operator<(RealPack a, RealPack b) { return { a.lanes_ < b.lanes_ }; }
	friend PackMask operator>(RealPack a, RealPack b) { return { a.lanes_ > b.lanes_ }; }
	friend RealPack select(PackMask mask, RealPack yes, RealPack no) {
		return RealPack(mask.lanes ? yes.lanes_ : no.lanes_);
	}
#else
	friend RealPack operator+(RealPack a, RealPack b) { return each(a, b, [](Real x, Real y) { return x + y; }); }
	friend RealPack operator-(RealPack a, RealPack b) { return each(a, b, [](Real x, Real y) { return x - y; }); }
	friend RealPack operator*(RealPack a, RealPack b) { return each(a, b, [](Real x, Real y) { return x * y; }); }
	friend RealPack operator/(RealPack a, RealPack b) { return each(a, b, [](Real x, Real y) { return x / y; }); }
	friend RealPack operator-(RealPack a) { return each(a, a, [](Real x, Real) { return -x; }); }
	friend PackMask operator<(RealPack a, RealPack b) { return compare(a, b, [](Real x, Real y) { return x < y; }); }
	friend PackMask operator>(RealPack a, RealPack b) { return compare(a, b, [](Real x, Real y) { return x > y; }); }
	friend RealPack select(PackMask mask, RealPack yes, RealPack no) {
		for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
			no.lanes_[i] = mask.lanes[i] ? yes.lanes_[i] : no.lanes_[i];
		}
		return no;
	}
#endif
	friend RealPack sqrt(RealPack a) {
		for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
			a.lanes_[i] = std::sqrt(a.lanes_[i]);
		}
		return a;
	}

	RealPack &operator+=(RealPack other) { return *this = *this + other; }
	RealPack &operator-=(RealPack other) { return *this = *this - other; }
	RealPack &operator*=(RealPack other) { return *this = *this * other; }

private:
	explicit RealPack(detail::PackReals lanes) : lanes_(lanes) {}
#ifdef SOFTBODY_VECTOR_EXTENSION
	void set_all(Real value) { lanes_ = value - detail::PackReals{}; } // minus, as -0 + 0 would lose the sign
#else
	void set_all(Real value) { lanes_.fill(value); }
	template <class F>
	static RealPack each(RealPack a, RealPack b, F f) {
		for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
			a.lanes_[i] = f(a.lanes_[i], b.lanes_[i]);
		}
		return a;
	}
	template <class F>
	static PackMask compare(RealPack a, RealPack b, F f) {
		PackMask mask;
		for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
			mask.lanes[i] = f(a.lanes_[i], b.lanes_[i]);
		}
		return mask;
	}
#endif

	detail::PackReals lanes_;
};

/// What comparing two T gives: `bool`, or an answer for every lane.
template <class T>
using MaskOf = decltype(T() < T());

/// Whether the answer is yes in any lane.
inline bool any(PackMask mask) {
#ifdef SOFTBODY_VECTOR_EXTENSION
	const auto words = std::bit_cast<std::array<std::uint64_t, sizeof(mask.lanes) / 8>>(mask.lanes);
#else
	const auto &words = mask.lanes;
#endif
	bool found = false;
	for (const auto word : words) {
		found |= word != 0;
	}
	return found;
}

/// Bit l is the answer of lane l.
inline std::uint32_t bits(PackMask mask) {
#if defined(SOFTBODY_VECTOR_EXTENSION) && defined(__SSE__) && !defined(SOFTBODY_DOUBLE)
	return std::uint32_t(__builtin_ia32_movmskps(std::bit_cast<detail::PackReals>(mask.lanes)));
#else
	std::uint32_t result = 0;
	for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
		result |= std::uint32_t(mask[i] != 0) << i;
	}
	return result;
#endif
}

/// The smallest of the lanes; of lanes that are no number, none or one.
inline Real least_lane(RealPack a) {
	return std::min(std::min(a[0], a[1]), std::min(a[2], a[3]));
}
inline Real greatest_lane(RealPack a) {
	return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

// The same for a single scalar, so that code for any T compiles for `Real`.
inline Real select(bool mask, Real yes, Real no) {
	return mask ? yes : no;
}
inline bool any(bool mask) {
	return mask;
}
inline bool both(bool a, bool b) {
	return a && b;
}
inline Real sqrt(Real a) {
	return std::sqrt(a);
}

/// The smaller value; `b` where one is no number.
template <class T>
T lesser(T a, T b) {
	return select(a < b, a, b);
}
template <class T>
T greater(T a, T b) {
	return select(a > b, a, b);
}

} // namespace softbody
