// SPDX-License-Identifier: MIT
// Batches of WIDE_WIDTH bodies, where the processor has registers twice as wide.
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

/// A slice of the step for a batch of WIDE_WIDTH bodies that meet no colliders, feel no external forces, do not bounce and are
/// not monitored.
struct WideTimeSlice {
	const Batch *batch = nullptr;
	std::span<const Border> borders;
	Integrator integrator = Integrator::SEMI_IMPLICIT_EULER; ///< not XPBD, not AUTOMATIC
	Vec2 gravity; ///< [length/s²]
	Real h = 0; ///< of a substep [s]
	int substeps = 1;
	Real reach = 0; ///< how far apart points may be at the end [length], see `is_finite_within`
	/// Whose extents are measured at the end (`SolverBody::measure_extent`), or all null.
	std::array<SolverBody *, WIDE_WIDTH> solver_bodies{};
};

/// Advances a wide batch, with the bits that each body would get alone. Serves one thread.
class WideStepper {
public:
	virtual ~WideStepper() = default;
	/// Returns how many contacts with borders it solved. Returns nothing, and changes nothing, if a body would not end finite
	/// and whole. Prefetches all of `prefetch` meanwhile.
	virtual std::optional<std::uint64_t> advance(const WideTimeSlice &slice, StatePrefetch &prefetch) = 0;
};

/// Null where the compiler or the processor offers no registers of that width, in double precision, and while
/// `allow_wide_steppers` says no.
std::unique_ptr<WideStepper> make_wide_stepper();
/// Whether simulators made from now on may use registers of that width. For tests, which compare: the bits are the same.
/// Not to be called while another thread makes one. Default true.
void allow_wide_steppers(bool allowed);

namespace detail {
/// Makes one, whatever the processor. Null where the program was compiled without. It lies in the one file that is
/// compiled for AVX2, and must not be called where that is missing.
extern std::unique_ptr<WideStepper> (*const make_avx2_stepper)();
} // namespace detail

} // namespace softbody
