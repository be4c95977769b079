// SPDX-License-Identifier: MIT
// Divides a hull into convex parts by point index.
#include "godot/surroundings/hull_parts.h"

#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <godot_cpp/classes/geometry2d.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace softbody {

namespace {

// Largest length of a part over its width; longer parts are cut. Long parts bend, and the convex hull of a bent bar
// would fill the inside of the bend.
constexpr Real LONGEST_PART = Real(2.5);

// Wedges of a hull that is one part. More follow a dent more exactly, at proportional cost.
constexpr std::size_t WEDGES = 16;

using Part = std::vector<std::uint32_t>;

// Twice the signed area of a corner, positive where a hull of positive winding is convex.
Real turn(Vec2 a, Vec2 b, Vec2 c) {
	return cross(b - a, c - b);
}

bool is_convex(std::span<const Vec2> outline) {
	const std::size_t count = outline.size();
	for (std::size_t i = 0; i < count; ++i) {
		if (turn(outline[i], outline[(i + 1) % count], outline[(i + 2) % count]) < 0) {
			return false;
		}
	}
	return true;
}

std::vector<Part> divide_convex(std::span<const Vec2> hull) {
	Part whole(hull.size());
	for (std::size_t i = 0; i < hull.size(); ++i) {
		whole[i] = std::uint32_t(i);
	}
	if (is_convex(hull)) {
		return { whole };
	}
	// The engine's decomposition adds no points, so each corner is a hull point.
	std::vector<Part> parts;
	const godot::TypedArray<godot::PackedVector2Array> polygons =
			godot::Geometry2D::get_singleton()->decompose_polygon_in_convex(to_godot(hull));
	for (std::int64_t i = 0; i < polygons.size(); ++i) {
		Part part;
		for (const godot::Vector2 &corner : godot::PackedVector2Array(polygons[i])) {
			const auto found = std::find(hull.begin(), hull.end(), to_core(corner));
			if (found != hull.end()) {
				part.push_back(std::uint32_t(found - hull.begin()));
			}
		}
		if (part.size() > 2) {
			parts.push_back(std::move(part));
		}
	}
	return parts.empty() ? std::vector<Part>{ whole } : parts;
}

// Cuts a long part across its middle, between the two nearest corners on either side.
void cut_long(std::span<const Vec2> hull, Part part, std::vector<Part> &r_parts) {
	const std::size_t count = part.size();
	std::size_t from = 0;
	std::size_t to = 0;
	for (std::size_t i = 0; i < count; ++i) {
		for (std::size_t j = i + 1; j < count; ++j) {
			if (length_squared(hull[part[j]] - hull[part[i]]) > length_squared(hull[part[to]] - hull[part[from]])) {
				from = i;
				to = j;
			}
		}
	}
	const Vec2 axis = hull[part[to]] - hull[part[from]];
	const Real size = length(axis);
	Real least = 0;
	Real most = 0;
	for (const std::uint32_t point : part) {
		const Real across = cross(axis, hull[point] - hull[part[from]]) / size;
		least = std::min(least, across);
		most = std::max(most, across);
	}
	// The corner of the run (first, last) that lies nearest to the middle.
	const auto middle_of = [&](std::size_t first, std::size_t last) {
		std::size_t best = first;
		Real distance = size;
		for (std::size_t i = first + 1; i < last; ++i) {
			const Real off = std::abs(dot(axis, hull[part[i % count]] - hull[part[from]]) / size - size / 2);
			if (off < distance) {
				distance = off;
				best = i;
			}
		}
		return best;
	};
	const std::size_t one = middle_of(from, to);
	const std::size_t other = middle_of(to, from + count);
	const bool is_cut = one != from && other != to && other - one > 1 && one + count - other > 1;
	if (size <= LONGEST_PART * (most - least) || !is_cut) {
		r_parts.push_back(std::move(part));
		return;
	}
	Part halves[2];
	for (std::size_t i = one; i <= other; ++i) {
		halves[0].push_back(part[i % count]);
	}
	for (std::size_t i = other; i <= one + count; ++i) {
		halves[1].push_back(part[i % count]);
	}
	for (Part &half : halves) {
		// A piece as long as the whole would be cut forever.
		if (half.size() < count) {
			cut_long(hull, std::move(half), r_parts);
		} else {
			r_parts.push_back(std::move(half));
		}
	}
}

// The convex hull of `r_workspace`'s points.
void enclose(std::vector<Vec2> &r_workspace, std::vector<Vec2> &r_outline) {
	const std::size_t count = r_workspace.size();
	r_workspace.resize(3 * count);
	const std::span<const Vec2> corners = convex_hull({ r_workspace.data(), count }, { r_workspace.data() + count, 2 * count });
	r_outline.assign(corners.begin(), corners.end());
	r_workspace.resize(count);
	if (r_outline.size() < 3) {
		r_outline.clear();
	}
}

} // namespace

HullParts divide_hull(std::span<const Vec2> rest_hull) {
	HullParts parts;
	for (Part &part : divide_convex(rest_hull)) {
		cut_long(rest_hull, std::move(part), parts.convex);
	}
	const std::size_t stride = (rest_hull.size() + WEDGES - 1) / WEDGES;
	for (std::size_t index = 0; index < parts.convex.size(); ++index) {
		const std::size_t count = parts.convex[index].size();
		for (std::size_t first = 0; first < count; first += stride) {
			const std::size_t edges = std::min(stride, count - first);
			parts.wedges.push_back({ std::uint32_t(index), std::uint32_t(first), std::uint32_t(edges + 1) });
		}
	}
	return parts;
}

Dent gather_part(std::span<const Vec2> hull, const std::vector<std::uint32_t> &part, std::vector<Vec2> &r_workspace,
		std::vector<Vec2> &r_outline) {
	r_workspace.clear();
	for (const std::uint32_t point : part) {
		r_workspace.push_back(hull[point]);
	}
	if (is_convex(r_workspace) && turn(r_workspace[0], r_workspace[1], r_workspace[2]) > 0) {
		r_outline.assign(r_workspace.begin(), r_workspace.end());
		return {};
	}
	enclose(r_workspace, r_outline);
	Dent deepest;
	for (const Vec2 point : r_workspace) {
		Dent dent{ std::numeric_limits<Real>::max(), {} };
		for (std::size_t i = 0; i < r_outline.size(); ++i) {
			const Vec2 from = r_outline[i];
			const Vec2 side = r_outline[(i + 1) % r_outline.size()] - from;
			const Vec2 along = side * (1 / length(side));
			const Real depth = cross(along, point - from);
			if (depth < dent.depth) {
				dent = { depth, point - perpendicular(along) * (depth / 2) };
			}
		}
		if (!r_outline.empty() && dent.depth > deepest.depth) {
			deepest = dent;
		}
	}
	return deepest;
}

void gather_wedge(std::span<const Vec2> hull, const HullParts &parts, const HullParts::Wedge &wedge,
		std::vector<Vec2> &r_workspace, std::vector<Vec2> &r_outline) {
	const Part &part = parts.convex[wedge.part];
	Vec2 middle;
	for (const std::uint32_t point : part) {
		middle += hull[point];
	}
	r_workspace.assign(1, middle * (Real(1) / Real(part.size())));
	for (std::uint32_t i = 0; i < wedge.count; ++i) {
		r_workspace.push_back(hull[part[(wedge.first + i) % part.size()]]);
	}
	enclose(r_workspace, r_outline);
}

} // namespace softbody
