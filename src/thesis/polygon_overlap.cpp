// SPDX-License-Identifier: MIT
// Overlap of two polygons.
#include "thesis/polygon_overlap.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace softbody {

namespace {

using Triangle = std::array<Vec2d, 3>;

// Rest of a triangle after cuts by the three sides of another. Each cut adds at most one corner.
struct Clip {
	std::array<Vec2d, 6> corners;
	std::size_t count = 0;
};

// The part on the left of the line from p to q (Sutherland and Hodgman 1974).
Clip cut(const Clip &clip, Vec2d p, Vec2d q) {
	Clip rest;
	for (std::size_t i = 0; i < clip.count; ++i) {
		const Vec2d a = clip.corners[i];
		const Vec2d b = clip.corners[(i + 1) % clip.count];
		const double a_side = cross(q - p, a - p);
		const double b_side = cross(q - p, b - p);
		if (a_side >= 0) {
			rest.corners[rest.count++] = a;
		}
		if ((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0)) {
			rest.corners[rest.count++] = a + (b - a) * (a_side / (a_side - b_side));
		}
	}
	return rest;
}

double double_area(const Clip &clip) {
	double sum = 0;
	for (std::size_t i = 1; i + 1 < clip.count; ++i) {
		sum += cross(clip.corners[i] - clip.corners[0], clip.corners[i + 1] - clip.corners[0]);
	}
	return sum;
}

// Area that two triangles of positive winding share [length²].
double shared_area(const Triangle &a, const Triangle &b) {
	Clip clip{ { a[0], a[1], a[2] }, 3 };
	for (std::size_t i = 0; i < 3 && clip.count > 2; ++i) {
		clip = cut(clip, b[i], b[(i + 1) % 3]);
	}
	return double_area(clip) / 2;
}

// Triangle i of the fan about the polygon's first point, with positive winding. Its sign is 0 when it has no area.
struct FanTriangle {
	Triangle corners;
	int sign = 0;
};

FanTriangle fan_triangle(std::span<const Vec2> polygon, std::size_t i, Vec2 origin) {
	FanTriangle fan{ { difference(polygon[0], origin), difference(polygon[i], origin), difference(polygon[i + 1], origin) }, 0 };
	const double area = cross(fan.corners[1] - fan.corners[0], fan.corners[2] - fan.corners[0]);
	fan.sign = int(area > 0) - int(area < 0);
	if (fan.sign < 0) {
		std::swap(fan.corners[1], fan.corners[2]);
	}
	return fan;
}

double distance_to_border(Vec2 p, std::span<const Vec2> polygon) {
	double least = std::numeric_limits<double>::max();
	for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
		const Vec2d along = difference(polygon[i], polygon[j]);
		const Vec2d offset = difference(p, polygon[j]);
		const double size = dot(along, along);
		const double t = size > 0 ? std::clamp(dot(offset, along) / size, 0.0, 1.0) : 0.0;
		const Vec2d gap = offset - along * t;
		least = std::min(least, dot(gap, gap));
	}
	return std::sqrt(least);
}

double deepest_corner(std::span<const Vec2> corners, std::span<const Vec2> polygon) {
	double depth = 0;
	for (const Vec2 p : corners) {
		if (point_in_polygon(p, polygon)) {
			depth = std::max(depth, distance_to_border(p, polygon));
		}
	}
	return depth;
}

} // namespace

// A polygon is the sum of the triangles of a fan about any point, each with the sign of its winding. The signs cancel
// outside the polygon; inside they add up to the polygon's own sign. So the product of two such sums, integrated, is
// the shared area, up to the sign of the windings.
double overlap_area(std::span<const Vec2> a, std::span<const Vec2> b) {
	if (a.size() < 3 || b.size() < 3 || !bounding_box(a).overlaps(bounding_box(b))) {
		return 0;
	}
	const Vec2 origin = a[0];
	double sum = 0;
	for (std::size_t i = 1; i + 1 < a.size(); ++i) {
		const FanTriangle of_a = fan_triangle(a, i, origin);
		for (std::size_t j = 1; of_a.sign != 0 && j + 1 < b.size(); ++j) {
			const FanTriangle of_b = fan_triangle(b, j, origin);
			if (of_b.sign != 0) {
				sum += of_a.sign * of_b.sign * shared_area(of_a.corners, of_b.corners);
			}
		}
	}
	return std::abs(sum);
}

double penetration_depth(std::span<const Vec2> a, std::span<const Vec2> b) {
	if (!bounding_box(a).overlaps(bounding_box(b))) {
		return 0;
	}
	return std::max(deepest_corner(a, b), deepest_corner(b, a));
}

} // namespace softbody
