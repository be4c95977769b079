// SPDX-License-Identifier: MIT
// Finds how a body carries its own weight: a copy of it settles in a world of its own.
#pragma once

#include "core/base/error.h"
#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"

#include <memory>

namespace softbody {

/// Largest loss of area of a body that holds its weight [1]: a firm body by the sizing rule (see FIRM_STRENGTH).
inline constexpr Real FIRM_AREA_LOSS = Real(0.05);
/// Loss of area above which a body counts as folded [1]; at FOLDING_STRENGTH a circle has lost an eighth to a fifth.
inline constexpr Real FOLDED_AREA_LOSS = Real(0.21);

/// Deformation of a body under its weight.
struct LoadOutcome {
	/// Loss of height under the weight, as a share of the height [1]; for a body that hangs from pins, the descent of
	/// its center of mass, as a share of its height.
	Real sag = 0;
	Real area_loss = 0; ///< share of the rest area [1]; negative for an inflated body
	bool folded = false; ///< its hull meets itself or has turned over
	bool rests = false; ///< it has fallen asleep; otherwise it still moved when the trial ended
};

/// Whether the body has lost more than FIRM_AREA_LOSS of its area or twice that share of its height.
bool needs_more(const LoadOutcome &outcome);

/// A copy of a body under gravity: on flat ground, just touching it, or hanging from its pins without ground. Steps are
/// those of `Simulator`, so they also serve to measure the time of a step. Allocates; not for use in a step.
class LoadTrial {
public:
	/// Simulated time after which the trial ends, at rest or not [s].
	static constexpr Real LONGEST = 8;

	/// `body` is copied as it is; its sleep, collision mask and activity do not count. Refuses a gravity that is not
	/// finite and a length unit <= 0. `dt` [s] > 0.
	static Result<LoadTrial> create(SoftBodyData body, Vec2 gravity, Real length_unit, Real dt);

	/// Steps the world once. False when the trial had ended before: then nothing happens.
	bool step();
	/// The present deformation. O(hull points²), for `folded`.
	LoadOutcome outcome() const;

private:
	LoadTrial() = default;

	const SoftBodyData &body() const { return world_->soft_bodies()[0]; }
	Real height_along(Vec2 down, std::span<const Vec2> points) const;

	std::unique_ptr<WorldData> world_;
	std::unique_ptr<Simulator> simulator_;
	Vec2 down_; ///< unit vector, zero without gravity
	Vec2 first_center_;
	Real dt_ = 0;
	Real elapsed_ = 0;
	bool hangs_ = false;
};

/// Factor by which springs and shape matching must stiffen until `needs_more` is false [1]; 1 when the body holds
/// already. Damping ratios and pressure stay. Found by bisection to a tenth, plus a tenth to spare, with a trial for
/// each factor, of at most `most_steps` steps in all; 0 when these do not suffice.
Real find_firm_factor(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt, int most_steps);

} // namespace softbody
