// SPDX-License-Identifier: MIT
// Restitution between two bodies as wholes.
#include "core/collision/pair_bounce.h"

#include "core/base/constants.h"
#include "core/collision/point_edge_constraint.h"

#include <algorithm>

namespace softbody {

void follow_pair_bounce(const SolverBody &first, const SolverBody &second, Vec2 push, PairTouch &touch, Real h) {
	const Real restitution = std::min(first.restitution + second.restitution, Real(1));
	if (!(restitution > 0) || (push == Vec2{} && !touch.touching)) {
		return;
	}
	const Vec2 line = first.mass_center - second.mass_center;
	const Real threshold = RESTITUTION_SUBSTEPS * h * std::max(first.pull, second.pull);
	if (push != Vec2{} && touch == PairTouch{ .touching = true }) {
		// A touch at rest stays one while the centers approach slowly: nothing needs a direction of unit length.
		const Real nearer = -dot(first.mass_velocity - second.mass_velocity + (first.acceleration - second.acceleration) * h, line);
		if (!(nearer > 0) || nearer * nearer <= threshold * threshold * length_squared(line)) {
			return;
		}
	}
	const Real distance = length(line);
	if (!(first.inverse_mass + second.inverse_mass > 0) || !(distance > 0)) {
		return;
	}
	const Vec2 normal = line * (1 / distance);
	const Real leaving = dot(first.mass_velocity - second.mass_velocity, normal);
	if (push != Vec2{}) {
		// What the contacts of this substep have removed would say less: in a heap at rest it is the weight of all above.
		remember_approach(touch, -leaving - dot(first.acceleration - second.acceleration, normal) * h, threshold, h);
	} else {
		end_touch(touch, restitution, leaving, threshold);
	}
}

} // namespace softbody
