// SPDX-License-Identifier: MIT
// Carries the outlines of a body's holes along with its hull.
#include "core/skin/hole_binding.h"

#include "core/base/elementary.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace softbody {

namespace {

Vec2 mean_of(std::span<const Vec2> points) {
	Vec2 sum;
	for (const Vec2 p : points) {
		sum += p;
	}
	return sum * (1 / Real(points.size()));
}

// Stretch of a hole in one direction, limited from below: s for s >= f = FREELY_CLOSED_HOLE, f² / (2 f - s) below, which has the same value and
// slope at f and stays positive.
double limited(double stretch) {
	constexpr double F = double(FREELY_CLOSED_HOLE);
	return stretch >= F ? stretch : F * F / (2 * F - stretch);
}

// Lets a hole whose points rest at `rest` and lie at `points` close no farther than it may. Of the affine map that fits the points best, the
// symmetric part's stretches are limited; the points are moved by the difference. The frame has turned with the hull already.
void keep_open(std::span<const Vec2> rest, std::span<Vec2> points) {
	const Vec2 rest_mean = mean_of(rest);
	const Vec2 mean = mean_of(points);
	double xx = 0, xy = 0, yy = 0; // sum of X X^T
	double a = 0, b = 0, c = 0, d = 0; // sum of x X^T
	for (std::size_t i = 0; i < rest.size(); ++i) {
		const Vec2d at_rest = difference(rest[i], rest_mean);
		const Vec2d now = difference(points[i], mean);
		xx += at_rest.x * at_rest.x;
		xy += at_rest.x * at_rest.y;
		yy += at_rest.y * at_rest.y;
		a += now.x * at_rest.x;
		b += now.x * at_rest.y;
		c += now.y * at_rest.x;
		d += now.y * at_rest.y;
	}
	const double determinant = xx * yy - xy * xy; // > 0 for a hole of an area
	const std::array<double, 4> map{ (a * yy - b * xy) / determinant, (b * xx - a * xy) / determinant, (c * yy - d * xy) / determinant, (d * xx - c * xy) / determinant };
	// The map z -> (e + i f) z + (g + i h) conj z, of which i f is the antisymmetric part; stretches are e ± |g + i h|.
	const double e = (map[0] + map[3]) / 2;
	const double g = (map[0] - map[3]) / 2;
	const double h = (map[2] + map[1]) / 2;
	const double shear = hypotenuse(g, h);
	if (e - shear >= double(FREELY_CLOSED_HOLE)) {
		return;
	}
	const double small = limited(e - shear);
	const double large = limited(e + shear);
	const double more = (large + small) / 2 - e;
	const double factor = shear > 0 ? (large - small) / (2 * shear) - 1 : 0.0;
	const std::array<double, 4> change{ more + factor * g, factor * h, factor * h, more - factor * g };
	for (std::size_t i = 0; i < rest.size(); ++i) {
		const Vec2d at_rest = difference(rest[i], rest_mean);
		points[i] += Vec2{ Real(change[0] * at_rest.x + change[1] * at_rest.y), Real(change[2] * at_rest.x + change[3] * at_rest.y) };
	}
}

} // namespace

HoleBinding::HoleBinding(const Holes &holes, std::span<const Vec2> hull, std::vector<std::array<Real, 4>> weights) :
		hull_(hull.begin(), hull.end()), weights_(std::move(weights)) {
	const Vec2 mean = mean_of(hull);
	for (Vec2 &p : hull_) {
		p -= mean;
	}
	for (const std::vector<Vec2> &hole : holes) {
		counts_.push_back(hole.size());
		for (const Vec2 p : hole) {
			rest_.push_back(p - mean);
		}
	}
	assert(hull.size() >= 3 && weights_.size() == hull_.size() * rest_.size());
	const std::array<Real, 4> *weight = weights_.data();
	for (const std::size_t hole : counts_) {
		std::vector<Real> shares(hull_.size(), 0);
		Real sum = 0;
		for (std::size_t k = 0; k < hole; ++k) {
			for (Real &share : shares) {
				for (const Real entry : *weight) {
					share += std::abs(entry);
					sum += std::abs(entry);
				}
				++weight;
			}
		}
		for (const Real share : shares) {
			shares_.push_back(share / sum);
		}
	}
}

HoleBinding::Frame HoleBinding::frame_of(std::size_t hole, std::span<const Vec2> hull) const {
	const std::size_t count = hull_.size();
	const std::span<const Real> shares = std::span(shares_).subspan(hole * count, count);
	Frame frame;
	for (std::size_t i = 0; i < count; ++i) {
		frame.rest += hull_[i] * shares[i];
		frame.now += hull[i] * shares[i];
	}
	double cosine = 0;
	double sine = 0;
	for (std::size_t i = 0; i < count; ++i) {
		const Vec2d before = difference(hull_[i], frame.rest);
		const Vec2d now = difference(hull[i], frame.now);
		cosine += double(shares[i]) * dot(before, now);
		sine += double(shares[i]) * cross(before, now);
	}
	const double size = hypotenuse(cosine, sine);
	if (size > 0) {
		frame.turn = { Real(cosine / size), Real(sine / size) };
	}
	return frame;
}

void HoleBinding::place(std::span<const Vec2> hull, std::span<Vec2> points) const {
	assert(hull.size() >= hull_.size() && points.size() >= rest_.size());
	const std::size_t count = hull_.size();
	std::size_t start = 0;
	for (std::size_t hole = 0; hole < counts_.size(); ++hole) {
		const Frame frame = frame_of(hole, hull);
		const auto turned = [&](Vec2 p) { return Vec2{ frame.turn.x * p.x - frame.turn.y * p.y, frame.turn.y * p.x + frame.turn.x * p.y }; };
		const auto turned_back = [&](Vec2 p) { return Vec2{ frame.turn.x * p.x + frame.turn.y * p.y, frame.turn.x * p.y - frame.turn.y * p.x }; };
		const std::span<const Vec2> rest = std::span(rest_).subspan(start, counts_[hole]);
		const std::span<Vec2> places = points.subspan(start, counts_[hole]);
		std::ranges::copy(rest, places.begin());
		for (std::size_t i = 0; i < count; ++i) {
			const Vec2 moved = turned_back(hull[i] - frame.now) - (hull_[i] - frame.rest);
			const std::array<Real, 4> *weight = &weights_[start * count + i];
			for (std::size_t k = 0; k < places.size(); ++k) {
				const auto [xx, xy, yx, yy] = weight[k * count];
				places[k] += Vec2{ xx * moved.x + xy * moved.y, yx * moved.x + yy * moved.y };
			}
		}
		keep_open(rest, places);
		for (Vec2 &p : places) {
			p = frame.now + turned(p - frame.rest);
		}
		start += counts_[hole];
	}
}

} // namespace softbody
