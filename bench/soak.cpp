// SPDX-License-Identifier: MIT
// Ten simulated hours of bodies at rest, stirred ones, and ones that come and go.
#include "bench.h"

#include "scenes/stress/soak.h"

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bench {

namespace {

std::size_t bytes_in_use() {
#ifdef __GLIBC__
	return mallinfo2().uordblks;
#else
	return 0; // not known here
#endif
}

} // namespace

nlohmann::json soak(const Options &options) {
	const softbody::testing::SoakResult result = softbody::testing::soak(options.quick ? 1200 : 36000, bytes_in_use);
	return { { "hours", result.hours }, { "drift_px", result.drift }, { "round_drift_px", result.round_drift }, { "sleeping_drift_px", result.sleeping_drift },
		{ "lost", result.lost }, { "resets", result.resets }, { "growth_bytes", result.growth } };
}

} // namespace bench
