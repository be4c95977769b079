// SPDX-License-Identifier: MIT
// The convex hull of a small set of points.
#include "core/geometry/convex_hull.h"

#include "core/geometry/triangle.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace softbody {

std::span<const Vec2> convex_hull(std::span<const Vec2> points, std::span<Vec2> workspace) {
	assert(workspace.size() >= 2 * points.size());
	// The back half holds the points sorted, the front half grows the hull.
	const std::span<Vec2> sorted = workspace.subspan(points.size(), points.size());
	std::copy(points.begin(), points.end(), sorted.begin());
	std::sort(sorted.begin(), sorted.end(), [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
	const std::size_t distinct = std::size_t(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
	if (distinct < 2) {
		std::copy_n(sorted.begin(), distinct, workspace.begin());
		return workspace.first(distinct);
	}

	std::size_t count = 0;
	std::size_t chain_start = 0; // corners before it belong to the finished lower chain
	const auto add = [&](Vec2 p) {
		while (count >= chain_start + 2 && signed_double_area(workspace[count - 2], workspace[count - 1], p) <= 0) {
			count--;
		}
		workspace[count++] = p;
	};
	for (std::size_t i = 0; i < distinct; ++i) {
		add(sorted[i]);
	}
	// From right to left. The upper chain starts at the lower one's last corner and ends where that began. A corner of
	// the lower chain stays on the upper chain only until the next point comes, so the chains hold at most one more
	// than the points. They may overwrite sorted[0], which is then taken from the lower chain.
	chain_start = count - 1;
	for (std::size_t i = distinct - 2; i > 0; --i) {
		add(sorted[i]);
	}
	add(workspace[0]);
	return workspace.first(count - 1);
}

} // namespace softbody
