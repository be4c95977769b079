// SPDX-License-Identifier: MIT
// How a body stands under its own weight, found by letting a copy of it settle in a world of its own.
#pragma once

#include "core/base/error.h"
#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"

#include <memory>

namespace softbody {

/// Area that a body which holds its weight may lose [1]: what the rule calls firm (see FIRM_STRENGTH).
inline constexpr Real FIRM_AREA_LOSS = Real(0.05);
/// Above which it is called folded even if its outline is still whole [1]; at FOLDING_STRENGTH a circle has lost an eighth
/// to a fifth.
inline constexpr Real FOLDED_AREA_LOSS = Real(0.21);

/// How far a body has given way.
struct LoadOutcome {
	/// What the weight has taken of the body's height, as a share of it [1]; of a body that hangs from pins, how far its
	/// center of mass has come down, as a share of its height.
	Real sag = 0;
	Real area_loss = 0; ///< share of the rest area [1]; negative for one that has been blown up
	bool folded = false; ///< its hull meets itself or has turned over
	bool rests = false; ///< it has fallen asleep; otherwise it still moved when the trial ended
};

/// Whether it has lost more than FIRM_AREA_LOSS of its area or twice that share of its height.
bool needs_more(const LoadOutcome &outcome);

/// A copy of a body on flat ground, just touching it, or hanging from its pins without any ground, under gravity. Steps
/// are those of `Simulator`, so they also are what the time of one can be measured by. Allocates; not for use in a step.
class LoadTrial {
public:
	/// Simulated time after which it ends, at rest or not [s].
	static constexpr Real LONGEST = 8;

	/// `body` is taken as it is; its sleep, collision mask and activity do not count. Refuses what a world refuses: a
	/// gravity that is not finite, a length unit <= 0. `dt` [s] > 0.
	static Result<LoadTrial> create(SoftBodyData body, Vec2 gravity, Real length_unit, Real dt);

	/// One step of the world. False when the trial had ended before: then nothing is done.
	bool step();
	/// As the body is now. O(hull points²), for `folded`.
	LoadOutcome outcome() const;

private:
	LoadTrial() = default;

	const SoftBodyData &body() const { return world_->soft_bodies()[0]; }
	Real height_along(Vec2 down, std::span<const Vec2> points) const;

	std::unique_ptr<WorldData> world_;
	std::unique_ptr<Simulator> simulator_;
	Vec2 down_; ///< unit vector, zero when nothing weighs
	Vec2 first_center_;
	Real dt_ = 0;
	Real elapsed_ = 0;
	bool hangs_ = false;
};

/// By how much springs and shape matching must stiffen until `needs_more` is content [1]; 1 when the body holds as it is.
/// Damping ratios and pressure stay. Found to a tenth by bisection, and with a tenth to spare; a trial each, of at most
/// `most_steps` steps in all; 0 when they do not suffice.
Real find_firm_factor(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt, int most_steps);

} // namespace softbody
