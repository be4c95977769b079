// SPDX-License-Identifier: MIT
// Measures and checks of triangles and closed polygons.
#include "core/geometry/polygon.h"

#include "core/base/constants.h"
#include "core/geometry/edge_pack.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace softbody {

namespace {

// Moments are summed about the first point and in double: far from the origin the plain shoelace
// sum would lose the area in the rounding of large products.
struct Moments {
	double double_area = 0;
	double x = 0;
	double y = 0;
};

Moments moments(std::span<const Vec2> polygon) {
	Moments sum;
	for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
		const Vec2d a = difference(polygon[i], polygon[0]);
		const Vec2d b = difference(polygon[i + 1], polygon[0]);
		const double twice = cross(a, b);
		sum.double_area += twice;
		sum.x += twice * (a.x + b.x) / 3;
		sum.y += twice * (a.y + b.y) / 3;
	}
	return sum;
}

Error hull_error(const std::string &value, const std::string &bound, const std::string &remedy) {
	return { "hull", value, bound, remedy };
}

// The first place at which a polygon meets itself, by the indices of its points or edges.
struct SelfContact {
	enum class Kind { COINCIDENT_POINTS,
		FOLDED_BACK,
		MEETING_EDGES };
	Kind kind;
	std::size_t first;
	std::size_t second;
};

std::optional<SelfContact> find_self_contact(std::span<const Vec2> polygon) {
	const std::size_t count = polygon.size();
	for (std::size_t i = 0; i < count; ++i) {
		if (polygon[i] == polygon[(i + 1) % count]) {
			return SelfContact{ SelfContact::Kind::COINCIDENT_POINTS, i, (i + 1) % count };
		}
	}
	for (std::size_t i = 0; i < count; ++i) {
		// The next edge shares a corner by construction, but must not fold back onto this one.
		const Vec2 a = polygon[i];
		const Vec2 b = polygon[(i + 1) % count];
		const Vec2 c = polygon[(i + 2) % count];
		if (signed_double_area(a, b, c) == 0 && dot(b - a, c - b) < 0) {
			return SelfContact{ SelfContact::Kind::FOLDED_BACK, i, (i + 1) % count };
		}
		const Aabb box = { { std::min(a.x, b.x), std::min(a.y, b.y) }, { std::max(a.x, b.x), std::max(a.y, b.y) } };
		for (std::size_t j = i + 2; j < count; ++j) {
			const Vec2 from = polygon[j];
			const Vec2 to = polygon[j + 1 < count ? j + 1 : 0];
			if ((from.x < box.min.x && to.x < box.min.x) || (from.x > box.max.x && to.x > box.max.x) ||
					(from.y < box.min.y && to.y < box.min.y) || (from.y > box.max.y && to.y > box.max.y)) {
				continue; // as nearly all
			}
			if ((j + 1) % count != i && segment_intersection(a, b, from, to)) {
				return SelfContact{ SelfContact::Kind::MEETING_EDGES, i, j };
			}
		}
	}
	return {};
}

std::string edge_text(std::size_t i, std::size_t count) {
	return "edge " + std::to_string(i) + "-" + std::to_string((i + 1) % count);
}

} // namespace

bool point_in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
	const double whole = signed_double_area(a, b, c);
	if (whole == 0) {
		return false;
	}
	// The sub-areas are the barycentric coordinates times the whole; p is inside when none has the opposite sign.
	const double u = signed_double_area(p, b, c);
	const double v = signed_double_area(a, p, c);
	const double w = signed_double_area(a, b, p);
	return whole > 0 ? (u >= 0 && v >= 0 && w >= 0) : (u <= 0 && v <= 0 && w <= 0);
}

Real signed_area(std::span<const Vec2> polygon) {
	return Real(moments(polygon).double_area / 2);
}

Real perimeter(std::span<const Vec2> polygon) {
	Real sum = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		sum += length(polygon[i] - polygon[i == 0 ? polygon.size() - 1 : i - 1]);
	}
	return sum;
}

