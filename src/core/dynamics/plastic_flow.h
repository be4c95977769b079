// SPDX-License-Identifier: MIT
// Dents: the shape at rest follows what strains the body too far.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <vector>

namespace softbody {

/// Plastic flow of a body's rest positions. Strain is measured along the lines of the shape's springs, whether or not they pull:
/// e = |x_b - x_a| / |q_b - q_a| - 1. A line whose |e| exceeds its yield y has the excess share 1 - y/|e|; a point has the largest
/// of its lines. In a substep of h [s] each rest position moves by (1 - exp(-flow_rate h)) of this share of the point's displacement
/// from it, in the frame that turns with the body. So a uniform strain e flows with de/dt = -flow_rate (1 + e)(|e| - y), whatever the
/// substeps. Every term of the model reads the rest positions, and a dented body is an ordinary body of another shape.
///
/// Center, orientation and area of the rest shape stay. No line's length at rest changes by more than `max_dent` of its first. A
/// spring that is k times as stiff as the mean of the shape's springs has k times the yield: painted factors make weak and hard
/// spots. A body that is folded, or has lost three quarters of its area, does not flow. Flow never adds energy: where local flow
/// would, all points flow by one share; where that would, none do.
///
/// The scheme is that of Müller et al. 2005, sec. 4.4 (creep beyond a yield), of the rest positions instead of one linear map.
/// Owns nothing but scratch memory.
class PlasticFlow {
public:
	/// Returns whether the rest shape has changed. Precondition: `body.settings().can_dent()`. O(springs) below the yield, else
	/// O(hull² + points · modes + springs).
	bool flow(SoftBodyData &body, Real h);

private:
	bool find_shares(const SoftBodyData &body);
	bool place(const SoftBodyData &body, Real rate);
	void limit(const SoftBodyData &body);
	bool exceeds(const SoftBodyData &body, Real most) const;

	std::vector<Real> shares_; ///< of each point [1]
	std::vector<Vec2> places_; ///< rest positions to be
};

} // namespace softbody
