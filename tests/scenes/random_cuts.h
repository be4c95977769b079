// SPDX-License-Identifier: MIT
// Random outlines, and ways across them, for tests and benches of cuts.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace softbody::testing {

enum class OutlineKind { ROUND,
	STAR,
	COMB,
	SLENDER,
	NEARLY_FLAT };
inline constexpr int OUTLINE_KIND_COUNT = 5;

/// A simple outline of positive area, about 100 long, of 3 to `most` points.
inline std::vector<Vec2> random_outline(OutlineKind kind, int most, Random &random) {
	for (;;) {
		const int count = random.integer(kind == OutlineKind::COMB ? 8 : 3, most);
		std::vector<Vec2> points;
		if (kind == OutlineKind::COMB) { // teeth up and down
			const int teeth = std::max(1, (count - 2) / 4);
			for (int i = 0; i < teeth; ++i) {
				const Real x = Real(i * 100.0 / teeth);
				const Real width = Real(100.0 / teeth);
				const Real gap = random.real(0.2, 0.8) * width;
				points.push_back({ x, random.real(0, 15) });
				points.push_back({ x + gap / 2, random.real(-5, 5) });
				points.push_back({ x + gap, random.real(50, 60) });
				points.push_back({ x + (gap + width) / 2, random.real(50, 60) });
			}
			points.push_back({ 100, 80 });
			points.push_back({ 0, 80 });
		} else {
			std::vector<double> angles;
			for (int i = 0; i < count; ++i) {
				angles.push_back(kind == OutlineKind::ROUND ? 2 * std::numbers::pi * i / count : double(random.real(0, 2 * std::numbers::pi)));
			}
			std::ranges::sort(angles);
			for (const double angle : angles) {
				const double radius = kind == OutlineKind::ROUND ? 50 : double(random.real(kind == OutlineKind::STAR ? 10 : 40, 60));
				const double height = kind == OutlineKind::SLENDER ? 0.05 : 1;
				points.push_back({ Real(radius * std::cos(angle)), Real(radius * height * std::sin(angle)) });
			}
			if (kind == OutlineKind::NEARLY_FLAT) { // many corners nearly in line, and some nearly in one place
				for (Vec2 &point : points) {
					point.x = Real(std::round(double(point.x) / 20) * 20) + random.real(-0.01, 0.01);
				}
			}
		}
		const Real angle = random.real(0, 6.28);
		for (Vec2 &point : points) {
			point = Rotation::from_angle(angle).apply(point);
		}
		if (!check_hull(points) && signed_area(points) > 1) {
			return points;
		}
	}
}

/// The outline bent and sheared; one that would cross itself is left as it is.
inline std::vector<Vec2> bent_outline(const std::vector<Vec2> &outline, Random &random) {
	const double bend = double(random.real(-0.4, 0.4));
	const double shear = double(random.real(-0.5, 0.5));
	const double stretch = double(random.real(0.7, 1.4));
	std::vector<Vec2> bent;
	for (const Vec2 p : outline) {
		const double turn = bend * p.x / 50;
		const double x = stretch * p.x + shear * p.y;
		bent.push_back({ Real(x * std::cos(turn) - p.y * std::sin(turn)), Real(x * std::sin(turn) + p.y * std::cos(turn)) });
	}
	return check_hull(bent) || !(signed_area(bent) > 1) ? outline : bent;
}

/// A way of 2 to `most` points: through the middle, through corners, along edges, or anywhere.
inline std::vector<Vec2> random_blade(const std::vector<Vec2> &outline, int most, Random &random) {
	const auto corner = [&] { return outline[std::size_t(random.integer(0, int(outline.size()) - 1))]; };
	std::vector<Vec2> blade;
	const int kind = random.integer(0, 5);
	if (kind <= 1) {
		const Vec2 middle = area_centroid(outline) + random.vector(30);
		const Vec2 way = Rotation::from_angle(random.real(0, 6.28)).apply({ 300, 0 });
		return { middle - way, middle + way };
	}
	if (kind == 2) { // through two corners
		const Vec2 a = corner();
		const Vec2 b = corner();
		return { a - (b - a) * 3, b + (b - a) * 3 };
	}
	if (kind == 3) { // along an edge, and on
		const std::size_t i = std::size_t(random.integer(0, int(outline.size()) - 1));
		const Vec2 a = outline[i];
		const Vec2 b = outline[(i + 1) % outline.size()];
		return { a - (b - a) * 4, b + (b - a) * 4 };
	}
	const int count = random.integer(2, most);
	for (int i = 0; i < count; ++i) {
		blade.push_back(random.chance(0.2) ? corner() : random.vector(90));
	}
	return blade;
}

} // namespace softbody::testing
