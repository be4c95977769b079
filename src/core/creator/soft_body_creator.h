// SPDX-License-Identifier: MIT
// Turns an outline and a few material values into the structure of a soft body.
#pragma once

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/creator/structure.h"
#include "core/geometry/holed_polygon.h"
#include "core/model/soft_body_shape.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace softbody {

/// What `SoftBodyCreator` puts inside an outline. Points are counted as given: outline, inner points, center point;
/// springs in the order of `springs`, or of `automatic_springs` if that is empty.
struct StructureOptions {
	Real mass = 1; ///< of the whole body [mass], > 0; every point gets an equal share
	Real stiffness = 100; ///< k of every spring [force/length], >= 0
	Real damping = 1; ///< c of every spring [force·s/length], >= 0
	bool center_point = true; ///< add a point at the hull's mean; the automatic springs join it to every hull point
	std::vector<Vec2> inner_points = {}; ///< further points, meant to lie inside the outline [length]
	/// Holes of the body [length]. Its masses have the center and the moment of inertia of the outline less its holes, the latter where an
	/// inner point can take up mass. Elastic modes and triangles are those of a solid with the holes; springs do not know of them.
	Holes holes = {};
	std::vector<SpringEnds> springs = {}; ///< all springs of the body; empty: the automatic ones
	// Factors on the values above and on the length as designed, one a spring; empty: all 1. A body painted with
	// factors still follows the common values and its outline.
	std::vector<Real> spring_stiffness_scales = {}; ///< [1], >= 0
	std::vector<Real> spring_damping_scales = {}; ///< [1], >= 0
	std::vector<Real> spring_length_scales = {}; ///< [1], > 0
	/// Whether masses are changed a little so that their center is the outline's area centroid (`balance_masses`), where they
	/// would be divided for other reasons: for a hull that stands for an outline of more points.
	bool balanced_mass = false;
	/// Whether the body can deform as an elastic solid (BodySettings::shear_modulus). `reduce_solid` then divides its
	/// mass, instead of equal shares.
	bool elastic = false;
	/// Whether the body is filled with elastic triangles (BodySettings::shear_modulus), whose corners are all of its
	/// points. Every point then gets a third of its triangles' mass instead of an equal share. There is no center
	/// point, and `elastic` must be false.
	bool elastic_triangles = false;
	/// Number of points placed evenly inside a body of triangles, after `inner_points` [1], 0..MAX_HULL_POINTS. See
	/// `even_inner_points`, which may place a few more or fewer. About 1.5 for each hull point give most of the
	/// accuracy; 4 take four times as long. Without any, the triangles are slivers, and the body is far too stiff.
	int triangle_points = 24;

	friend bool operator==(const StructureOptions &, const StructureOptions &) = default;
};

/// Refuses springs, as pairs of point indices, that no structure can have: an odd number of indices, indices below 0, a
/// spring from a point to itself, and two springs between the same points.
Status check_spring_pairs(const std::string &name, std::span<const std::int32_t> indices);

/// Removes from the options the part that `create_polygon` refused by this name, where a body can do without it: springs,
/// which fall back to the automatic ones, or factors on them. False when there is no such part.
bool leave_out(StructureOptions &options, const std::string &refused);

/// Builds soft bodies (thesis 4.4.2, "SoftBodyCreator"; Alg. 4.9 to 4.11). Fills data, simulates nothing.
class SoftBodyCreator {
public:
	/// Any simple polygon, convex or not; the center point sits at the mean of its points. A hull of negative winding
	/// is reversed about its first point: point i becomes (n - i) mod n, springs follow, and their order stays. Refuses
	/// a bad hull (see `check_hull`), bad holes (see `check_holes`), mass <= 0, negative or non-finite values, a center that coincides with a hull
	/// point unless springs are given, more than MAX_HULL_POINTS inner points, inner points that cannot be corners of
	/// triangles where there are triangles, springs that name a point twice or a missing point, repeat another or have
	/// no length, and a number of scales other than that of the springs.
	static Result<std::shared_ptr<const SoftBodyShape>> create_polygon(std::span<const Vec2> hull,
			const StructureOptions &options);
};

} // namespace softbody
