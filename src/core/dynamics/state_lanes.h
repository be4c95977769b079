// SPDX-License-Identifier: MIT
// Moves the points of bodies into SIMD lanes and back.
#pragma once

#include "core/base/vec2.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>

namespace softbody {

#ifdef SOFTBODY_SHUFFLES

namespace detail {

using FourReals = PackTypes<4>::Reals;

// Two vectors of lane l, and in registers of 32 bytes two of lane l + 4 in the upper half.
template <class T>
typename T::Reals load_two(Vec2 *const *lanes, std::size_t lane, std::size_t i) {
	FourReals low;
	std::memcpy(&low, lanes[lane] + i, sizeof(low));
	if constexpr (LANES<T> == 4) {
		return low;
	} else {
		FourReals high;
		std::memcpy(&high, lanes[lane + 4] + i, sizeof(high));
		return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
	}
}

template <class T>
void store_two(typename T::Reals two, Vec2 *const *lanes, std::size_t lane, std::size_t i) {
	const FourReals low = __builtin_shufflevector(two, two, 0, 1, 2, 3);
	std::memcpy(static_cast<void *>(lanes[lane] + i), &low, sizeof(low));
	if constexpr (LANES<T> == 8) {
		const FourReals high = __builtin_shufflevector(two, two, 4, 5, 6, 7);
		std::memcpy(static_cast<void *>(lanes[lane + 4] + i), &high, sizeof(high));
	}
}

// Numbers of a (0 to 3) and of b (4 to 7), in every half of 16 bytes.
template <class T, int P, int Q, int R, int S>
typename T::Reals mix(typename T::Reals a, typename T::Reals b) {
	if constexpr (LANES<T> == 4) {
		return __builtin_shufflevector(a, b, P, Q, R, S);
	} else {
		constexpr auto low = [](int place) { return place < 4 ? place : place + 4; };
		return __builtin_shufflevector(a, b, low(P), low(Q), low(R), low(S), low(P) + 4, low(Q) + 4, low(R) + 4, low(S) + 4);
	}
}

} // namespace detail

/// Vector i of lane l becomes lane l of `all[i]`. Transposes two vectors at a time; of an odd number, the last but one is
/// moved twice. Precondition: at least two vectors. `scatter_all` is the reverse.
template <class T>
void gather_all(Vec2 *const *lanes, std::span<BasicVec2<T>> all) {
	using namespace detail;
	for (std::size_t next = 0; next < all.size(); next += 2) {
		const std::size_t i = std::min(next, all.size() - 2);
		const auto r0 = load_two<T>(lanes, 0, i);
		const auto r1 = load_two<T>(lanes, 1, i);
		const auto r2 = load_two<T>(lanes, 2, i);
		const auto r3 = load_two<T>(lanes, 3, i);
		const auto first01 = mix<T, 0, 4, 1, 5>(r0, r1);
		const auto first23 = mix<T, 0, 4, 1, 5>(r2, r3);
		const auto last01 = mix<T, 2, 6, 3, 7>(r0, r1);
		const auto last23 = mix<T, 2, 6, 3, 7>(r2, r3);
		all[i] = { T::of_lanes(mix<T, 0, 1, 4, 5>(first01, first23)), T::of_lanes(mix<T, 2, 3, 6, 7>(first01, first23)) };
		all[i + 1] = { T::of_lanes(mix<T, 0, 1, 4, 5>(last01, last23)), T::of_lanes(mix<T, 2, 3, 6, 7>(last01, last23)) };
	}
}

template <class T>
void scatter_all(std::span<const BasicVec2<T>> all, Vec2 *const *lanes) {
	using namespace detail;
	for (std::size_t next = 0; next < all.size(); next += 2) {
		const std::size_t i = std::min(next, all.size() - 2);
		const auto a01 = mix<T, 0, 4, 1, 5>(all[i].x.lanes(), all[i].y.lanes());
		const auto a23 = mix<T, 2, 6, 3, 7>(all[i].x.lanes(), all[i].y.lanes());
		const auto b01 = mix<T, 0, 4, 1, 5>(all[i + 1].x.lanes(), all[i + 1].y.lanes());
		const auto b23 = mix<T, 2, 6, 3, 7>(all[i + 1].x.lanes(), all[i + 1].y.lanes());
		store_two<T>(mix<T, 0, 1, 4, 5>(a01, b01), lanes, 0, i);
		store_two<T>(mix<T, 2, 3, 6, 7>(a01, b01), lanes, 1, i);
		store_two<T>(mix<T, 0, 1, 4, 5>(a23, b23), lanes, 2, i);
		store_two<T>(mix<T, 2, 3, 6, 7>(a23, b23), lanes, 3, i);
	}
}

#else

template <class T>
void gather_all(Vec2 *const *lanes, std::span<BasicVec2<T>> all) {
	for (std::size_t i = 0; i < all.size(); ++i) {
		for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
			set_lane(all[i], lane, lanes[lane][i]);
		}
	}
}

template <class T>
void scatter_all(std::span<const BasicVec2<T>> all, Vec2 *const *lanes) {
	for (std::size_t i = 0; i < all.size(); ++i) {
		for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
			lanes[lane][i] = lane_of(all[i], lane);
		}
	}
}

#endif

} // namespace softbody
