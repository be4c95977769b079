// SPDX-License-Identifier: MIT
// Turns an outline and a few material values into the structure of a soft body.
#include "core/creator/soft_body_creator.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace softbody {

namespace {

Status check_options(const StructureOptions &options) {
	if (Status status = check_above("mass", options.mass, 0, "kg")) {
		return status;
	}
	if (Status status = check_at_least("stiffness", options.stiffness, 0, "N/m")) {
		return status;
	}
	return check_at_least("damping", options.damping, 0, "N·s/m");
}

Spring2D spring_between(const std::vector<Vec2> &points, std::size_t a, std::size_t b,
		const StructureOptions &options) {
	return { std::uint32_t(a), std::uint32_t(b), length(points[b] - points[a]), options.stiffness, options.damping };
}

} // namespace

Result<std::shared_ptr<const SoftBodyShape>> SoftBodyCreator::create_circle(Real radius, int point_count,
		const StructureOptions &options) {
	const Result<std::vector<Vec2>> hull = circle_hull(radius, point_count);
	if (!hull) {
		return hull.error();
	}
	return create_polygon(hull.value(), options);
}

Result<std::shared_ptr<const SoftBodyShape>> SoftBodyCreator::create_polygon(std::span<const Vec2> hull,
		const StructureOptions &options) {
	if (Status status = check_options(options)) {
		return *status;
	}
	if (Status status = check_hull(hull)) {
		return *status;
	}
	SoftBodyShape::Description description;
	description.points.assign(hull.begin(), hull.end());
	if (signed_area(hull) < 0) {
		std::reverse(description.points.begin() + 1, description.points.end());
	}
	const std::size_t count = hull.size();
	description.hull_count = count;
	for (std::size_t i = 0; i < count; ++i) {
		description.springs.push_back(spring_between(description.points, i, (i + 1) % count, options));
	}
	if (options.centre_point) {
		double x = 0;
		double y = 0;
		for (const Vec2 p : hull) {
			x += p.x;
			y += p.y;
		}
		description.points.push_back({ Real(x / double(count)), Real(y / double(count)) });
		for (std::size_t i = 0; i < count; ++i) {
			const Spring2D spring = spring_between(description.points, i, count, options);
			if (!(spring.rest_length > 0)) {
				return Error{ "hull[" + std::to_string(i) + "]", "the mean of the hull points",
					"must not coincide with the centre point", "move this point or switch the centre point off" };
			}
			description.springs.push_back(spring);
		}
	}
	description.masses.assign(description.points.size(), options.mass / Real(description.points.size()));
	return SoftBodyShape::create(std::move(description));
}

Real damping_for_ratio(Real ratio, Real stiffness, Real total_mass, std::size_t point_count) {
	return ratio * std::sqrt(stiffness * total_mass / Real(point_count));
}

} // namespace softbody
