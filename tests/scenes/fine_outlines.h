// SPDX-License-Identifier: MIT
// Outlines of hundreds of points, as artists draw them: for tests and benches of detail.
#pragma once

#include "core/base/elementary.h"
#include "core/base/vec2.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace softbody::testing {

/// Places evenly along a closed outline of corners, rounded by a few passes of corner cutting (Chaikin 1974).
inline std::vector<Vec2> rounded_outline(std::span<const Vec2> corners, int passes, int count) {
	std::vector<Vec2> line(corners.begin(), corners.end());
	for (int pass = 0; pass < passes; ++pass) {
		std::vector<Vec2> cut;
		for (std::size_t i = 0; i < line.size(); ++i) {
			const Vec2 a = line[i];
			const Vec2 b = line[(i + 1) % line.size()];
			cut.push_back(a + (b - a) * Real(0.25));
			cut.push_back(a + (b - a) * Real(0.75));
		}
		line = cut;
	}
	const Real step = perimeter(line) / Real(count);
	std::vector<Vec2> places;
	Real way = 0;
	for (std::size_t i = 0; i < line.size() && places.size() < std::size_t(count); ++i) {
		const Vec2 a = line[i];
		const Vec2 b = line[(i + 1) % line.size()];
		const Real size = length(b - a);
		while (places.size() < std::size_t(count) && Real(places.size()) * step < way + size) {
			places.push_back(a + (b - a) * ((Real(places.size()) * step - way) / size));
		}
		way += size;
	}
	return places;
}

/// A character of a platform game, about 100 wide and 120 high: a round body with two ears, two stubby arms and two feet.
inline std::vector<Vec2> character_outline(int count) {
	const Vec2 corners[] = { { 0, -46 }, { 14, -48 }, { 24, -72 }, { 36, -70 }, { 36, -40 }, { 44, -18 }, { 62, -14 }, { 64, 2 }, { 46, 6 },
		{ 46, 22 }, { 38, 38 }, { 44, 52 }, { 14, 54 }, { 8, 42 }, { -8, 42 }, { -14, 54 }, { -44, 52 }, { -38, 38 }, { -46, 22 },
		{ -46, 6 }, { -64, 2 }, { -62, -14 }, { -44, -18 }, { -36, -40 }, { -36, -70 }, { -24, -72 }, { -14, -48 } };
	return rounded_outline(corners, 3, count);
}

/// A blob of random waves about a point far from the origin, about 100 wide: `count` points, star-shaped about its middle.
inline std::vector<Vec2> random_blob(int count, Random &random) {
	const Vec2 middle = random.vector(500);
	double amplitudes[9];
	double phases[9];
	for (int wave = 2; wave < 9; ++wave) {
		amplitudes[wave] = double(random.real(0, 0.25)) / wave;
		phases[wave] = double(random.real(0, 6.28));
	}
	std::vector<Vec2> points;
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * std::numbers::pi * i / count;
		double radius = 50;
		for (int wave = 2; wave < 9; ++wave) {
			radius += 50 * amplitudes[wave] * sine_cosine(wave * angle + phases[wave]).sine;
		}
		const SineCosine direction = sine_cosine(angle);
		points.push_back(middle + Vec2{ Real(radius * direction.cosine), Real(radius * direction.sine) });
	}
	return points;
}

/// A boundary of roughness: a blob whose points are displaced by a little noise, as a traced picture has.
inline std::vector<Vec2> noisy_blob(int count, Random &random) {
	std::vector<Vec2> points = random_blob(count, random);
	for (Vec2 &p : points) {
		p += random.vector(0.4);
	}
	return points;
}

} // namespace softbody::testing
