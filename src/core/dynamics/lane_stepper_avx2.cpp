// SPDX-License-Identifier: MIT
// Batches of WIDE_WIDTH bodies in registers of 32 bytes. This file alone is compiled for AVX2.
#include "core/dynamics/lane_stepper.h"

#include "core/dynamics/slice_lanes.h"

namespace softbody {

// GCC cannot align the stack to 32 bytes on Windows (its bug 54412). SOFTBODY_SHUFFLES implies single precision. Without
// optimization this file would hold inline functions that other files hold too, and the linker might keep these.
#if defined(__AVX2__) && defined(__OPTIMIZE__) && defined(SOFTBODY_SHUFFLES) && !(defined(_WIN32) && !defined(__clang__))

namespace {

std::unique_ptr<LaneStepper> make() {
	return std::make_unique<BasicLaneStepper<BasicPack<WIDE_WIDTH>>>();
}

} // namespace

std::unique_ptr<LaneStepper> (*const detail::make_avx2_stepper)() = make;

#else

std::unique_ptr<LaneStepper> (*const detail::make_avx2_stepper)() = nullptr;

#endif

} // namespace softbody
