// SPDX-License-Identifier: MIT
// Cuts a simple polygon along a line of straight parts into smaller simple polygons.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// A corner of the pieces. It tells where it comes from, so that any value of the polygon's corners can be carried to it.
struct CutPoint {
	Vec2 position; ///< in the polygon that was cut [length]
	Vec2 twin; ///< in the polygon's other state [length]
	std::uint32_t a = 0; ///< an earlier point; its own index for a corner of the polygon
	std::uint32_t b = 0; ///< an earlier point; `a` for a corner of the polygon
	double t = 0; ///< of the straight way from `a` to `b` [1], 0..1
	std::vector<double> weights = {}; ///< for a bend of the blade inside, one a corner of the polygon; then `a`, `b` and `t` do not count
};

/// Part of a blade that goes through the polygon from outline to outline and cuts nothing.
struct RefusedSpan {
	enum class Reason : std::uint8_t {
		SMALL, ///< one side is below CutLimits::least_area; `value` is its area
		THIN, ///< one side is below CutLimits::least_width; `value` is its width
		CROSSING, ///< the sides would cross themselves, in either state
		MANY, ///< there are CutLimits::most_pieces already
	};
	Reason reason = Reason::SMALL;
	Vec2 from; ///< where it enters [length]
	Vec2 to; ///< where it leaves [length]
	double value = 0;
};

/// Bounds of a cut. All areas and widths are those of the other state, at rest.
struct CutLimits {
	double least_area = 0; ///< of a piece [length²]
	double least_width = 0; ///< twice the area over the perimeter [length]
	/// Distance of the points put along the cut [length]; 0: none but the bends of the blade. Bends are followed to about
	/// half of it.
	double spacing = 0;
	/// Least distance of a new corner from the next one [length], in either state. What lies closer is cut at the old
	/// corner instead.
	double snap = 0;
	std::size_t most_pieces = 64;
};

/// Pieces of a polygon, each a list of points of positive area; the piece with most area is the first. If nothing was
/// cut, the only piece is the polygon.
struct PolygonCut {
	std::vector<CutPoint> points; ///< first the polygon's corners, then new ones
	std::vector<std::vector<std::uint32_t>> pieces;
	std::vector<RefusedSpan> refused;
};

/// Cuts `polygon`, which is simple and of positive area, along `blade`. Only parts of the blade that go from outline to
/// outline through the inside cut; a part that begins or ends inside cuts nothing, and so does one along an edge. Where
/// the blade crosses itself inside, the loop is left out. Both sides of a cut get its points. `twin` has the same corners in
/// another state, such as at rest; pieces are simple and within limits there, too. Equal input gives equal output.
/// O(pieces · (points · blade + points²)).
PolygonCut cut_polygon(std::span<const Vec2> polygon, std::span<const Vec2> twin, std::span<const Vec2> blade, const CutLimits &limits);

/// For each edge of a piece, from its point of that index to the next, the edge of the polygon on which it lies, from the corner
/// of this index to the next; nothing for an edge that the cut made. O(points).
std::vector<std::optional<std::uint32_t>> source_edges(const PolygonCut &cut, std::size_t corner_count, std::span<const std::uint32_t> piece);

/// Values of the polygon's corners, such as velocities or colors, carried to all points of the cut.
template <class Value, class Corners>
std::vector<Value> carried(const PolygonCut &cut, const Corners &corners) {
	std::vector<Value> values;
	values.reserve(cut.points.size());
	for (std::size_t i = 0; i < cut.points.size(); ++i) {
		const CutPoint &point = cut.points[i];
		using Factor = decltype(Vec2::x);
		if (!point.weights.empty()) {
			const Value first = corners[0]; // sums of differences keep digits far from the origin
			Value sum = first;
			for (std::size_t k = 1; k < point.weights.size(); ++k) {
				sum += (corners[k] - first) * Factor(point.weights[k]);
			}
			values.push_back(sum);
		} else if (point.a == point.b) {
			values.push_back(corners[i]);
		} else {
			const Value from = values[point.a];
			values.push_back(from + (values[point.b] - from) * Factor(point.t));
		}
	}
	return values;
}

} // namespace softbody
