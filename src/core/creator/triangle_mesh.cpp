// SPDX-License-Identifier: MIT
// Fills an outline with evenly placed points and with triangles between them.
#include "core/creator/triangle_mesh.h"

#include "core/creator/balanced_masses.h"
#include "core/creator/elastic_modes.h"
#include "core/creator/simplify_outline.h"
#include "core/geometry/aabb.h"
#include "core/geometry/polygon.h"
#include "core/skin/triangulation.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace softbody {

namespace {

// Least distance of a lattice point from the outline over the spacing. Smaller: flat triangles take more substeps.
constexpr double CLEARANCE = 0.7;

const double ROW_HEIGHT = std::sqrt(0.75); // of the lattice, over its spacing

// Least distance from the outline while points are moved to even out the triangles, over the spacing without clearance,
// and the number of moves.
constexpr double RELAXED_CLEARANCE = 0.5;
constexpr int RELAXATIONS = 8;

constexpr int SPACINGS = 28; // tried for each place of the lattice: to 1e-8 of the first guess

// Places of the lattice, as parts of its spacing and of its rows' distance. The first has a point in the middle; the
// others serve for numbers of points that a symmetric outline does not reach with it.
constexpr std::array<std::array<double, 2>, 6> PLACES = { { { 0, 0 }, { 0.5, 0 }, { 0.25, 0.5 }, { 0, 0.4 }, { 0.3, 0.2 }, { 0.15, 0.35 } } };

// Smallest area of a triangle over the square of its longest edge [1]. Float coordinates carry seven digits.
constexpr double LEAST_AREA = 1e-5;

constexpr int LEAST_HOLE_POINTS = 6;

// Difference of the triangles' area from that of the body with its holes, as a share of it, from which on they do not follow a hole.
constexpr double MOST_HOLE_ERROR = 0.05;

class Lattice {
public:
	Lattice(std::span<const Vec2> hull, std::span<const Vec2> own_points, const Holes &holes) :
			hull_(hull), own_points_(own_points), holes_(holes), middle_(area_centroid(hull)), box_(bounding_box(hull)) {}

	std::vector<Vec2> points(double spacing, std::array<double, 2> place) const {
		std::vector<Vec2> found;
		const double height = spacing * ROW_HEIGHT;
		const auto row_of = [&](double y) { return (y - middle_.y) / height - place[1]; };
		const double last = std::floor(row_of(double(box_.max.y)));
		for (double row = std::ceil(row_of(double(box_.min.y))); row <= last; ++row) {
			const double y = middle_.y + (row + place[1]) * height;
			const double shift = place[0] + (std::fmod(row, 2) != 0 ? 0.5 : 0);
			const std::vector<double> crossings = crossings_at(y);
			for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
				const double end = std::floor((crossings[k + 1] - middle_.x) / spacing - shift);
				for (double column = std::ceil((crossings[k] - middle_.x) / spacing - shift); column <= end; ++column) {
					const Vec2 p{ Real(middle_.x + (column + shift) * spacing), Real(y) };
					if (is_clear(p, CLEARANCE * spacing)) {
						found.push_back(p);
					}
				}
			}
		}
		return found;
	}

	bool is_clear(Vec2 p, double distance) const {
		const double least = distance * distance;
		return !(double(nearest_place(hull_, p).distance_squared) < least) &&
				std::ranges::none_of(own_points_, [&](Vec2 own) { return double(length_squared(own - p)) < least; }) &&
				std::ranges::none_of(holes_, [&](const std::vector<Vec2> &hole) {
					return point_in_polygon(p, hole) || double(nearest_place(hole, p).distance_squared) < least;
				});
	}

private:
	// Places where a horizontal line meets the outline, ascending; it is inside from the first to the second, and so
	// on.
	std::vector<double> crossings_at(double y) const {
		std::vector<double> crossings;
		for (std::size_t i = 0; i < hull_.size(); ++i) {
			const Vec2 a = hull_[i];
			const Vec2 b = hull_[(i + 1) % hull_.size()];
			if ((double(a.y) <= y) != (double(b.y) <= y)) {
				crossings.push_back(a.x + (y - a.y) / (double(b.y) - a.y) * (double(b.x) - a.x));
			}
		}
		std::ranges::sort(crossings);
		return crossings;
	}