Vec2 area_centroid(std::span<const Vec2> polygon) {
	if (polygon.empty()) {
		return {};
	}
	const Moments sum = moments(polygon);
	if (sum.double_area != 0) {
		return { Real(polygon[0].x + sum.x / sum.double_area), Real(polygon[0].y + sum.y / sum.double_area) };
	}
	Vec2 mean;
	for (const Vec2 p : polygon) {
		mean += p;
	}
	return mean * (Real(1) / Real(polygon.size()));
}

OutlinePlace nearest_place(std::span<const Vec2> outline, Vec2 p) {
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	NearestEdges nearest;
	for (std::size_t i = 0; i < packs_for(outline.size()); ++i) {
		const EdgePack edges = edges_at(outline, i * PACK_WIDTH);
		const RealPack distance = squared_distance(edges.end - edges.start, point - edges.start);
		nearest.consider(i, distance, distance < RealPack(NearestEdges::FAR));
	}
	const std::optional<std::size_t> found = nearest.first();
	if (!found) {
		return { 0, 0, outline[0], NearestEdges::FAR };
	}
	const std::size_t edge = *found < outline.size() ? *found : 0; // the lane may be a copy of the first corner
	const Vec2 a = outline[edge];
	const Vec2 b = outline[edge + 1 == outline.size() ? 0 : edge + 1];
	const Real t = closest_parameter_on_segment(p, a, b);
	const Vec2 place = a + (b - a) * t;
	return { edge, t, place, length_squared(p - place) };
}

bool point_in_polygon(Vec2 p, std::span<const Vec2> polygon) {
	bool inside = false;
	for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
		const Vec2 a = polygon[j];
		const Vec2 b = polygon[i];
		// Half-open in y, so that a ray through a corner is counted once.
		if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) {
			inside = !inside;
		}
	}
	return inside;
}

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

bool is_star_shaped_about(Vec2 center, std::span<const Vec2> polygon) {
	const bool positive = signed_area(polygon) > 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const double twice = signed_double_area(center, polygon[i], polygon[(i + 1) % polygon.size()]);
		if (positive ? twice < 0 : twice > 0) {
			return false;
		}
	}
	return true;
}

bool is_self_intersecting(std::span<const Vec2> polygon) {
	return find_self_contact(polygon).has_value();
}

bool is_folded(std::span<const Vec2> hull) {
	return !(signed_area(hull) > 0) || is_self_intersecting(hull);
}

Status check_hull(std::span<const Vec2> hull) {
	const std::size_t count = hull.size();
	if (count < std::size_t(MIN_HULL_POINTS) || count > std::size_t(MAX_HULL_POINTS)) {
		return hull_error(std::to_string(count) + " points",
				"must have between " + std::to_string(MIN_HULL_POINTS) + " and " + std::to_string(MAX_HULL_POINTS) +
						" points",
				count < std::size_t(MIN_HULL_POINTS) ? "add points until they enclose an area"
													 : "simplify the outline");
	}
	if (Status status = check_all_finite("hull", hull)) {
		return status;
	}
	if (const auto contact = find_self_contact(hull)) {
		const std::string first = edge_text(contact->first, count);
		const std::string second = edge_text(contact->second, count);
		switch (contact->kind) {
			case SelfContact::Kind::COINCIDENT_POINTS:
				return hull_error("points " + std::to_string(contact->first) + " and " + std::to_string(contact->second) +
								" coincide",
						"must have distinct neighboring points", "move or remove one of the two points");
			case SelfContact::Kind::FOLDED_BACK:
				return hull_error(second + " folds back onto " + first, "must not intersect itself",
						"move one of these points");
			case SelfContact::Kind::MEETING_EDGES:
				return hull_error(first + " meets " + second, "must not intersect itself",
						"move one of these points so that the outline does not cross");
		}
	}
	if (signed_area(hull) == 0) {
		return hull_error("zero area", "must enclose an area", "move a point off the line");
	}
	return {};
}

} // namespace softbody
