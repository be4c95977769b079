// SPDX-License-Identifier: MIT
// The thesis's response to a contact.
#include "thesis/separation_force.h"

#include "core/collision/hull_contact.h"
#include "core/geometry/polygon.h"
#include "thesis/polygon_overlap.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace softbody {

namespace {

Vec2 mean_of(std::span<const Vec2> points, Vec2 origin) {
	Vec2 sum;
	for (const Vec2 p : points) {
		sum += p - origin;
	}
	return sum * (1 / Real(points.size()));
}

void push(SoftBodyData &body, const SoftBodyData &other, Vec2 force) {
	HullEdges edges;
	edges.assign(other.hull());
	std::vector<std::uint32_t> loaded;
	for (std::uint32_t i = 0; i < body.hull().size(); ++i) {
		if (edges.contains(body.hull()[i])) {
			loaded.push_back(i);
		}
	}
	if (loaded.empty()) {
		loaded.resize(body.hull().size());
		std::iota(loaded.begin(), loaded.end(), 0u);
	}
	for (const std::uint32_t i : loaded) {
		body.add_external_force(i, force * (1 / Real(loaded.size()))); // finite: never refused
	}
}

} // namespace

Result<std::size_t> add_separation_forces(WorldData &world, Real stiffness) {
	if (Status status = check_at_least("separation_stiffness", stiffness, 0, "N/m²")) {
		return *status;
	}
	const std::span<SoftBodyData> bodies = world.soft_bodies();
	std::size_t pairs = 0;
	for (std::size_t i = 0; i < bodies.size(); ++i) {
		const Aabb box = bounding_box(bodies[i].hull());
		for (std::size_t j = i + 1; j < bodies.size(); ++j) {
			SoftBodyData &a = bodies[i];
			SoftBodyData &b = bodies[j];
			if (!box.overlaps(bounding_box(b.hull()))) {
				continue;
			}
			const Real force = stiffness / world.length_unit() * Real(overlap_area(a.hull(), b.hull()));
			const Vec2 origin = a.hull()[0];
			const Vec2 way = mean_of(a.hull(), origin) - mean_of(b.hull(), origin);
			const Real distance = length(way);
			const Vec2 direction = distance > 0 ? way * (1 / distance) : Vec2{ 1, 0 };
			if (force > 0 && is_finite(direction * force)) {
				push(a, b, direction * force);
				push(b, a, direction * -force);
				++pairs;
			}
		}
	}
	return pairs;
}

} // namespace softbody
