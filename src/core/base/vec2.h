// SPDX-License-Identifier: MIT
// A plain two-dimensional vector and the few products the simulation needs.
#pragma once

#include "core/base/elementary.h"
#include "core/base/pack.h"
#include "core/base/real.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace softbody {

/// Two-dimensional vector of the scalar type T: `Real`, or `RealPack` for several vectors side by side.
template <class T>
struct BasicVec2 {
	T x = T(0);
	T y = T(0);

	constexpr BasicVec2 &operator+=(BasicVec2 other) {
		x += other.x;
		y += other.y;
		return *this;
	}
	constexpr BasicVec2 &operator-=(BasicVec2 other) {
		x -= other.x;
		y -= other.y;
		return *this;
	}
	constexpr BasicVec2 &operator*=(T factor) {
		x *= factor;
		y *= factor;
		return *this;
	}
	friend constexpr BasicVec2 operator+(BasicVec2 a, BasicVec2 b) { return { a.x + b.x, a.y + b.y }; }
	friend constexpr BasicVec2 operator-(BasicVec2 a, BasicVec2 b) { return { a.x - b.x, a.y - b.y }; }
	friend constexpr BasicVec2 operator-(BasicVec2 a) { return { -a.x, -a.y }; }
	friend constexpr BasicVec2 operator*(BasicVec2 a, T factor) { return { a.x * factor, a.y * factor }; }
	friend constexpr BasicVec2 operator*(T factor, BasicVec2 a) { return { a.x * factor, a.y * factor }; }
	friend constexpr bool operator==(BasicVec2 a, BasicVec2 b) { return a.x == b.x && a.y == b.y; }

	friend constexpr T dot(BasicVec2 a, BasicVec2 b) { return a.x * b.x + a.y * b.y; }
	/// z component of the three-dimensional cross product: twice the signed area of the triangle 0, a, b.
	friend constexpr T cross(BasicVec2 a, BasicVec2 b) { return a.x * b.y - a.y * b.x; }
	/// `a` turned by +90 degrees (from x towards y). Velocities of a unit spin are this of the arm.
	friend constexpr BasicVec2 perpendicular(BasicVec2 a) { return { -a.y, a.x }; }
	friend constexpr T length_squared(BasicVec2 a) { return dot(a, a); }
	friend T length(BasicVec2 a) { return sqrt(length_squared(a)); }
	template <class Other>
		requires(!std::is_same_v<Other, T>)
	explicit constexpr operator BasicVec2<Other>() const { return { Other(x), Other(y) }; }
	template <class Mask>
	friend BasicVec2 select(Mask mask, BasicVec2 yes, BasicVec2 no) {
		return { select(mask, yes.x, no.x), select(mask, yes.y, no.y) };
	}
};

/// A position [length], velocity [length/s] or force [mass·length/s²]. Arrays of Vec2 are contiguous pairs.
using Vec2 = BasicVec2<Real>;

/// Two doubles, whatever `Real` is, for results that depend on a small difference of large coordinates.
using Vec2d = BasicVec2<double>;

/// p relative to `origin`, subtracted before any rounding: exact for float coordinates of like size.
constexpr Vec2d difference(Vec2 p, Vec2 origin) {
	return Vec2d(p) - Vec2d(origin);
}

inline bool is_finite(Vec2 a) {
	return std::isfinite(a.x) && std::isfinite(a.y);
}

/// A rotation kept as cosine and sine, without wrap-around. Its angles have the same bits everywhere.
template <class T>
struct BasicRotation {
	T c = T(1);
	T s = T(0);

	static BasicRotation from_angle(Real radians) {
		const auto [sine, cosine] = sine_cosine(double(radians));
		return { Real(cosine), Real(sine) };
	}
	/// Angle in (-pi, pi], positive from x towards y.
	Real angle() const { return Real(angle_of(double(s), double(c))); }
	constexpr BasicVec2<T> apply(BasicVec2<T> a) const { return { c * a.x - s * a.y, s * a.x + c * a.y }; }
	constexpr BasicVec2<T> apply_inverse(BasicVec2<T> a) const { return { c * a.x + s * a.y, c * a.y - s * a.x }; }

