// SPDX-License-Identifier: MIT
// Geometry on the integer grid, against exact answers by other formulas.
#include "core/geometry/polygon.h"
#include "thesis/gjk.h"
#include "thesis/polygon_overlap.h"
#include "core/geometry/segment.h"
#include "core/skin/triangulation.h"
#include "fuzz/bytes.h"
#include "fuzz/targets.h"
#include "geometry/integer_geometry.h"
#include "thesis/segment_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softbody::fuzzing {

namespace {

using testing::GridPoint;

constexpr int SIZE = 15; // a small grid: coincident points and points in line are common
constexpr double ROUNDING = 16 * std::numeric_limits<Real>::epsilon();

GridPoint grid_point(Bytes &bytes) {
	const int byte = bytes.byte();
	return { byte % (SIZE + 1), byte / (SIZE + 1) };
}

std::vector<GridPoint> grid_points(Bytes &bytes, int least, int most) {
	std::vector<GridPoint> points;
	for (int i = bytes.integer(least, most); i > 0; --i) {
		points.push_back(grid_point(bytes));
	}
	return points;
}

double distance_to_segment(GridPoint p, GridPoint a, GridPoint b) {
	const double x = double(b.x - a.x);
	const double y = double(b.y - a.y);
	const double squared = x * x + y * y;
	const double t = squared > 0 ? std::clamp((double(p.x - a.x) * x + double(p.y - a.y) * y) / squared, 0.0, 1.0) : 0;
	return std::hypot(double(a.x) + t * x - double(p.x), double(a.y) + t * y - double(p.y));
}

// Of the segments as sets: 0 where they meet, else between an end of one and the other.
double segment_distance(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
	if (testing::grid_intersection(a, b, c, d)) {
		return 0;
	}
	return std::min({ distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b), distance_to_segment(d, a, b) });
}

void check_segments(Bytes &bytes) {
	const GridPoint a = grid_point(bytes);
	const GridPoint b = grid_point(bytes);
	const GridPoint c = grid_point(bytes);
	const GridPoint d = grid_point(bytes);
	const auto exact = testing::grid_intersection(a, b, c, d);
	const auto found = segment_intersection(a, b, c, d);
	require(exact.has_value() == found.has_value(), "segments meet where they meet");
	require(!exact || std::abs(double(*found) - exact->value()) <= ROUNDING, "at the right place");
	const SegmentDistance closest = closest_points_on_segments(a, b, c, d);
	require(std::abs(double(closest.distance) - segment_distance(a, b, c, d)) <= ROUNDING * SIZE, "segments are as far apart as they are");
	const long twice = testing::grid_cross(b - a, c - a);
	require(signed_double_area(a, b, c) == double(twice), "twice a triangle's area is a whole number");
	const bool is_inside = twice != 0 && (testing::grid_cross(b - a, d - a) * twice >= 0) &&
			testing::grid_cross(c - b, d - b) * twice >= 0 && testing::grid_cross(a - c, d - c) * twice >= 0;
	require(point_in_triangle(d, a, b, c) == is_inside, "a triangle contains what is on the inner side of all its edges");
}

// All three move from one grid point to another. The exact times are the roots of a quadratic with integer coefficients.
void check_impact(Bytes &bytes) {
	std::array<GridPoint, 6> at;
	for (GridPoint &p : at) {
		p = grid_point(bytes);
	}
	const auto found = point_segment_impact({ at[0], at[1] }, { at[2], at[3] }, { at[4], at[5] });
	const auto place = [&](int i, double time) {
		return std::array{ double(at[std::size_t(i)].x) * (1 - time) + double(at[std::size_t(i) + 1].x) * time,
			double(at[std::size_t(i)].y) * (1 - time) + double(at[std::size_t(i) + 1].y) * time };
	};
	const auto gap = [&](double time) {
		const auto p = place(0, time);
		const auto a = place(2, time);
		const auto b = place(4, time);
		const double x = b[0] - a[0];
		const double y = b[1] - a[1];
		const double squared = x * x + y * y;
		const double t = squared > 0 ? std::clamp(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / squared, 0.0, 1.0) : 0;
		return std::hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]);
	};
	if (found) {
		require(found->time >= 0 && found->time <= 1 && found->parameter >= 0 && found->parameter <= 1, "an impact is within its bounds");
		// The time is rounded to Real, and everything moves by up to 2 SIZE in a time of 1; 1e-6 is the segment's allowance.
		require(gap(double(found->time)) <= 4 * SIZE * (ROUNDING + 1e-6), "at the time of an impact the point is on the segment");
		return;
	}
	// A miss: at no time is the point on the segment, wherever one looks.
	for (int i = 0; i <= 16; ++i) {
		require(gap(i / 16.0) > 0, "no hit is missed");
	}
}

