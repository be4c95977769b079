// SPDX-License-Identifier: MIT
// Batches of WIDE_WIDTH bodies, on processors with registers of 32 bytes.
#include "core/dynamics/wide_stepper.h"

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

std::unique_ptr<WideStepper> make_wide_stepper() {
	return are_allowed && detail::make_avx2_stepper != nullptr && has_avx2() ? detail::make_avx2_stepper() : nullptr;
}

void allow_wide_steppers(bool allowed) {
	are_allowed = allowed;
}

} // namespace softbody
