// SPDX-License-Identifier: MIT
// Finds the few hull points that stand for an outline of many.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace softbody {

/// Tolerances of a simplified outline, as shares of the radius of a disk of its area [1]. Smaller: rounding decides.
/// Larger: the hull has nothing of the outline but its area.
inline constexpr double LEAST_DETAIL_TOLERANCE = 0.001;
inline constexpr double MOST_DETAIL_TOLERANCE = 0.5;

/// Range of `SimplifyOptions::weights` [1].
inline constexpr double LEAST_DETAIL_WEIGHT = 0.1;
inline constexpr double MOST_DETAIL_WEIGHT = 10;

/// Longest edge of a simplified outline, as a share of its perimeter [1], unless the outline has a longer one itself.
/// Larger: boxes cannot bend in the middle of their sides. Smaller: long bodies take points that nothing needs.
inline constexpr double LONGEST_SIMPLE_EDGE = 0.125;

/// How far an outline is simplified. Shares are of the radius of the disk that has the outline's area.
struct SimplifyOptions {
	/// Largest distance between the outline and the hull, in both directions, as a share of the radius [1], 0.001..0.5.
	/// Larger: fewer points, and contacts farther from what is drawn.
	double tolerance = 0.03;
	/// Number of points below which the outline is simplified no further [1], >= 3. Rounder bodies roll better, and a
	/// body of few points bends at few places.
	int fewest_points = 16;
	/// Number of points that the hull has at most, whatever its error [1], >= 3; 0: as many as the tolerance needs.
	int most_points = 0;
	/// Least distance of neighboring hull points [length], >= 0: the contact margin. Neighbors that are closer than the
	/// tolerance are joined first in any case.
	Real least_edge = 0;
	/// How fine the outline is kept at each of its points [1], LEAST_DETAIL_WEIGHT..MOST_DETAIL_WEIGHT, or none: 1 everywhere. The tolerance, and
	/// the least and the longest edge there are divided by it. The error that is reported counts distances by it.
	std::vector<float> weights = {};

	friend bool operator==(const SimplifyOptions &, const SimplifyOptions &) = default;
};

/// A hull that stands for an outline of more points.
struct SimplifiedOutline {
	/// The hull: simple, of the outline's winding, area and area centroid, each up to rounding [length].
	std::vector<Vec2> hull;
	/// The place of the outline that each hull point stands for: `i + t` is t of the way from the outline's point i to the
	/// next [1]. They rise from the first hull point on, and wrap around at most once.
	std::vector<double> places;
	/// Bound on the distance of any point of the outline from the hull, and of the hull from the outline, as a share of
	/// the radius [1]. 0 where the hull is the outline.
	double error = 0;
	bool is_outline = false; ///< whether the hull is the outline itself, point by point
};

/// Refuses options out of their ranges, by name: weights as "weights[i]".
Status check_simplify_options(const SimplifyOptions &options);

/// Refuses weights out of their range, as `name[i]`.
Status check_detail_weights(const std::string &name, std::span<const float> weights);

/// Radius of the disk that has the outline's area [length]. O(n).
double radius_of_area(std::span<const Vec2> outline);

/// Few hull points that keep an outline within a tolerance: `OutlineCollapse` takes points out with the area kept. At last
/// the hull is shifted by the little that its centroid has drifted. No edge grows longer than LONGEST_SIMPLE_EDGE of the
/// perimeter, so that long sides can bend. Where nothing can be saved the outline itself is returned. The same
/// outline gives the same bits on every platform. Refuses options out of range, and weights of another number than points; the outline must pass `check_hull`.
/// About O(n²): a few milliseconds for 200 points, half a second for 4096.
Result<SimplifiedOutline> simplify_outline(std::span<const Vec2> outline, const SimplifyOptions &options);

} // namespace softbody
