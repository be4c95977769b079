// SPDX-License-Identifier: MIT
// Measures and checks of a polygon with holes.
#include "core/geometry/holed_polygon.h"

#include "core/base/constants.h"
#include "core/geometry/polygon.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace softbody {

namespace {

// Integrals of 1, x, y and x² + y² over a closed outline of positive winding, about `origin`; of negative winding with the other sign. A
// triangle from the origin to an edge ab has the area c / 2 with c = a × b, its centroid at (a + b) / 3, and the polar moment
// c (a·a + a·b + b·b) / 12.
struct Integrals {
	double area = 0;
	Vec2d first;
	double polar = 0;
};

Integrals integrals_of(std::span<const Vec2> outline, Vec2d origin) {
	Integrals sums;
	for (std::size_t i = 0; i < outline.size(); ++i) {
		const Vec2d a = Vec2d(outline[i]) - origin;
		const Vec2d b = Vec2d(outline[i + 1 == outline.size() ? 0 : i + 1]) - origin;
		const double twice = cross(a, b);
		sums.area += twice / 2;
		sums.first += (a + b) * (twice / 6);
		sums.polar += twice * (dot(a, a) + dot(a, b) + dot(b, b)) / 12;
	}
	return sums;
}

void add(Integrals &to, const Integrals &more, double factor) {
	to.area += factor * more.area;
	to.first += more.first * factor;
	to.polar += factor * more.polar;
}

// The first edges of two outlines that touch.
std::optional<std::pair<std::size_t, std::size_t>> find_meeting_edges(std::span<const Vec2> a, std::span<const Vec2> b) {
	for (std::size_t i = 0; i < a.size(); ++i) {
		for (std::size_t j = 0; j < b.size(); ++j) {
			if (segment_intersection(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) {
				return std::pair(i, j);
			}
		}
	}
	return {};
}

std::string edge_text(std::size_t edge) {
	return "the edge from point " + std::to_string(edge);
}

} // namespace

AreaMoments area_moments(std::span<const Vec2> hull, const Holes &holes) {
	const Vec2d origin(hull[0]); // keeps digits far from the origin of coordinates
	Integrals whole;
	const auto add_outline = [&](std::span<const Vec2> outline, double sign) {
		const Integrals of_outline = integrals_of(outline, origin);
		add(whole, of_outline, of_outline.area < 0 ? -sign : sign);
	};
	add_outline(hull, 1);
	for (const std::vector<Vec2> &hole : holes) {
		add_outline(hole, -1);
	}
	const Vec2d arm = whole.first * (1 / whole.area);
	return { whole.area, origin + arm, whole.polar - whole.area * dot(arm, arm) };
}

double holed_perimeter(std::span<const Vec2> hull, const Holes &holes) {
	double sum = double(perimeter(hull));
	for (const std::vector<Vec2> &hole : holes) {
		sum += double(perimeter(hole));
	}
	return sum;
}

bool point_in_holed_polygon(Vec2 p, std::span<const Vec2> hull, const Holes &holes) {
	return point_in_polygon(p, hull) && std::ranges::none_of(holes, [&](const std::vector<Vec2> &hole) { return point_in_polygon(p, hole); });
}

Status check_holes(const std::string &name, const Holes &holes, std::span<const Vec2> hull) {
	std::size_t points = 0;
	for (std::size_t i = 0; i < holes.size(); ++i) {
		const std::vector<Vec2> &hole = holes[i];
		const std::string entry = name + "[" + std::to_string(i) + "]";
		points += hole.size();
		if (points > std::size_t(MAX_HULL_POINTS)) {
			return Error{ name, "more than " + std::to_string(MAX_HULL_POINTS) + " points", "must be at most " + std::to_string(MAX_HULL_POINTS) + " points in all", "simplify the holes" };
		}
		if (Status status = check_hull(hole)) {
			status->name = entry + status->name.substr(std::string("hull").size());
			return status;
		}
		if (const auto meeting = find_meeting_edges(hole, hull)) {
			return Error{ entry, edge_text(meeting->first) + " meets that from point " + std::to_string(meeting->second) + " of the polygon", "must lie inside the polygon", "move the hole inside or make it smaller" };
		}
		if (!point_in_polygon(hole[0], hull)) {
			return Error{ entry, "outside the polygon", "must lie inside the polygon", "move the hole inside" };
		}
		for (std::size_t j = 0; j < i; ++j) {
			const std::string other = name + "[" + std::to_string(j) + "]";
			if (const auto meeting = find_meeting_edges(hole, holes[j])) {
				return Error{ entry, edge_text(meeting->first) + " meets that from point " + std::to_string(meeting->second) + " of " + other, "must not touch another hole", "move them apart or make them one hole" };
			}
			if (point_in_polygon(hole[0], holes[j]) || point_in_polygon(holes[j][0], hole)) {
				return Error{ entry, "one inside the other with " + other, "must not overlap another hole", "remove one of them" };
			}
		}
	}
	return {};
}

} // namespace softbody
