// SPDX-License-Identifier: MIT
// Fills an outline with evenly placed points and with triangles between them.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/geometry/holed_polygon.h"
#include "core/model/elastic_triangles.h"

#include <memory>
#include <span>
#include <vector>

namespace softbody {

/// Points of a hexagonal lattice inside an outline of either winding, moved a little so that triangles are even at the
/// outline too. They keep about 0.7 of the lattice's spacing from the outline and from `own_points`. Spacing and place
/// of the lattice are chosen so that there are `count` points, or nearly as many. Deterministic. Precondition:
/// `check_hull` accepts the outline. O(count · outline) for each of some tens of spacings, and a few triangulations.
/// With holes their outlines come first, in points about a spacing apart, and are not counted; none of the others is in a hole.
std::vector<Vec2> even_inner_points(std::span<const Vec2> hull, std::span<const Vec2> own_points, std::size_t count, const Holes &holes = {});

/// A body made of triangles: masses of its points, and its triangles.
struct TriangleMesh {
	std::vector<Real> mass_shares; ///< one a point, summing to 1: a third of each of its triangles' areas
	std::shared_ptr<const ElasticTriangles> triangles;
};

/// Fills the outline `points[0, hull_count)`, of positive winding, with triangles whose corners are all of the points
/// (constrained Delaunay triangulation, see `triangulate`). Refuses inner points outside or on another point
/// ("inner_points[i]", i counted from `hull_count`), and an outline where rounding leaves no triangle of positive area
/// ("hull"). Triangles in `holes` are left out; where the points do not follow the outline of a hole it is refused ("holes"). Allocates;
/// takes some milliseconds for a few hundred points.
Result<TriangleMesh> make_triangle_mesh(std::span<const Vec2> points, std::size_t hull_count, const Holes &holes = {});

} // namespace softbody
