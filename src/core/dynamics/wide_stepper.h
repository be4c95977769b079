// SPDX-License-Identifier: MIT
// Batches of WIDE_WIDTH bodies, on processors with registers of 32 bytes.
#pragma once

#include "core/base/pack.h"
#include "core/collision/pair_constraint.h"
#include "core/dynamics/batch.h"
#include "core/dynamics/state_prefetch.h"
#include "core/model/integrator.h"
#include "core/model/surroundings.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace softbody {

/// A time slice for a batch of WIDE_WIDTH bodies without near colliders, external forces, bounces or monitoring.
struct WideTimeSlice {
	const Batch *batch = nullptr;
	std::span<const Border> borders;
	Integrator integrator = Integrator::SEMI_IMPLICIT_EULER; ///< not XPBD, not AUTOMATIC
	Vec2 gravity; ///< [length/s²]
	Real h = 0; ///< of a substep [s]
	int substeps = 1;
	Real reach = 0; ///< largest distance of points at the end [length], see `is_finite_within`
	/// Bodies whose extents are measured at the end (`SolverBody::measure_extent`), or all null.
	std::array<SolverBody *, WIDE_WIDTH> solver_bodies{};
};

/// Advances a wide batch. Each body gets the bits that it would get alone. One object serves one thread.
class WideStepper {
public:
	virtual ~WideStepper() = default;
	/// Returns the number of contacts with borders solved. Returns nothing, and changes nothing, if a body would not
	/// end finite and whole. Prefetches all of `prefetch` meanwhile.
	virtual std::optional<std::uint64_t> advance(const WideTimeSlice &slice, StatePrefetch &prefetch) = 0;
};

/// Returns null if the compiler or the processor has no registers of 32 bytes, in double precision, and after
/// `allow_wide_steppers(false)`.
std::unique_ptr<WideStepper> make_wide_stepper();
/// Sets whether simulators made from now on may use registers of 32 bytes. For tests that compare both: the bits are
/// the same. Must not be called while another thread makes a simulator. Default true.
void allow_wide_steppers(bool allowed);

namespace detail {
/// Makes an AVX2 stepper without asking the processor. Null if the program was compiled without it. The function lies
/// in the one file that is compiled for AVX2, and must not be called on a processor without AVX2.
extern std::unique_ptr<WideStepper> (*const make_avx2_stepper)();
} // namespace detail

} // namespace softbody
