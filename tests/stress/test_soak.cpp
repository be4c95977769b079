// SPDX-License-Identifier: MIT
// What goes on for long neither grows nor drifts nor loses anybody.
#include "scenes/stress/soak.h"
#include "support/allocations.h"

#include <doctest/doctest.h>

using namespace softbody::testing;

// Ten hours of it: scripts/bench.sh soak.
TEST_CASE("in ten simulated minutes nothing at rest drifts, nobody is lost and no memory grows" * doctest::test_suite("slow")) {
	const SoakResult result = soak(600, allocated_bytes);
	CHECK(result.drift < 0.1); // what nobody sees
	CHECK(result.round_drift < 30); // laid in another way it crept by 13
	MESSAGE("a circle that is kept awake has crept by " << result.round_drift << " px");
	CHECK(result.sleeping_drift == 0);
	CHECK(result.lost == 0);
	CHECK(result.resets == 0);
	CHECK(result.growth <= 4096); // lists of touches and contacts of a stirred bin may find a new maximum
}
