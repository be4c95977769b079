// SPDX-License-Identifier: MIT
// Divides a hull into convex parts by point index, so that the parts follow the points.
#pragma once

#include "core/base/vec2.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Two divisions of one hull. Each lists point indices in the order of the part's outline.
struct HullParts {
	/// As few parts as possible, convex and compact at rest: one for a ball, three for a long bar (which may bend).
	std::vector<std::vector<std::uint32_t>> convex;
	/// For a hull with dents: runs of an outline of `convex`, each of which forms a wedge with the middle of its part.
	struct Wedge {
		std::uint32_t part = 0; ///< index into `convex`
		std::uint32_t first = 0; ///< index in the part's list at which the run starts; it may wrap around
		std::uint32_t count = 0; ///< points of the run, >= 2
	};
	std::vector<Wedge> wedges; ///< at least as many as `convex`
};

/// `rest_hull`: a simple polygon of positive winding. O(n²) once a hull.
HullParts divide_hull(std::span<const Vec2> rest_hull);

/// A dent, as a convex hull fills it.
struct Dent {
	Real depth = 0; ///< how far its deepest point lies inside of the convex hull [length]
	Vec2 middle; ///< of what is filled there
};

/// Writes the convex hull of a part's points, of positive winding, into `r_outline`; nothing for points in line.
/// `r_workspace` is kept by the caller, so that it grows once. Returns the deepest dent. O(n), O(n log n) where the
/// points are not convex.
Dent gather_part(std::span<const Vec2> hull, const std::vector<std::uint32_t> &part, std::vector<Vec2> &r_workspace,
		std::vector<Vec2> &r_outline);

/// Writes the convex hull of a wedge.
void gather_wedge(std::span<const Vec2> hull, const HullParts &parts, const HullParts::Wedge &wedge,
		std::vector<Vec2> &r_workspace, std::vector<Vec2> &r_outline);

} // namespace softbody