	friend constexpr bool operator==(BasicRotation a, BasicRotation b) { return a.c == b.c && a.s == b.s; }
};
using Rotation = BasicRotation<Real>;

/// Lane `lane` of several vectors side by side. `set_lane` is the reverse.
template <std::size_t WIDTH>
Vec2 lane_of(const BasicVec2<BasicPack<WIDTH>> &pack, std::size_t lane) {
	return { pack.x[lane], pack.y[lane] };
}
template <std::size_t WIDTH>
void set_lane(BasicVec2<BasicPack<WIDTH>> &pack, std::size_t lane, Vec2 value) {
	pack.x.set(lane, value.x);
	pack.y.set(lane, value.y);
}
#if defined(SOFTBODY_VECTOR_EXTENSION) && !defined(SOFTBODY_DOUBLE) && __has_builtin(__builtin_shufflevector)
#define SOFTBODY_SHUFFLES
namespace detail {
// Two vectors of floats fill a register: moving whole vectors halves the loads.
typedef std::uint64_t VectorPair __attribute__((vector_size(16)));
static_assert(PACK_WIDTH == 4 && sizeof(Vec2) == 8);
inline std::uint64_t bits_of(const Vec2 &vector) {
	return std::bit_cast<std::uint64_t>(vector);
}
} // namespace detail
#endif

/// Vector i of every lane: lane l is `lanes[l][i]`.
template <class V> // `Vec2` or `const Vec2`
BasicVec2<RealPack> gather(const std::array<V *, PACK_WIDTH> &lanes, std::size_t i) {
	BasicVec2<RealPack> pack;
#ifdef SOFTBODY_SHUFFLES
	const detail::VectorPair low_bits = { detail::bits_of(lanes[0][i]), detail::bits_of(lanes[1][i]) };
	const detail::VectorPair high_bits = { detail::bits_of(lanes[2][i]), detail::bits_of(lanes[3][i]) };
	const auto low = std::bit_cast<detail::PackReals>(low_bits);
	const auto high = std::bit_cast<detail::PackReals>(high_bits);
	pack.x = RealPack::of_lanes(__builtin_shufflevector(low, high, 0, 2, 4, 6));
	pack.y = RealPack::of_lanes(__builtin_shufflevector(low, high, 1, 3, 5, 7));
#else
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		set_lane(pack, lane, lanes[lane][i]);
	}
#endif
	return pack;
}

/// The PACK_WIDTH vectors that begin at `first`.
inline BasicVec2<RealPack> consecutive(const Vec2 *first) {
	return gather<const Vec2>({ first, first + 1, first + 2, first + 3 }, 0);
}

/// Components of two vectors in a row: x, y, x, y.
inline RealPack two_at(const Vec2 *first) {
	RealPack::Reals lanes;
	std::memcpy(&lanes, first, sizeof(lanes));
	return RealPack::of_lanes(lanes);
}

/// Number of packs that hold `count` vectors.
inline std::size_t packs_for(std::size_t count) {
	return (count + PACK_WIDTH - 1) / PACK_WIDTH;
}

/// Pack i of `all`, for tests that may count a vector twice. The last pack holds the last PACK_WIDTH vectors, including
/// some of the pack before it, and repeats the last vector where there are fewer than PACK_WIDTH.
inline BasicVec2<RealPack> pack_of(std::span<const Vec2> all, std::size_t i) {
	if (all.size() >= PACK_WIDTH) {
		return consecutive(&all[std::min(i * PACK_WIDTH, all.size() - PACK_WIDTH)]);
	}
	const auto at = [&](std::size_t lane) { return &all[std::min(lane, all.size() - 1)]; };
	return gather<const Vec2>({ at(0), at(1), at(2), at(3) }, 0);
}

/// A vector in every lane.
template <class T>
BasicVec2<T> in_all_lanes(Vec2 value) {
	return { T(value.x), T(value.y) };
}

} // namespace softbody
