// SPDX-License-Identifier: MIT
// Chooses how many SIMD lanes there are.
#include "core/dynamics/lane_stepper.h"

#include "core/dynamics/slice_lanes.h"

namespace softbody {

namespace {

bool are_allowed = true;

bool has_avx2() {
#if (defined(__GNUC__) || defined(__clang__)) && (defined(__x86_64__) || defined(__i386__))
	return __builtin_cpu_supports("avx2");
#else
	return false;
#endif
}

} // namespace

LaneStepper::~LaneStepper() = default;

std::unique_ptr<LaneStepper> make_narrow_stepper() {
	return std::make_unique<BasicLaneStepper<RealPack>>();
}

std::unique_ptr<LaneStepper> make_wide_stepper() {
	return are_allowed && detail::make_avx2_stepper != nullptr && has_avx2() ? detail::make_avx2_stepper() : nullptr;
}

void allow_wide_steppers(bool allowed) {
	are_allowed = allowed;
}

} // namespace softbody
