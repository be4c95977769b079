// SPDX-License-Identifier: MIT
// Advances batches of bodies in SIMD lanes.
#pragma once

#include "core/base/pack.h"
#include "core/collision/contact_log.h"
#include "core/collision/pair_constraint.h"
#include "core/collision/surface_constraint.h"
#include "core/dynamics/batch.h"
#include "core/dynamics/rigid_flight.h"
#include "core/dynamics/state_prefetch.h"
#include "core/model/surroundings.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace softbody {

/// What concerns single bodies of a batch, outside of the lanes.
class LoneContacts {
public:
	/// Solves the contacts of the body in a lane, in the body's own arrays, at the end of a substep. Returns their
	/// number.
	virtual std::size_t solve(std::size_t lane) = 0;
	/// Takes a contact of a monitored body that was solved in a lane.
	virtual void report(const ContactPoint &contact) = 0;
	/// Follows the touch of the body in a lane, whose contacts with borders were solved there, through a substep (`follow_bounce`).
	/// `velocity` [length/s] is that of its center of mass. Returns whether the touch goes on.
	virtual bool follow_bounce(std::size_t lane, const ContactLoad &load, Vec2 velocity) = 0;

protected:
	~LoneContacts() = default;
};

/// A time slice for a batch of bodies without external forces, integrated by another method than XPBD.
struct LaneSlice {
	const Batch *batch = nullptr;
	Vec2 gravity; ///< [length/s²]
	Real h = 0; ///< of a substep [s]
	int substeps = 1;
	Real reach = 0; ///< largest distance of points at the end [length], see `is_finite_within`
	bool bears_load = false; ///< see `keep_whole`
	std::span<const Border> borders; ///< of the lanes that are not solved alone
	std::uint32_t solved_alone = 0; ///< bit mask of the lanes whose contacts `lone_contacts` solves
	bool may_bounce = false; ///< whether contacts with `borders` may bounce
	std::uint32_t touching = 0; ///< bit mask of the lanes not solved alone whose bodies have a touch to follow
	LoneContacts *lone_contacts = nullptr; ///< may be null if both masks are 0, nothing may bounce and the bodies are not monitored
	std::span<Vec2> scratch; ///< room for the positions and velocities of one body
	/// Bodies whose extents are measured at the end (`SolverBody::measure_extent`), or all null.
	std::array<SolverBody *, WIDE_WIDTH> solver_bodies{};
	bool pairs_bounce = false; ///< whether mass center and velocity of `solver_bodies` are measured at the start
};

/// Results of a time slice in lanes.
struct LaneResult {
	std::uint64_t contacts = 0; ///< solved
	/// Bit mask of the lanes that do not end finite and whole. What the arrays of these bodies held before is kept,
	/// unless lanes were solved alone. Their extents are not valid.
	std::uint32_t ruined = 0;
};

/// Advances batches of one width. Each body gets the bits that it would get alone. One object serves one thread.
class LaneStepper {
public:
	virtual ~LaneStepper();
	/// Prefetches all of `prefetch` meanwhile.
	virtual LaneResult advance(const LaneSlice &slice, StatePrefetch &prefetch) = 0;
	/// Moves the bodies of `slice.batch` that may fly as rigid ones. The others are as they were.
	virtual FlightResult fly(const FlightSlice &slice, FlightGate &gate) = 0;
	/// Measures the frames of the bodies.
	virtual void measure_frames(const Batch &batch, std::span<BodyFrame> frames) = 0;
};

/// For batches of PACK_WIDTH bodies.
std::unique_ptr<LaneStepper> make_narrow_stepper();
/// For batches of WIDE_WIDTH bodies. Returns null if the compiler or the processor has no registers of 32 bytes, in
/// double precision, and after `allow_wide_steppers(false)`.
std::unique_ptr<LaneStepper> make_wide_stepper();
/// Sets whether simulators made from now on may use registers of 32 bytes. For tests that compare both: the bits are
/// the same. Must not be called while another thread makes a simulator. Default true.
void allow_wide_steppers(bool allowed);

namespace detail {
/// Makes an AVX2 stepper without asking the processor. Null if the program was compiled without it. The function lies
/// in the one file that is compiled for AVX2, and must not be called on a processor without AVX2.
extern std::unique_ptr<LaneStepper> (*const make_avx2_stepper)();
} // namespace detail

} // namespace softbody
