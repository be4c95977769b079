// SPDX-License-Identifier: MIT
// Bodies that touch nothing and hardly wobble take their step as rigid bodies.
#pragma once

#include "core/base/pack.h"
#include "core/dynamics/batch.h"
#include "core/model/body_lanes.h"
#include "core/model/surroundings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace softbody {

/// The step of a body as a rigid one. A body flies if it has an elastic material, no pin, joint, load of its own, dent or spring that is
/// tense at rest, no other body and no collider within its way, and if it is calm: FLIGHT_STRAIN, FLIGHT_STRAIN_RATE, and a spin
/// that would not stretch it by more than FLIGHT_STRAIN.
///
/// The step keeps the momentum and the angular momentum of its points. It ends their motion relative to the rigid one, and leaves the
/// strain as it is, so that no point jumps. The center falls as the body's own method would let it fall.
///
/// Nothing is remembered: whether a body flies follows from its state alone, so that saved states need no more than before. A flying
/// body has no strain rate, so it goes on flying until something changes its points or comes near.
///
/// The bound of the spin ω: a centrifugal load stretches a body of the moment of inertia I, the area A and the shear modulus μ by at most
/// about ω² I / (4 μ A). On a pure shear ε it acts with at most ω² I, against 4 μ A ε.
struct FlightSlice {
	const Batch *batch = nullptr; ///< may be null for a single body
	Vec2 acceleration; ///< by weight [length/s²]
	Real duration = 0; ///< of the step [s]
	Real h = 0; ///< of a substep [s]
	int substeps = 1;
	/// Share of the speed that a substep gains with which its way is gone: 1/2 where the velocity leads (`IntegratorTraits`), else 1.
	Real early = 1; ///< [1]
	Real lost = 0; ///< share of the velocity that damping takes in a substep [1]
	Real lost_spin = 0; ///< the same of the spin
	std::span<const Border> borders;
};

/// Tells what is near a body that could fly.
class FlightGate {
public:
	/// Whether no collider is within `reach` [length] of the center.
	virtual bool is_clear(std::size_t lane, Vec2 center, Real reach) = 0;

protected:
	~FlightGate() = default;
};

/// What became of a batch.
struct FlightResult {
	std::uint32_t flown = 0; ///< bit mask of the lanes that have taken their step; the others are as they were
	std::array<Rotation, WIDE_WIDTH> rotations; ///< of these
	std::array<Real, WIDE_WIDTH> speeds; ///< of their centers, greatest at the start or end of the step [length/s]
};

/// Whether shape, settings and method let a body fly.
bool can_fly(const SoftBodyShape &shape, const BodySettings &settings, const SubstepPlan &plan);

/// The slice of a step of `dt` [s] for bodies with that plan. `gravity` is the world's [length/s²].
FlightSlice flight_slice(const BodySettings &settings, const SubstepPlan &plan, Vec2 gravity, std::span<const Border> borders, Real dt);

/// Moves a single body, if it may fly.
FlightResult fly_alone(SoftBodyData &body, const FlightSlice &slice, FlightGate &gate);

} // namespace softbody