void check_polygons(Bytes &bytes) {
	const std::vector<GridPoint> polygon = grid_points(bytes, 3, 10);
	const std::vector<Vec2> hull = testing::to_real(polygon);
	const long twice = testing::grid_double_area(polygon);
	require(double(signed_area(hull)) == double(twice) / 2, "areas are half whole numbers");
	const bool is_simple = testing::grid_is_simple(polygon);
	require(is_self_intersecting(hull) == !is_simple, "a polygon meets itself or is simple");
	require(!check_hull(hull) == (is_simple && twice != 0), "hulls are simple polygons with an area");
	const GridPoint p = grid_point(bytes);
	if (is_simple && !testing::grid_on_border(p, polygon)) {
		require(point_in_polygon(p, hull) == (testing::grid_winding_number(p, polygon) != 0), "inside is what is wound around");
	}
	if (!is_simple || twice == 0) {
		return;
	}
	long sum = 0;
	for (const Triangle &t : triangulate(hull, hull.size())) {
		const long area = testing::grid_cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]);
		require(area >= 0, "triangles wind positively");
		sum += area;
	}
	require(sum == std::labs(twice), "triangles cover a polygon once");
	const std::vector<GridPoint> other = grid_points(bytes, 3, 8);
	if (testing::grid_is_simple(other) && testing::grid_double_area(other) != 0) {
		const std::vector<Vec2> b = testing::to_real(other);
		const double shared = overlap_area(hull, b);
		const double least = std::min(std::abs(double(signed_area(hull))), std::abs(double(signed_area(b))));
		require(shared >= 0 && shared <= least + 1e-9, "polygons share at most the smaller one");
		require(std::abs(shared - overlap_area(b, hull)) <= 1e-9, "and alike, whichever comes first");
	}
	require(std::abs(overlap_area(hull, hull) - std::labs(twice) / 2.0) <= 1e-9, "a polygon shares all with itself");
}

// The corners of a convex hull, by asking of each point whether a line through it has all others on one side.
double distance_of_sets(const std::vector<GridPoint> &a, const std::vector<GridPoint> &b) {
	double least = std::numeric_limits<double>::infinity();
	for (const GridPoint p : a) {
		for (const GridPoint q : a) {
			for (const GridPoint r : b) {
				for (const GridPoint s : b) {
					least = std::min(least, segment_distance(p, q, r, s));
				}
			}
		}
	}
	const auto contains = [](const std::vector<GridPoint> &set, GridPoint p) { // by Carathéodory: in some triangle of it
		for (const GridPoint q : set) {
			for (const GridPoint r : set) {
				for (const GridPoint s : set) {
					const long twice = testing::grid_cross(r - q, s - q);
					if (twice > 0 && testing::grid_cross(r - q, p - q) >= 0 && testing::grid_cross(s - r, p - r) >= 0 &&
							testing::grid_cross(q - s, p - s) >= 0) {
						return true;
					}
				}
			}
		}
		return false;
	};
	return contains(a, b[0]) || contains(b, a[0]) ? 0 : least;
}

void check_sets(Bytes &bytes) {
	const std::vector<GridPoint> a = grid_points(bytes, 1, 6);
	const std::vector<GridPoint> b = grid_points(bytes, 1, 6);
	const std::vector<Vec2> points = testing::to_real(a);
	const std::vector<Vec2> others = testing::to_real(b);
	const double exact = distance_of_sets(a, b);
	const GjkResult found = gjk(points, others);
	require(found.overlap == (exact == 0), "sets are apart or they overlap");
	require(std::abs(double(found.distance) - exact) <= ROUNDING * SIZE, "by their distance");
	require(!is_apart(points, others, 0) || exact > 0, "what is certain to be apart is");
	std::vector<Vec2> workspace(2 * points.size());
	const std::span<const Vec2> corners = convex_hull(points, workspace);
	for (std::size_t i = 0; i < corners.size(); ++i) {
		const Vec2 p = corners[i];
		const Vec2 q = corners[(i + 1) % corners.size()];
		require(std::ranges::find(points, p) != points.end(), "corners of a convex hull are among the points");
		for (const Vec2 r : points) {
			require(signed_double_area(p, q, r) >= 0 || corners.size() < 3, "and no point lies outside");
		}
	}
}

} // namespace

void fuzz_geometry(std::span<const std::uint8_t> data) {
	Bytes bytes(data);
	for (int rounds = 0; rounds < 8 && !bytes.is_empty(); ++rounds) {
		switch (bytes.integer(0, 3)) {
			case 0: check_segments(bytes); break;
			case 1: check_impact(bytes); break;
			case 2: check_polygons(bytes); break;
			case 3: check_sets(bytes); break;
		}
	}
}

} // namespace softbody::fuzzing
