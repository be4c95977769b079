// SPDX-License-Identifier: MIT
// The round outline that the straight edges of a polygon stand for.
#include "core/geometry/round_outline.h"

#include "core/base/constants.h"

#include <algorithm>
#include <cmath>

namespace softbody {

std::vector<Real> edge_bulges(std::span<const Vec2> outline) {
	const std::size_t count = outline.size();
	const auto edge = [&](std::size_t i) { return outline[(i + 1) % count] - outline[i % count]; };
	const auto turn = [&](std::size_t i) { return double(half_turn<Real>(edge(i + count - 1), edge(i))); };
	std::vector<Real> bulges(count);
	for (std::size_t i = 0; i < count; ++i) {
		const double here = length(edge(i));
		const auto [shortest, longest] = std::minmax({ here, double(length(edge(i + count - 1))), double(length(edge(i + 1))) });
		const auto [least, most] = std::minmax({ turn(i), turn(i + 1) });
		if (least > 0 && most <= MOST_ROUND_HALF_TURN && longest <= MOST_ROUND_RATIO * shortest) {
			bulges[i] = Real(here / 2 * least / (1 + std::sqrt(1 + least * least))); // half the edge times tan(turn / 4)
		}
	}
	return bulges;
}

} // namespace softbody
