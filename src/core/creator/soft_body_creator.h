// SPDX-License-Identifier: MIT
// Turns an outline and a few material values into the structure of a soft body.
#pragma once

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/model/soft_body_shape.h"

#include <memory>
#include <span>

namespace softbody {

/// What `SoftBodyCreator` puts inside an outline.
struct StructureOptions {
	Real mass = 1; ///< of the whole body [mass], > 0; every point gets an equal share
	Real stiffness = 100; ///< k of every spring [force/length], >= 0
	Real damping = 1; ///< c of every spring [force·s/length], >= 0
	bool centre_point = true; ///< add a point at the hull's mean, joined to every hull point
};

/// Builds soft bodies (thesis 4.4.2, "SoftBodyCreator"; Alg. 4.9 to 4.11). Fills data, simulates nothing.
class SoftBodyCreator {
public:
	/// The thesis's test body and its relatives: `point_count` hull points on a circle and a centre point.
	/// Refuses what `circle_hull` and `create_polygon` refuse.
	static Result<std::shared_ptr<const SoftBodyShape>> create_circle(Real radius, int point_count,
			const StructureOptions &options);

	/// Any simple polygon, convex or not. Hull springs join neighbours; the centre point sits at the
	/// mean of the hull points and is joined to all of them. Where the outline is not star-shaped
	/// about that point some of these springs cross the outline, which is legal: they only hold distances.
	/// A hull of negative winding is reversed about its first point: point i becomes (n - i) mod n.
	/// Refuses a bad hull (see `check_hull`), mass <= 0, negative or non-finite spring values, and a
	/// centre that coincides with a hull point.
	static Result<std::shared_ptr<const SoftBodyShape>> create_polygon(std::span<const Vec2> hull,
			const StructureOptions &options);
};

/// Damping coefficient c [force·s/length] that gives each spring the damping ratio `ratio`
/// on points of mass `total_mass / point_count`: c = ratio sqrt(k m).
Real damping_for_ratio(Real ratio, Real stiffness, Real total_mass, std::size_t point_count);

} // namespace softbody
