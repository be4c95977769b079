// SPDX-License-Identifier: MIT
// Restitution between two bodies as wholes.
#include "core/collision/pair_bounce.h"

#include "core/collision/point_edge_constraint.h"
#include "core/model/body_frame.h"

#include <algorithm>

namespace softbody {

void follow_pair_bounce(const SoftBodyData &first, const SoftBodyData &second, Vec2 push, PairTouch &touch,
		Real bounce_threshold, Real h) {
	const Real restitution = std::min(signed_restitution(first.settings().restitution, first.settings().absorbent) +
					signed_restitution(second.settings().restitution, second.settings().absorbent),
			Real(1));
	if (!(restitution > 0) || (push == Vec2{} && !touch.touching)) {
		return;
	}
	const Translation a = measure_translation(first);
	const Translation b = measure_translation(second);
	const Real inverse_mass = whole_inverse_mass(first) + whole_inverse_mass(second);
	const Vec2 line = a.center - b.center;
	const Real distance = length(line);
	if (!(inverse_mass > 0) || !(distance > 0)) {
		return;
	}
	const Vec2 normal = line * (1 / distance);
	const Real leaving = dot(a.velocity - b.velocity, normal);
	if (push != Vec2{}) {
		// The approach includes what this substep's contacts have just removed.
		remember_approach(touch, dot(push, normal) * inverse_mass - leaving, bounce_threshold, h);
	} else {
		end_touch(touch, restitution, leaving, bounce_threshold);
	}
}

} // namespace softbody
