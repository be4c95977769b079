// SPDX-License-Identifier: MIT
// Turns a path and its widths into the structure of an open chain.
#include "core/creator/rope_creator.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace softbody {

namespace {

// Share of a section's mass at its center. Contacts and other bodies meet the hull points. A light center keeps them nearly as
// heavy as the section, which is what an impulse on it feels.
constexpr double CENTER_SHARE = 0.1;

Status check_path(std::span<const Vec2> path) {
	if (path.size() < 2 || path.size() > std::size_t(MAX_ROPE_POINTS)) {
		return Error{ "path", std::to_string(path.size()) + " points", "must have between 2 and " + std::to_string(MAX_ROPE_POINTS) + " points",
			path.size() < 2 ? "add points" : "remove points" };
	}
	return check_all_finite("path", path);
}

Vec2 unit(Vec2 v) {
	const Real size = length(v);
	return size > 0 ? v * (1 / size) : Vec2{};
}

} // namespace

Result<std::vector<Vec2>> divide_path(std::span<const Vec2> path, int count) {
	if (Status status = first_error({ check_path(path), check_between("point_count", count, 2, MAX_ROPE_POINTS, "") })) {
		return *status;
	}
	std::vector<double> along(path.size(), 0);
	for (std::size_t i = 1; i < path.size(); ++i) {
		along[i] = along[i - 1] + length(difference(path[i], path[i - 1]));
	}
	if (!(along.back() > 0)) {
		return Error{ "path", "no length", "must have a length", "move its points apart" };
	}
	std::vector<Vec2> points;
	std::size_t edge = 0;
	for (int i = 0; i < count; ++i) {
		const double wanted = along.back() * i / (count - 1);
		while (edge + 2 < path.size() && along[edge + 1] < wanted) {
			++edge;
		}
		const double size = along[edge + 1] - along[edge];
		const double t = size > 0 ? std::clamp((wanted - along[edge]) / size, 0.0, 1.0) : 0.0;
		const Vec2d way = difference(path[edge + 1], path[edge]);
		points.push_back(i + 1 == count ? path.back() : path[edge] + Vec2(way * t));
	}
	return points;
}

Status check_rope(std::span<const Vec2> path, std::span<const Real> widths) {
	if (Status status = check_path(path)) {
		return status;
	}
	for (std::size_t i = 1; i < path.size(); ++i) {
		if (!(length(path[i] - path[i - 1]) > 0)) {
			return Error{ "path", "points " + std::to_string(i - 1) + " and " + std::to_string(i) + " coincide", "must have distinct neighboring points",
				"move or remove one of the two points" };
		}
	}
	if (widths.size() != path.size()) {
		return Error{ "widths", std::to_string(widths.size()) + " entries", "must have " + std::to_string(path.size()) + " entries", "give one width a point" };
	}
	for (std::size_t i = 0; i < widths.size(); ++i) {
		if (Status status = check_above("widths[" + std::to_string(i) + "]", widths[i], 0, "")) {
			return status;
		}
	}
	return {};
}

Result<std::vector<Vec2>> rope_outline(std::span<const Vec2> path, std::span<const Real> widths) {
	if (Status status = check_rope(path, widths)) {
		return *status;
	}
	const std::size_t n = path.size();
	std::vector<Vec2> outline(2 * n);
	for (std::size_t i = 0; i < n; ++i) {
		// The bisector of both links, which does not depend on their lengths.
		const Vec2 before = i > 0 ? unit(path[i] - path[i - 1]) : unit(path[1] - path[0]);
		const Vec2 after = i + 1 < n ? unit(path[i + 1] - path[i]) : before;
		Vec2 along = unit(before + after);
		if (along == Vec2{}) {
			along = before;
		}
		const Vec2 side = perpendicular(along) * (widths[i] / 2);
		outline[i] = path[i] - side;
		outline[2 * n - 1 - i] = path[i] + side;
	}
	if (Status status = check_hull(outline)) {
		return Error{ "path", status->value + " of the outline", "must not bend back more sharply than its width, or cross itself",
			"lay it wider, or make the rope thinner" };
	}
	return outline;
}

Result<std::shared_ptr<const SoftBodyShape>> create_rope_in(std::span<const Vec2> hull, std::span<const Vec2> centers, Real mass) {
	const std::size_t n = centers.size();
	if (Status status = first_error({ check_path(centers), check_above("mass", mass, 0, "kg") })) {
		return *status;
	}
	if (hull.size() != 2 * n) {
		return Error{ "hull", std::to_string(hull.size()) + " points", "must have " + std::to_string(2 * n) + " points", "give two for each point of the path" };
	}
	if (Status status = check_hull(hull)) {
		return *status;
	}
	SoftBodyShape::Description description;
	description.points.assign(hull.begin(), hull.end());
	const bool is_reversed = signed_area(hull) < 0;
	if (is_reversed) {
		std::reverse(description.points.begin() + 1, description.points.end());
	}
	description.points.insert(description.points.end(), centers.begin(), centers.end());
	description.hull_count = 2 * n;
	const auto index = [&](std::size_t i) { return std::uint32_t(is_reversed ? (2 * n - i) % (2 * n) : i); };
	for (std::size_t i = 0; i < n; ++i) {
		description.chain.push_back({ index(i), index(2 * n - 1 - i), std::uint32_t(2 * n + i) });
	}
	// Half of each link belongs to either of its sections.
	std::vector<double> areas(n, 0);
	double sum = 0;
	for (std::size_t i = 0; i + 1 < n; ++i) {
		const double size = length(difference(centers[i + 1], centers[i]));
		const double width = length(difference(hull[i], hull[2 * n - 1 - i]));
		const double next = length(difference(hull[i + 1], hull[2 * n - 2 - i]));
		areas[i] += size * (3 * width + next) / 8;
		areas[i + 1] += size * (width + 3 * next) / 8;
		sum += size * (width + next) / 2;
	}
	description.masses.resize(3 * n);
	for (std::size_t i = 0; i < n; ++i) {
		const double share = sum > 0 ? double(mass) * areas[i] / sum : 0;
		const auto [left, right, center] = description.chain[i];
		description.masses[left] = description.masses[right] = Real(share * (1 - CENTER_SHARE) / 2);
		description.masses[center] = Real(share * CENTER_SHARE);
	}
	return SoftBodyShape::create(std::move(description));
}

Result<std::shared_ptr<const SoftBodyShape>> create_rope(std::span<const Vec2> path, std::span<const Real> widths, Real mass) {
	auto outline = rope_outline(path, widths);
	if (!outline) {
		return outline.error();
	}
	return create_rope_in(outline.value(), path, mass);
}

} // namespace softbody
