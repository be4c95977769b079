// SPDX-License-Identifier: MIT
// Outlines to start from: circle, box, capsule.
#include "core/creator/hulls.h"

#include "core/base/constants.h"
#include "core/base/elementary.h"
#include "core/geometry/polygon.h"

#include <cmath>
#include <numbers>
#include <string>

namespace softbody {

namespace {

Status check_count(double count) {
	return check_between("point_count", count, MIN_HULL_POINTS, MAX_HULL_POINTS, "");
}

// Appends the points of the straight piece from a to b, without b.
void append_line(std::vector<Vec2> &hull, Vec2 a, Vec2 b, int pieces) {
	for (int i = 0; i < pieces; ++i) {
		hull.push_back(a + (b - a) * (Real(i) / Real(pieces)));
	}
}

// Point on the unit circle. A coordinate of 1e-16 (pi is rounded) becomes 0, as people read hulls in an inspector.
Vec2 on_circle(double angle) {
	const auto [y, x] = sine_cosine(angle);
	return { std::abs(x) < 1e-12 ? Real(0) : Real(x), std::abs(y) < 1e-12 ? Real(0) : Real(y) };
}

void append_arc(std::vector<Vec2> &hull, Vec2 center, Real radius, double from, int pieces) {
	for (int i = 0; i < pieces; ++i) {
		const double angle = from + std::numbers::pi * i / pieces;
		hull.push_back(center + on_circle(angle) * radius);
	}
}

double pieces_of(double size, double spacing) {
	return std::fmax(1, std::ceil(size / spacing - 1e-6)); // 1e-6: an exact division must not gain a piece by rounding
}

} // namespace

Result<std::vector<Vec2>> circle_hull(Real radius, int point_count) {
	if (Status status = first_error({ check_above("radius", radius, 0, ""), check_count(point_count) })) {
		return *status;
	}
	std::vector<Vec2> hull;
	hull.reserve(std::size_t(point_count));
	for (int i = 0; i < point_count; ++i) {
		const double angle = 2 * std::numbers::pi * i / point_count;
		hull.push_back(on_circle(angle) * radius);
	}
	return hull;
}

Result<std::vector<Vec2>> box_hull(Vec2 size, Real spacing) {
	const double across = pieces_of(size.x, spacing);
	const double down = pieces_of(size.y, spacing);
	if (Status status = first_error({ check_above("size.x", size.x, 0, ""), check_above("size.y", size.y, 0, ""),
				check_above("spacing", spacing, 0, ""), check_count(2 * (across + down)) })) {
		return *status;
	}
	const Vec2 h = size * Real(0.5);
	std::vector<Vec2> hull;
	append_line(hull, { -h.x, -h.y }, { h.x, -h.y }, int(across));
	append_line(hull, { h.x, -h.y }, { h.x, h.y }, int(down));
	append_line(hull, { h.x, h.y }, { -h.x, h.y }, int(across));
	append_line(hull, { -h.x, h.y }, { -h.x, -h.y }, int(down));
	return hull;
}

Result<std::vector<Vec2>> capsule_hull(Real radius, Real height, Real spacing) {
	const double arc = std::fmax(2, pieces_of(std::numbers::pi * radius, spacing));
	const double side = pieces_of(height - 2 * radius, spacing);
	if (Status status = first_error({ check_above("radius", radius, 0, ""), check_above("height", height, 2 * double(radius), "(twice the radius)"),
				check_above("spacing", spacing, 0, ""), check_count(2 * (arc + side)) })) {
		return *status;
	}
	const Real straight = height / 2 - radius;
	std::vector<Vec2> hull;
	append_arc(hull, { 0, straight }, radius, 0, int(arc));
	append_line(hull, { -radius, straight }, { -radius, -straight }, int(side));
	append_arc(hull, { 0, -straight }, radius, std::numbers::pi, int(arc));
	append_line(hull, { radius, -straight }, { radius, straight }, int(side));
	return hull;
}

bool has_deep_dents(std::span<const Vec2> outline) {
	std::vector<Vec2> workspace(2 * outline.size());
	const double around = std::abs(double(signed_area(convex_hull(outline, workspace))));
	return std::abs(double(signed_area(outline))) < double(LEAST_SOLIDITY) * around;
}

} // namespace softbody
