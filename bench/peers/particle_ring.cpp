// SPDX-License-Identifier: MIT
// Circles in a ring as the hull of a soft body.
#include "peers.h"

#include <cmath>
#include <numbers>

namespace bench {

using softbody::Real;
using softbody::Vec2;

ParticleRing particle_ring(const PileScene &scene) {
	// Neighbors touch when r = (R - r) sin(pi / n).
	const double half_angle_sine = std::sin(std::numbers::pi / scene.hull_points);
	const double particle_radius = scene.radius * half_angle_sine / (1 + half_angle_sine);
	return { particle_radius, scene.radius - particle_radius };
}

std::vector<PeerSettings> with_both_bodies(const PeerSettings &settings) {
	PeerSettings center = settings;
	center.body = RingBody::CENTER;
	center.name = "with center, " + settings.name;
	PeerSettings cross = settings;
	cross.body = RingBody::CROSS;
	cross.name = "4 cross springs, " + settings.name;
	return { center, cross };
}

Hull ParticleRing::outline(const std::vector<Vec2> &centers) const {
	const std::size_t count = centers.size();
	// A circle that touches two neighbors has its center at the tip of an equilateral triangle of side 2 r, so its rim
	// gets this far behind the line over theirs.
	const double dip = (2 - std::sqrt(3.0)) * particle_radius;
	const auto reach = Real(particle_radius - dip / 2);
	Hull hull;
	for (std::size_t i = 0; i < count; ++i) {
		const Vec2 along = centers[(i + 1) % count] - centers[(i + count - 1) % count];
		const Real size = length(along);
		const Vec2 outward = size > 0 ? Vec2{ along.y, -along.x } * (1 / size) : Vec2{};
		hull.push_back(centers[i] + outward * reach);
	}
	return hull;
}

} // namespace bench
