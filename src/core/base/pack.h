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
#include <type_traits>

namespace softbody {

/// How many bodies are stepped side by side. Four floats fill the vector registers that every 64-bit
/// x86 and ARM processor has; a pack of doubles takes two of them.
inline constexpr std::size_t PACK_WIDTH = 4;

/// How many bodies are stepped side by side in registers of 32 bytes. Only the one file that is compiled for AVX2 may
/// use a pack of this width: by the width in their names, linkers tell its functions from all others.
inline constexpr std::size_t WIDE_WIDTH = 2 * PACK_WIDTH;

namespace detail {

#if defined(__GNUC__) || defined(__clang__)
#define SOFTBODY_VECTOR_EXTENSION
template <std::size_t WIDTH>
struct PackTypes {
	typedef Real Reals __attribute__((vector_size(WIDTH * sizeof(Real))));
	// As wide as a `Real`, like the results of comparisons.
	typedef std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t> Bit;
	typedef Bit Bits __attribute__((vector_size(WIDTH * sizeof(Real))));
};
#else
template <std::size_t WIDTH>
struct PackTypes {
	using Reals = std::array<Real, WIDTH>;
	using Bits = std::array<bool, WIDTH>;
};
#endif
using PackReals = typename PackTypes<PACK_WIDTH>::Reals;

} // namespace detail

/// The result of a comparison for every lane of a pack.
template <std::size_t WIDTH>
struct BasicPackMask {
	typename detail::PackTypes<WIDTH>::Bits lanes;

	bool operator[](std::size_t lane) const { return lanes[lane]; }
#ifdef SOFTBODY_VECTOR_EXTENSION
	friend BasicPackMask both(BasicPackMask a, BasicPackMask b) { return { a.lanes & b.lanes }; }
	friend BasicPackMask operator!(BasicPackMask a) { return { ~a.lanes }; }
#else
	friend BasicPackMask both(BasicPackMask a, BasicPackMask b) {
		for (std::size_t i = 0; i < WIDTH; ++i) {
			a.lanes[i] = a.lanes[i] && b.lanes[i];
		}
		return a;
	}
	friend BasicPackMask operator!(BasicPackMask a) {
		for (bool &lane : a.lanes) {
			lane = !lane;
		}
		return a;
	}
#endif
};
using PackMask = BasicPackMask<PACK_WIDTH>;

/// Number of lanes of a pack; 1 for `Real`.
template <class T>
inline constexpr std::size_t LANES = sizeof(T) / sizeof(Real);

/// WIDTH scalars side by side. Code written for any scalar type T gives the same bits for `Real` as for a lane. A
/// `Real` converts to a pack of equal lanes.
template <std::size_t WIDTH>
class BasicPack {
public:
	using Reals = typename detail::PackTypes<WIDTH>::Reals;
	using Bits = typename detail::PackTypes<WIDTH>::Bits;

	BasicPack() = default;
	BasicPack(Real value) { set_all(value); }

