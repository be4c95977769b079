// SPDX-License-Identifier: MIT
// Tears a soft body where strain is more than it bears.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/creator/body_cut.h"
#include "core/creator/soft_body_creator.h"
#include "core/model/soft_body_data.h"

#include <vector>

namespace softbody {

/// Bounds of a tear.
struct TearLimits {
	/// Strain at which the body begins to tear, of the shape that it was made with [1], > 0. 1 is twice the length. What is
	/// k times as stiff as the mean of the shape's springs bears k times as much: painted factors make weak and hard spots.
	Real stretch = 1;
	BodyCutLimits pieces; ///< what would leave less does not tear
};

/// Whether a line between two points that a spring joins is longer than it bears. O(springs).
bool is_overstretched(const SoftBodyData &body, Real stretch);

/// Finds the weakest way through an overstretched body, from outline to outline across the line that is most overstretched.
/// The way is as weak as the strain across it: a part of the way that is strained by e resists by 1 - e/stretch, as long
/// as it is at rest. Strain between the hull's points is that of their mean value coordinates at rest (Floater 2003). A part
/// bears what the springs bear whose middles are near. The body tears if the mean
/// of e/stretch along the way, each at most 1, is at least half: then what still holds is less than what has failed. If a line is strained twice as far as it bears, as one at a
/// pinned point may be, and all that would come off there is too small, the body tears farther in.
///
/// The tear is a cut along that way, and everything that holds for `plan_cut` does. One piece alone: it does not tear.
/// Refuses, by name, a stretch that is not above 0 and finite, limits that `plan_cut` refuses, and a body that is folded.
/// O(springs) of a body that is not overstretched; else O(hull points + springs) for each of about 500 places; allocates.
Result<BodyCut> plan_tear(const SoftBodyData &body, const StructureOptions &options, const TearLimits &limits);

} // namespace softbody