	std::span<const Vec2> hull_;
	std::span<const Vec2> own_points_;
	const Holes &holes_;
	Vec2 middle_;
	Aabb box_;
};

// The lattice points in one place whose number comes closest to `count`. A larger spacing gives fewer points, except
// for single points that come and go.
std::vector<Vec2> nearest_count(const Lattice &lattice, double spacing, std::array<double, 2> place, std::size_t count) {
	constexpr int HALVINGS = 20;
	std::vector<Vec2> best = lattice.points(spacing, place);
	double most = 2 * spacing; // too few
	double least = spacing; // enough
	for (int i = 0; i < HALVINGS && lattice.points(least, place).size() < count; ++i) {
		most = least;
		least /= 2;
	}
	const auto off = [&](std::size_t found) { return found > count ? found - count : count - found; };
	for (int i = 0; i < SPACINGS && best.size() != count; ++i) {
		const double middle = (least + most) / 2;
		std::vector<Vec2> found = lattice.points(middle, place);
		(found.size() < count ? most : least) = middle;
		if (off(found.size()) < off(best.size())) {
			best = std::move(found);
		}
	}
	return best;
}

// Moves the points from `first` on to balance the triangles around them: each to the mean of their centers, weighted by
// area. Triangles at the outline, where the lattice does not fit, become less flat.
void relax(std::vector<Vec2> &points, std::size_t hull_count, std::size_t first, const Lattice &lattice, double clearance) {
	for (int pass = 0; pass < RELAXATIONS; ++pass) {
		std::vector<Vec2> sums(points.size());
		std::vector<Real> areas(points.size());
		for (const Triangle &t : triangulate(points, hull_count)) {
			const Real area = Real(signed_double_area(points[t[0]], points[t[1]], points[t[2]]));
			// Relative to the corner, to keep digits far from the origin.
			for (const std::uint32_t corner : t) {
				const Vec2 p = points[corner];
				sums[corner] += ((points[t[0]] - p) + (points[t[1]] - p) + (points[t[2]] - p)) * (area / 3);
				areas[corner] += area;
			}
		}
		for (std::size_t i = first; i < points.size(); ++i) {
			const Vec2 moved = areas[i] > 0 ? points[i] + sums[i] * (1 / areas[i]) : points[i];
			if (lattice.is_clear(moved, clearance)) {
				points[i] = moved;
			}
		}
	}
}

ElasticTriangle elastic_triangle(std::span<const Vec2> points, const Triangle &corners) {
	const Vec2d a = difference(points[corners[1]], points[corners[0]]);
	const Vec2d b = difference(points[corners[2]], points[corners[0]]);
	const double determinant = cross(a, b);
	return { corners, { Vec2{ Real(b.y / determinant), Real(-b.x / determinant) }, Vec2{ Real(-a.y / determinant), Real(a.x / determinant) } },
		Real(determinant / 2) };
}

bool is_flat(std::span<const Vec2> points, const Triangle &t) {
	double longest = 0;
	for (std::size_t k = 0; k < 3; ++k) {
		longest = std::max(longest, double(length_squared(points[t[(k + 1) % 3]] - points[t[k]])));
	}
	return !(signed_double_area(points[t[0]], points[t[1]], points[t[2]]) > 2 * LEAST_AREA * longest);
}

// Of the solid itself. Its modes are found with a point in the middle that carries the inner mass.
std::array<Real, 3> lowest_stiffness(std::span<const Vec2> hull, const Holes &holes) {
	std::vector<Vec2> points(hull.begin(), hull.end());
	points.push_back(area_centroid(hull));
	return reduce_solid(points, hull.size(), false, holes).modes->stiffness[0];
}

// The outline of a hole in edges of about `spacing`, with its area.
std::vector<Vec2> evenly_spaced(const std::vector<Vec2> &hole, double spacing) {
	SimplifyOptions options;
	options.fewest_points = LEAST_HOLE_POINTS;
	options.most_points = std::max(LEAST_HOLE_POINTS, int(std::ceil(double(perimeter(hole)) / spacing)));
	options.least_edge = Real(spacing / 2);
	const auto simplified = simplify_outline(hole, options);
	const std::vector<Vec2> &corners = simplified ? simplified.value().hull : hole;
	std::vector<Vec2> places;
	for (std::size_t i = 0; i < corners.size(); ++i) {
		const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
		const int pieces = std::max(1, int(std::lround(double(length(edge)) / spacing)));
		for (int k = 0; k < pieces; ++k) {
			places.push_back(corners[i] + edge * (Real(k) / Real(pieces)));
		}
	}
	return places;
}

} // namespace