	Real operator[](std::size_t lane) const { return lanes_[lane]; }
	void set(std::size_t lane, Real value) { lanes_[lane] = value; }
	const Reals &lanes() const { return lanes_; }
	static BasicPack of_lanes(Reals lanes) { return BasicPack(lanes); }

#ifdef SOFTBODY_VECTOR_EXTENSION
	friend BasicPack operator+(BasicPack a, BasicPack b) { return BasicPack(a.lanes_ + b.lanes_); }
	friend BasicPack operator-(BasicPack a, BasicPack b) { return BasicPack(a.lanes_ - b.lanes_); }
	friend BasicPack operator*(BasicPack a, BasicPack b) { return BasicPack(a.lanes_ * b.lanes_); }
	friend BasicPack operator/(BasicPack a, BasicPack b) { return BasicPack(a.lanes_ / b.lanes_); }
	friend BasicPack operator-(BasicPack a) { return BasicPack(-a.lanes_); }
	friend BasicPackMask<WIDTH> operator<(BasicPack a, BasicPack b) { return { Bits(a.lanes_ < b.lanes_) }; }
	friend BasicPackMask<WIDTH> operator>(BasicPack a, BasicPack b) { return { Bits(a.lanes_ > b.lanes_) }; }
	friend BasicPack select(BasicPackMask<WIDTH> mask, BasicPack yes, BasicPack no) {
		return BasicPack(mask.lanes ? yes.lanes_ : no.lanes_);
	}
#else
	friend BasicPack operator+(BasicPack a, BasicPack b) { return each(a, b, [](Real x, Real y) { return x + y; }); }
	friend BasicPack operator-(BasicPack a, BasicPack b) { return each(a, b, [](Real x, Real y) { return x - y; }); }
	friend BasicPack operator*(BasicPack a, BasicPack b) { return each(a, b, [](Real x, Real y) { return x * y; }); }
	friend BasicPack operator/(BasicPack a, BasicPack b) { return each(a, b, [](Real x, Real y) { return x / y; }); }
	friend BasicPack operator-(BasicPack a) { return each(a, a, [](Real x, Real) { return -x; }); }
	friend BasicPackMask<WIDTH> operator<(BasicPack a, BasicPack b) {
		return compare(a, b, [](Real x, Real y) { return x < y; });
	}
	friend BasicPackMask<WIDTH> operator>(BasicPack a, BasicPack b) {
		return compare(a, b, [](Real x, Real y) { return x > y; });
	}
	friend BasicPack select(BasicPackMask<WIDTH> mask, BasicPack yes, BasicPack no) {
		for (std::size_t i = 0; i < WIDTH; ++i) {
			no.lanes_[i] = mask.lanes[i] ? yes.lanes_[i] : no.lanes_[i];
		}
		return no;
	}
#endif
	friend BasicPack sqrt(BasicPack a) {
		for (std::size_t i = 0; i < WIDTH; ++i) {
			a.lanes_[i] = std::sqrt(a.lanes_[i]);
		}
		return a;
	}

	BasicPack &operator+=(BasicPack other) { return *this = *this + other; }
	BasicPack &operator-=(BasicPack other) { return *this = *this - other; }
	BasicPack &operator*=(BasicPack other) { return *this = *this * other; }

private:
	explicit BasicPack(Reals lanes) : lanes_(lanes) {}
#ifdef SOFTBODY_VECTOR_EXTENSION
	void set_all(Real value) { lanes_ = value - Reals{}; } // subtraction, as -0 + 0 would lose the sign
#else
	void set_all(Real value) { lanes_.fill(value); }
	template <class F>
	static BasicPack each(BasicPack a, BasicPack b, F f) {
		for (std::size_t i = 0; i < WIDTH; ++i) {
			a.lanes_[i] = f(a.lanes_[i], b.lanes_[i]);
		}
		return a;
	}
	template <class F>
	static BasicPackMask<WIDTH> compare(BasicPack a, BasicPack b, F f) {
		BasicPackMask<WIDTH> mask;
		for (std::size_t i = 0; i < WIDTH; ++i) {
			mask.lanes[i] = f(a.lanes_[i], b.lanes_[i]);
		}
		return mask;
	}
#endif

	Reals lanes_;
};
using RealPack = BasicPack<PACK_WIDTH>;

/// Result of comparing two T: `bool`, or a mask for packs.
template <class T>
using MaskOf = decltype(T() < T());

/// Whether any lane is true.
template <std::size_t WIDTH>
bool any(BasicPackMask<WIDTH> mask) {
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

/// Bit l is the result of lane l.
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

/// The smallest of the lanes; lanes that are NaN may or may not be passed over.
inline Real least_lane(RealPack a) {
	return std::min(std::min(a[0], a[1]), std::min(a[2], a[3]));
}
inline Real greatest_lane(RealPack a) {
	return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

// Counterparts for a single scalar, so that code for any T compiles for `Real`.
inline Real select(bool mask, Real yes, Real no) {
	return mask ? yes : no;
}
inline bool any(bool mask) {
	return mask;
}
inline bool both(bool a, bool b) {
	return a && b;
}
using std::sqrt;

/// The smaller value; `b` where one is NaN.
template <class T>
T lesser(T a, T b) {
	return select(a < b, a, b);
}
template <class T>
T greater(T a, T b) {
	return select(a > b, a, b);
}

} // namespace softbody
