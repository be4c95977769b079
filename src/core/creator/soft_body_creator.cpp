// SPDX-License-Identifier: MIT
// Turns an outline and a few material values into the structure of a soft body.
#include "core/creator/soft_body_creator.h"

#include "core/creator/balanced_masses.h"
#include "core/creator/elastic_modes.h"
#include "core/creator/triangle_mesh.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace softbody {

namespace {

// Factors on the values of each spring.
struct SpringScales {
	const char *name;
	std::vector<Real> StructureOptions::*values;
	bool may_be_zero;
};
constexpr SpringScales ALL_SCALES[] = {
	{ "spring_stiffness_scales", &StructureOptions::spring_stiffness_scales, true },
	{ "spring_damping_scales", &StructureOptions::spring_damping_scales, true },
	{ "spring_length_scales", &StructureOptions::spring_length_scales, false },
};

Status check_options(const StructureOptions &options) {
	if (options.elastic && options.elastic_triangles) {
		return Error{ "elastic_triangles", "beside elastic modes", "must be the only elastic model", "switch one of the two off" };
	}
	return first_error({ check_above("mass", options.mass, 0, "kg"), check_at_least("stiffness", options.stiffness, 0, "N/m"),
			check_between("triangle_points", options.triangle_points, 0, MAX_HULL_POINTS, ""),
			check_at_least("damping", options.damping, 0, "N·s/m") });
}

Status check_scales(const StructureOptions &options, std::size_t spring_count) {
	for (const auto &[name, values, may_be_zero] : ALL_SCALES) {
		const std::vector<Real> &scales = options.*values;
		if (!scales.empty() && scales.size() != spring_count) {
			return Error{ name, std::to_string(scales.size()) + " entries",
				"must have " + std::to_string(spring_count) + " entries, one a spring",
				"add or remove entries, or leave it empty" };
		}
		for (std::size_t i = 0; i < scales.size(); ++i) {
			const std::string entry = std::string(name) + "[" + std::to_string(i) + "]";
			if (Status status = may_be_zero ? check_at_least(entry, scales[i], 0, "") : check_above(entry, scales[i], 0, "")) {
				return status;
			}
		}
	}
	return {};
}

Real scale_of(std::span<const Real> scales, std::size_t spring) {
	return scales.empty() ? 1 : scales[spring];
}

Status check_inner_points(const std::vector<Vec2> &points) {
	if (points.size() > std::size_t(MAX_HULL_POINTS)) {
		return Error{ "inner_points", std::to_string(points.size()) + " points",
			"must be at most " + std::to_string(MAX_HULL_POINTS), "remove points" };
	}
	return check_all_finite("inner_points", points);
}

Vec2 mean_of(std::span<const Vec2> points) {
	double x = 0;
	double y = 0;
	for (const Vec2 p : points) {
		x += p.x;
		y += p.y;
	}
	return { Real(x / double(points.size())), Real(y / double(points.size())) };
}

// The springs' ends are given, or chosen from the points as given; the shape's order may differ.
Status check_spring_ends(std::span<const SpringEnds> springs, std::span<const Vec2> points) {
	for (std::size_t i = 0; i < springs.size(); ++i) {
		const auto [a, b] = springs[i];
		const std::string ends = "points " + std::to_string(a) + " and " + std::to_string(b);
		if (a >= points.size() || b >= points.size()) {
			return Error{ "springs[" + std::to_string(i) + "]", ends,
				"must name points below " + std::to_string(points.size()), "use indices of existing points" };
		}
		if (a != b && !(length(points[a] - points[b]) > 0)) {
			return Error{ "springs[" + std::to_string(i) + "]", ends, "must lie apart", "move or remove one of the points" };
		}
	}
	return {};
}

} // namespace

