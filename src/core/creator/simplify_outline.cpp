// SPDX-License-Identifier: MIT
// Finds the few hull points that stand for an outline of many.
#include "core/creator/simplify_outline.h"

#include "core/base/constants.h"
#include "core/creator/outline_collapse.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace softbody {

namespace {

// Pieces of the tolerance into which long edges of the outline are divided, so that a hull point can stand for any place.
constexpr double PIECES_OF_TOLERANCE = 2;
// The hull's last shift may take it out of the tolerance. Then all is done again for this part of it.
constexpr double NEXT_TRY = 0.93;
constexpr int MOST_TRIES = 12;
// Longest edge of a hull of a given number of points, in mean edges, where that is more than LONGEST_SIMPLE_EDGE.
constexpr double SLACK_OF_FEW = 4;

double distance_between(Vec2d a, Vec2d b) {
	return std::sqrt(dot(b - a, b - a));
}

struct Moments {
	double area = 0;
	Vec2d centroid;
};

// About the first point, so that a polygon far from the origin loses no digits.
Moments moments_of(std::span<const Vec2d> polygon) {
	const Vec2d origin = polygon[0];
	double twice_area = 0;
	Vec2d sum;
	for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
		const Vec2d a = polygon[i] - origin;
		const Vec2d b = polygon[i + 1] - origin;
		const double part = cross(a, b);
		twice_area += part;
		sum += (a + b) * part;
	}
	return { twice_area / 2, origin + sum * (1 / (3 * twice_area)) };
}

double perimeter_of(std::span<const Vec2d> polygon) {
	double sum = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		sum += distance_between(polygon[i], polygon[(i + 1) % polygon.size()]);
	}
	return sum;
}

SimplifiedOutline as_drawn(std::span<const Vec2> outline) {
	SimplifiedOutline same;
	same.hull.assign(outline.begin(), outline.end());
	for (std::size_t i = 0; i < outline.size(); ++i) {
		same.places.push_back(double(i));
	}
	same.is_outline = true;
	return same;
}

// The place with the least value first.
void start_at_least_place(std::vector<Vec2d> &r_hull, std::vector<double> &r_places) {
	const auto least = std::ranges::min_element(r_places) - r_places.begin();
	std::rotate(r_places.begin(), r_places.begin() + least, r_places.end());
	std::rotate(r_hull.begin(), r_hull.begin() + least, r_hull.end());
}

} // namespace

Status check_detail_weights(const std::string &name, std::span<const float> weights) {
	for (std::size_t i = 0; i < weights.size(); ++i) {
		if (Status status = check_between(name + "[" + std::to_string(i) + "]", double(weights[i]), LEAST_DETAIL_WEIGHT, MOST_DETAIL_WEIGHT, "")) {
			return status;
		}
	}
	return {};
}

Status check_simplify_options(const SimplifyOptions &options) {
	if (Status status = check_detail_weights("weights", options.weights)) {
		return status;
	}
	return first_error({ check_between("tolerance", options.tolerance, LEAST_DETAIL_TOLERANCE, MOST_DETAIL_TOLERANCE, ""),
			check_between("fewest_points", options.fewest_points, MIN_HULL_POINTS, MAX_HULL_POINTS, ""),
			options.most_points == 0 ? Status() : check_between("most_points", options.most_points, MIN_HULL_POINTS, MAX_HULL_POINTS, ""),
			check_at_least("least_edge", double(options.least_edge), 0, "") });
}

double radius_of_area(std::span<const Vec2> outline) {
	constexpr double PI = 3.14159265358979323846;
	return std::sqrt(std::abs(double(signed_area(outline))) / PI);
}

Result<SimplifiedOutline> simplify_outline(std::span<const Vec2> outline, const SimplifyOptions &options) {
	if (Status status = check_simplify_options(options)) {
		return *status;
	}
	if (!options.weights.empty() && options.weights.size() != outline.size()) {
		return Error{ "weights", std::to_string(options.weights.size()) + " entries", "must have " + std::to_string(outline.size()) + " entries, one a point", "add or remove entries, or leave it empty" };
	}
	const bool is_counted = options.most_points > 0;
	const std::size_t enough = std::size_t(is_counted ? options.most_points : options.fewest_points);
	if (outline.size() <= enough) {
		return as_drawn(outline);
	}
	const std::vector<Vec2d> fine = [&] {
		std::vector<Vec2d> points;
		for (const Vec2 p : outline) {
			points.push_back(Vec2d(p));
		}
		return points;
	}();
	const Moments whole = moments_of(fine);
	const double radius = radius_of_area(outline);
	// A given number of points takes the tolerance that it needs.
	const double usual = options.tolerance * radius;
	const double longest = std::max(LONGEST_SIMPLE_EDGE, is_counted ? SLACK_OF_FEW / double(enough) : 0.0) * perimeter_of(fine);
	double tolerance = usual;
	for (int attempt = 0; attempt < MOST_TRIES; ++attempt) {
		OutlineCollapse collapse(fine, { tolerance, usual / PIECES_OF_TOLERANCE, std::max(double(options.least_edge), usual), longest, enough }, options.weights);
		collapse.run();
		if (is_counted && collapse.count() > enough) {
			tolerance *= 1.5;
			continue;
		}
		if (collapse.count() == outline.size()) {
			return as_drawn(outline);
		}
		SimplifiedOutline made;
		std::vector<Vec2d> hull = collapse.hull();
		made.places = collapse.places();
		const Vec2d shift = whole.centroid - moments_of(hull).centroid;
		const double error = collapse.error_of_shifted(shift);
		start_at_least_place(hull, made.places);
		for (const Vec2d p : hull) {
			made.hull.push_back(Vec2(p + shift));
		}
		made.error = error / radius;
		if ((is_counted || made.error <= options.tolerance) && !check_hull(made.hull)) {
			return made;
		}
		tolerance *= is_counted ? 1.5 : NEXT_TRY;
	}
	return as_drawn(outline);
}

} // namespace softbody
