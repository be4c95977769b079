// SPDX-License-Identifier: MIT
// What air and water do to an outline: buoyancy, drag where the fluid runs against it, and viscosity.
#include "core/dynamics/fluid_forces.h"

#include "core/base/value_range.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace softbody {

namespace {

Vec2 mean_of(std::span<const Vec2> values) {
	Vec2 sum;
	for (const Vec2 value : values) {
		sum += value;
	}
	return sum * (1 / Real(values.size()));
}

// Shares of a segment that lie inside a convex region of positive winding: `first` to `last`; none where first >= last.
struct Inside {
	Real first = 0;
	Real last = 1;
};

Inside inside_of(Vec2 from, Vec2 to, std::span<const Vec2> region) {
	Inside inside;
	for (std::size_t i = 0; i < region.size(); ++i) {
		const Vec2 corner = region[i];
		const Vec2 side = region[(i + 1) % region.size()] - corner;
		const Real at_start = cross(side, from - corner); // positive inside
		const Real at_end = cross(side, to - corner);
		if (at_start < 0 && at_end < 0) {
			return { 1, 0 };
		}
		if (at_start < 0) {
			inside.first = std::max(inside.first, at_start / (at_start - at_end));
		} else if (at_end < 0) {
			inside.last = std::min(inside.last, at_start / (at_start - at_end));
		}
	}
	return inside;
}

// Adds a force at a place to points around it: weights are affine in the places of the points, add up to 1, and have that place as
// their mean, so that force and torque are right; of all such weights these are the most even.
void add_at(Vec2 place, Vec2 force, std::span<const Vec2> points, std::span<Vec2> forces) {
	const Vec2 mean = mean_of(points);
	Real xx = 0, xy = 0, yy = 0;
	for (const Vec2 point : points) {
		const Vec2 arm = point - mean;
		xx += arm.x * arm.x;
		xy += arm.x * arm.y;
		yy += arm.y * arm.y;
	}
	const Real determinant = xx * yy - xy * xy;
	Vec2 slope;
	if (determinant > Real(1e-6) * (xx + yy) * (xx + yy)) { // else the points lie on a line, and their mean will do
		const Vec2 arm = place - mean;
		slope = Vec2{ yy * arm.x - xy * arm.y, xx * arm.y - xy * arm.x } * (1 / determinant);
	}
	for (std::size_t i = 0; i < points.size(); ++i) {
		forces[i] += force * (1 / Real(points.size()) + dot(slope, points[i] - mean));
	}
}

void add_drag(const Fluid &fluid, std::span<const Vec2> region, std::span<const Vec2> hull, std::span<const Vec2> velocities, Real side, Real most_rate, std::span<Vec2> forces) {
	const Real pressure = fluid.density * fluid.drag / 2;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const std::size_t next = (i + 1) % hull.size();
		const Vec2 edge = hull[next] - hull[i];
		const Real edge_length = length(edge);
		const Inside inside = inside_of(hull[i], hull[next], region);
		if (!(edge_length > 0) || !(inside.first < inside.last)) {
			continue;
		}
		const Vec2 inward = perpendicular(edge) * (side / edge_length);
		const Real middle = (inside.first + inside.last) / 2;
		const Vec2 velocity = velocities[i] * (1 - middle) + velocities[next] * middle;
		const Real speed = dot(fluid.flow - velocity, inward);
		if (speed <= 0) { // the lee side
			continue;
		}
		const Real push = std::min(pressure * speed * edge_length * (inside.last - inside.first), most_rate) * speed;
		forces[i] += inward * (push * (1 - middle));
		forces[next] += inward * (push * middle);
	}
}

} // namespace

Status check_fluid(const Fluid &fluid) {
	for (const auto &[name, value, range] : { std::tuple{ "density", fluid.density, ValueRange::at_least(0) }, { "drag", fluid.drag, ValueRange::at_least(0) }, { "viscosity", fluid.viscosity, ValueRange::at_least(0, "1/s") }, { "flow.x", fluid.flow.x, ValueRange{} }, { "flow.y", fluid.flow.y, ValueRange{} }, { "gravity.x", fluid.gravity.x, ValueRange{} }, { "gravity.y", fluid.gravity.y, ValueRange{} } }) {
		if (Status status = range.check(name, double(value))) {
			return status;
		}
	}
	return {};
}

std::vector<Vec2> clip_to_convex(std::span<const Vec2> polygon, std::span<const Vec2> region) {
	std::vector<Vec2> left(polygon.begin(), polygon.end());
	std::vector<Vec2> kept;
	for (std::size_t i = 0; i < region.size() && !left.empty(); ++i) {
		const Vec2 corner = region[i];
		const Vec2 side = region[(i + 1) % region.size()] - corner;
		kept.clear();
		Vec2 before = left.back();
		Real before_height = cross(side, before - corner);
		for (const Vec2 point : left) {
			const Real height = cross(side, point - corner); // positive inside
			if ((height < 0) != (before_height < 0)) {
				kept.push_back(before + (point - before) * (before_height / (before_height - height)));
			}
			if (height >= 0) {
				kept.push_back(point);
			}
			before = point;
			before_height = height;
		}
		left.swap(kept);
	}
	return left;
}

void add_fluid_forces(const Fluid &fluid, std::span<const Vec2> region, std::span<const Vec2> hull, std::span<const Vec2> velocities, Real point_mass, Real time_step, std::span<Vec2> forces) {
	// Where the hull will be in the middle of the step. By the places at its start a step would drive what bobs, as its push lags
	// behind: by w² dt / 4 a second at the angular frequency w, more than viscosity takes from flat, light bodies.
	std::vector<Vec2> ahead(hull.begin(), hull.end());
	for (std::size_t i = 0; i < ahead.size(); ++i) {
		ahead[i] += velocities[i] * (time_step / 2);
	}
	const std::vector<Vec2> part = clip_to_convex(ahead, region);
	const Real signed_part = part.size() < 3 ? Real(0) : signed_area(part);
	if (!(std::abs(signed_part) > 0)) {
		return;
	}
	const Real side = signed_area(hull) < 0 ? Real(-1) : Real(1);
	const Real displaced = fluid.density * std::abs(signed_part);
	add_at(area_centroid(part), fluid.gravity * -displaced, ahead, forces);
	const Vec2 difference = fluid.flow - mean_of(velocities);
	const Real whole_mass = point_mass * Real(hull.size());
	const Vec2 pull = difference * (std::min(displaced * fluid.viscosity, whole_mass / time_step) / Real(hull.size()));
	for (Vec2 &force : forces.first(hull.size())) {
		force += pull;
	}
	// Half of each neighbor's mass hangs on an edge.
	add_drag(fluid, region, hull, velocities, side, point_mass / time_step, forces);
}

} // namespace softbody