Result<std::shared_ptr<const SoftBodyShape>> SoftBodyCreator::create_polygon(std::span<const Vec2> hull,
		const StructureOptions &options) {
	if (Status status = first_error({ check_options(options), check_hull(hull), check_inner_points(options.inner_points) })) {
		return *status;
	}
	if (Status status = check_holes("holes", options.holes, hull)) {
		return *status;
	}
	const std::size_t count = hull.size();
	std::vector<Vec2> inner_points = options.inner_points;
	if (options.elastic_triangles) {
		const std::vector<Vec2> even = even_inner_points(hull, options.inner_points, std::size_t(options.triangle_points), options.holes);
		inner_points.insert(inner_points.end(), even.begin(), even.end());
	}
	std::vector<Vec2> points(hull.begin(), hull.end());
	points.insert(points.end(), inner_points.begin(), inner_points.end());
	std::optional<Vec2> center;
	if (options.center_point && !options.elastic_triangles) {
		center = mean_of(hull);
		points.push_back(*center);
		const auto same = std::ranges::find(hull, *center);
		if (options.springs.empty() && same != hull.end()) {
			return Error{ "hull[" + std::to_string(same - hull.begin()) + "]", "the mean of the hull points",
				"must not coincide with the center point", "move this point or switch the center point off" };
		}
	}
	const std::vector<SpringEnds> springs =
			options.springs.empty() ? automatic_springs(hull, inner_points, center) : options.springs;
	if (Status status = first_error({ check_spring_ends(springs, points), check_scales(options, springs.size()) })) {
		return *status;
	}

	const bool is_reversed = signed_area(hull) < 0;
	const auto place = [&](std::uint32_t point) {
		return is_reversed && point < count ? std::uint32_t((count - point) % count) : point;
	};
	SoftBodyShape::Description description;
	description.hull_count = count;
	for (std::size_t i = 0; i < springs.size(); ++i) {
		const auto [a, b] = springs[i];
		description.springs.push_back({ place(a), place(b),
				length(points[b] - points[a]) * scale_of(options.spring_length_scales, i),
				options.stiffness * scale_of(options.spring_stiffness_scales, i),
				options.damping * scale_of(options.spring_damping_scales, i) });
	}
	if (is_reversed) {
		std::reverse(points.begin() + 1, points.begin() + std::ptrdiff_t(count));
	}
	description.masses.assign(points.size(), options.mass / Real(points.size()));
	if (options.balanced_mass || !options.holes.empty()) {
		std::vector<double> masses(description.masses.begin(), description.masses.end());
		if (options.holes.empty()) {
			balance_masses(points, Vec2d(area_centroid(std::span(points).first(count))), masses);
		} else {
			give_moments(points, count, area_moments(std::span(points).first(count), options.holes), masses);
		}
		std::ranges::transform(masses, description.masses.begin(), [](double mass) { return Real(mass); });
	}
	description.points = std::move(points);
	if (!options.elastic && !options.elastic_triangles) {
		return SoftBodyShape::create(std::move(description));
	}
	// Sizes and masses out of range are refused before a solid is made of them. Its points lie around the origin, where
	// coordinates have most digits.
	const auto plain = SoftBodyShape::create(description);
	if (!plain) {
		return plain.error();
	}
	std::vector<Real> mass_shares;
	Holes holes = options.holes;
	for (std::vector<Vec2> &hole : holes) {
		for (Vec2 &p : hole) {
			p -= plain.value()->origin_offset();
		}
	}
	if (options.elastic_triangles) {
		Result<TriangleMesh> mesh = make_triangle_mesh(plain.value()->rest_positions(), count, holes);
		if (!mesh) {
			return mesh.error();
		}
		mass_shares = std::move(mesh.value().mass_shares);
		description.triangles = std::move(mesh.value().triangles);
	} else {
		ElasticReduction reduction = reduce_solid(plain.value()->rest_positions(), count, options.balanced_mass, holes);
		mass_shares = std::move(reduction.mass_shares);
		description.modes = std::move(reduction.modes);
	}
	std::ranges::transform(mass_shares, description.masses.begin(), [&](Real share) { return options.mass * share; });
	return SoftBodyShape::create(std::move(description));
}

Status check_spring_pairs(const std::string &name, std::span<const std::int32_t> indices) {
	if (indices.size() % 2 != 0) {
		return Error{ name, std::to_string(indices.size()) + " entries", "must be pairs of point indices", "add or remove an entry" };
	}
	std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
	for (std::size_t i = 0; i < indices.size(); i += 2) {
		const auto [a, b] = std::minmax(indices[i], indices[i + 1]);
		if (a < 0 || a == b) {
			return Error{ name + "[" + std::to_string(i / 2) + "]", "points " + std::to_string(indices[i]) + " and " + std::to_string(indices[i + 1]),
				"must be two different indices >= 0", "choose other points" };
		}
		pairs.push_back({ a, b });
	}
	std::ranges::sort(pairs);
	const auto twice = std::ranges::adjacent_find(pairs);
	if (twice != pairs.end()) {
		return Error{ name, "points " + std::to_string(twice->first) + " and " + std::to_string(twice->second) + " twice",
			"must join each two points once", "remove one of the two springs" };
	}
	return {};
}

bool leave_out(StructureOptions &options, const std::string &refused) {
	for (const SpringScales &scales : ALL_SCALES) {
		if (refused.starts_with(scales.name)) {
			return !std::exchange(options.*scales.values, {}).empty();
		}
	}
	if (!refused.starts_with("springs") || refused.ends_with("stiffness") || refused.ends_with("damping")) {
		return false;
	}
	for (const SpringScales &scales : ALL_SCALES) {
		(options.*scales.values).clear(); // factors belong to these springs
	}
	return !std::exchange(options.springs, {}).empty();
}

} // namespace softbody