std::vector<Vec2> even_inner_points(std::span<const Vec2> hull, std::span<const Vec2> own_points, std::size_t count, const Holes &holes) {
	if (count == 0 && holes.empty()) {
		return {};
	}
	const Lattice lattice(hull, own_points, holes);
	const double area = holes.empty() ? std::abs(double(signed_area(hull))) : area_moments(hull, holes).area;
	const double spacing = std::sqrt(area / (double(std::max<std::size_t>(count, 1)) * ROW_HEIGHT)); // without clearance
	std::vector<Vec2> best;
	for (const std::array<double, 2> &place : PLACES) {
		std::vector<Vec2> found = nearest_count(lattice, spacing, place, count);
		const auto off = [&](const std::vector<Vec2> &points) { return std::abs(double(points.size()) - double(count)); };
		if (best.empty() || off(found) < off(best)) {
			best = std::move(found);
		}
		if (best.size() == count) {
			break;
		}
	}
	std::vector<Vec2> points(hull.begin(), hull.end());
	points.insert(points.end(), own_points.begin(), own_points.end());
	const std::size_t own = points.size();
	for (const std::vector<Vec2> &hole : holes) {
		const std::vector<Vec2> places = evenly_spaced(hole, spacing);
		points.insert(points.end(), places.begin(), places.end());
	}
	const std::size_t first = points.size();
	points.insert(points.end(), best.begin(), best.end());
	relax(points, hull.size(), first, lattice, spacing * RELAXED_CLEARANCE);
	return { points.begin() + std::ptrdiff_t(own), points.end() };
}

Result<TriangleMesh> make_triangle_mesh(std::span<const Vec2> points, std::size_t hull_count, const Holes &holes) {
	const std::vector<Triangle> fill = triangulate(points, hull_count);
	std::vector<double> shares(points.size(), 0);
	double area = 0;
	auto triangles = std::make_shared<ElasticTriangles>();
	for (const Triangle &corners : fill) {
		const Vec2 middle = (points[corners[0]] + points[corners[1]] + points[corners[2]]) * (Real(1) / 3);
		if (std::ranges::any_of(holes, [&](const std::vector<Vec2> &hole) { return point_in_polygon(middle, hole); })) {
			continue;
		}
		if (is_flat(points, corners)) {
			return Error{ "hull", "points in a row", "must leave triangles of positive area inside the outline",
				"move or remove points that lie almost on a line, or add inner points" };
		}
		triangles->triangles.push_back(elastic_triangle(points, corners));
		for (const std::uint32_t corner : corners) {
			shares[corner] += double(triangles->triangles.back().area) / 3;
		}
		area += double(triangles->triangles.back().area);
	}
	TriangleMesh mesh;
	if (!holes.empty()) {
		const AreaMoments moments = area_moments(points.first(hull_count), holes);
		if (!(std::abs(area - moments.area) < MOST_HOLE_ERROR * moments.area)) {
			return Error{ "holes", "triangles that do not follow them", "must leave walls as wide as the points are apart", "simulate more points, or choose MODES" };
		}
		if (std::ranges::all_of(shares, [](double share) { return share > 0; })) {
			give_moments(points, points.size(), moments, shares);
		}
	}
	for (std::size_t i = 0; i < points.size(); ++i) {
		if (!(shares[i] > 0)) {
			return Error{ "inner_points[" + std::to_string(i - hull_count) + "]", "outside the outline or on another point",
				"must be a corner of triangles", "move the point inside, away from the others" };
		}
		mesh.mass_shares.push_back(Real(shares[i] / area));
	}
	triangles->lowest_stiffness = lowest_stiffness(points.first(hull_count), holes);
	mesh.triangles = std::move(triangles);
	return mesh;
}

} // namespace softbody
