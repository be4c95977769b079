// SPDX-License-Identifier: MIT
// Keeps a body that grows where it lies from being thrown by what it lies on.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

namespace softbody {

/// While a body grows, and for a short time after it, contacts stop and turn it, but make it no faster: what they push it
/// away, it is moved, and does not fly on. Gravity and forces act as ever.
class BodyGrowth {
public:
	/// Called when the body has become larger in some direction.
	void note_growth();
	/// Called before a step of `dt` [s], when all forces of the step are queued. `gravity` is the world's.
	void begin_step(const SoftBodyData &body, Vec2 gravity, Real dt);
	/// Called after the step.
	void end_step(SoftBodyData &body) const;
	/// Time for which the body is yet held back [s], >= 0: all that matters between two steps.
	Real calm_time() const { return calm_time_; }
	void set_calm_time(Real time) { calm_time_ = time; }

private:
	Real calm_time_ = 0; ///< that is left [s]
	Real dt_ = 0; ///< of the step [s]
	Real most_speed_ = -1; ///< of the center of mass after this step [length/s]; < 0: any
	Real most_spin_ = 0; ///< after this step [rad/s]
};

} // namespace softbody
