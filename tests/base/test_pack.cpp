// SPDX-License-Identifier: MIT
// Packs do to every lane what the same operation does to a single number.
#include "core/base/pack.h"
#include "core/base/vec2.h"
#include "support/random.h"

#include <bit>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace softbody;
using namespace softbody::testing;

namespace {

bool same_bits(Real a, Real b) {
	return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

} // namespace

TEST_CASE("every operation on packs gives in each lane the bits of the single operation") {
	constexpr Real INF = std::numeric_limits<Real>::infinity();
	const Real special[] = { 0, -0.0f, 1, -1, INF, -INF, std::numeric_limits<Real>::quiet_NaN(),
		std::numeric_limits<Real>::max(), std::numeric_limits<Real>::min(), std::numeric_limits<Real>::denorm_min() };
	Random random(5);
	for (int round = 0; round < 2000; ++round) {
		Real a[PACK_WIDTH];
		Real b[PACK_WIDTH];
		RealPack pack_a;
		RealPack pack_b;
		for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
			const auto draw = [&] {
				return random.chance(0.3) ? special[random.integer(0, 9)] : random.real(-1e3, 1e3);
			};
			a[i] = draw();
			b[i] = draw();
			pack_a.set(i, a[i]);
			pack_b.set(i, b[i]);
		}
		for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
			CHECK(same_bits((pack_a + pack_b)[i], a[i] + b[i]));
			CHECK(same_bits((pack_a - pack_b)[i], a[i] - b[i]));
			CHECK(same_bits((pack_a * pack_b)[i], a[i] * b[i]));
			CHECK(same_bits((pack_a / pack_b)[i], a[i] / b[i]));
			CHECK(same_bits((-pack_a)[i], -a[i]));
			CHECK(same_bits(sqrt(pack_a)[i], std::sqrt(a[i])));
			CHECK(same_bits(select(pack_a < pack_b, pack_a, pack_b)[i], a[i] < b[i] ? a[i] : b[i]));
			CHECK(same_bits(select(pack_a > pack_b, pack_a, pack_b)[i], a[i] > b[i] ? a[i] : b[i]));
			CHECK(same_bits(lesser(pack_a, pack_b)[i], lesser(a[i], b[i])));
			CHECK(same_bits(greater(pack_a, pack_b)[i], greater(a[i], b[i])));
			CHECK(same_bits(RealPack(a[0])[i], a[0]));
			CHECK(both(pack_a < pack_b, pack_a > RealPack(0))[i] == (a[i] < b[i] && a[i] > 0));
		}
	}
}

TEST_CASE("any finds a single lane") {
	CHECK_FALSE(any(RealPack(1) < RealPack(1)));
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		RealPack one(2);
		one.set(lane, 0);
		CHECK(any(one < RealPack(1)));
		CHECK((one < RealPack(1))[lane]);
	}
}

TEST_CASE("a vector put into a lane comes out of it, and touches no other") {
	BasicVec2<RealPack> pack = in_all_lanes<RealPack>({ 1, 2 });
	set_lane(pack, 2, { 3, 4 });
	CHECK(lane_of(pack, 2) == Vec2{ 3, 4 });
	CHECK(lane_of(pack, 1) == Vec2{ 1, 2 });
	CHECK(lane_of(pack, 3) == Vec2{ 1, 2 });
}
