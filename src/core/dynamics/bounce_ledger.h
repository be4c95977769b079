// SPDX-License-Identifier: MIT
// Restitution of bodies as wholes, paid for by the energy that their touches have taken.
#pragma once

#include "core/base/parallel_for.h"
#include "core/base/vec2.h"
#include "core/collision/broad_phase.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/islands.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Gives bodies the speed that they lack of their bounce (`follow_bounce`, `follow_pair_bounce`) and keeps account of the
/// energy. Bodies that touch form an island. What it loses in a step, kinetic and elastic, goes to its account, and each
/// body keeps a share by mass (TouchMemory::account). A bounce is paid for from the account, then from the wobble of its
/// bodies, and is smaller if both do not suffice. What an island gains through contacts is taken from its wobble. So
/// bounces add no energy, and energy that one body has passed on to another is not paid out again. Work of gravity and of
/// moving surfaces is not a loss. A step in which a body is driven from outside (forces, pins sent elsewhere) is not
/// counted for that body. An island whose touches ask for nothing is not counted at all. Derivation: docs/decisions/restitution.md. Owns nothing but scratch memory.
class BounceLedger {
public:
	/// Keeps the states of all awake bodies before a step. `bodies` must outlive it. O(points of awake bodies).
	void begin_step(ActiveBodies &bodies, Vec2 gravity, const ParallelFor &parallel_for);
	/// Books what the step of `dt` [s] has changed, and pays. `touches` has the touch of each of `pairs`, or is empty.
	/// O(springs of bodies in islands that may bounce + awake bodies + pairs).
	void end_step(std::span<const BodyPair> pairs, std::span<PairTouch> touches, std::span<const BodyPair> joined, Real dt,
			const ParallelFor &parallel_for);

private:
	struct Start {
		std::size_t state = 0; ///< index of its positions, which its velocities follow
		double energy = 0; ///< kinetic and elastic, of a body that may dent in the step
		bool is_driven = false;
		bool counts = false; ///< in an island that asks
	};
	struct Island {
		double account = 0;
		double mass = 0;
		double wobble = 0; ///< kinetic energy of the motion relative to that of rigid bodies
		double most = 0; ///< that the touches under way may still ask for
		bool touches = false;
		bool asks = false; ///< whether a touch of this step may ask for energy
	};

	void form_islands(std::span<const BodyPair> pairs, std::span<const PairTouch> touches, std::span<const BodyPair> joined);
	void book(const ParallelFor &parallel_for);
	double loss_of(std::uint32_t active_index) const;
	void pay_bounces();
	void pay_pair_bounces(std::span<const BodyPair> pairs, std::span<PairTouch> touches, Real dt);
	void settle(Real dt);
	Island &island_of(std::uint32_t active_index) { return of_[islands_.find(active_index)]; }

	ActiveBodies *bodies_ = nullptr;
	Vec2 gravity_;
	std::vector<Start> starts_; ///< by active index
	std::vector<Vec2> states_;
	std::vector<double> losses_; ///< by active index
	std::vector<Island> of_; ///< by name of the island
	Islands islands_;
};

} // namespace softbody
