// SPDX-License-Identifier: MIT
// Translates shapes of Godot's physics server for the core.
#include "godot/surroundings/shape_translation.h"

#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/math.hpp>
#include <godot_cpp/variant/array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/rect2.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

// Points of a half circle, where a circle is squeezed by a scale that differs along x and y.
constexpr int ARC_POINTS = 16;

// Depth of a one-way border behind its front [px]. Smaller: a pile presses points through to its back.
constexpr Real ONE_WAY_DEPTH = 1000;

// Largest difference of the scales along x and y at which a circle stays round, over the scale.
constexpr double ROUND_TOLERANCE = 1e-4;

void add_outline(const std::vector<Vector2> &p_points, const Transform2D &p_to_frame, Real p_radius, TranslatedShape &r_shape) {
	Collider collider;
	collider.radius = p_radius;
	for (const Vector2 &point : p_points) {
		const Vec2 vertex = to_core(p_to_frame.xform(point));
		if (collider.vertices.empty() || !(collider.vertices.back() == vertex)) {
			collider.vertices.push_back(vertex);
		}
	}
	if (collider.vertices.size() > 1 && collider.vertices.front() == collider.vertices.back()) {
		collider.vertices.pop_back();
	}
	if (collider.vertices.size() > 2 && signed_area(collider.vertices) < 0) {
		std::reverse(collider.vertices.begin(), collider.vertices.end());
	}
	Status status = check_collider(collider);
	if (status && collider.vertices.size() > 3 && p_radius == 0) {
		collider.concave = true; // the engine takes any outline for a convex polygon
		status = check_collider(collider);
	}
	if (status) {
		ERR_PRINT_ONCE("SoftBody2D ignores a collision shape: " + to_godot(status->message()));
		return;
	}
	r_shape.colliders.push_back(std::move(collider));
}

// Circle and capsule are one shape: a core segment of half length `p_half` along y, rounded.
void add_round(real_t p_radius, real_t p_half, const Transform2D &p_to_frame, TranslatedShape &r_shape) {
	if (is_uniform_scale(p_to_frame, ROUND_TOLERANCE)) {
		std::vector<Vector2> core = { Vector2(0, -p_half) };
		if (p_half > 0) {
			core.push_back(Vector2(0, p_half));
		}
		add_outline(core, p_to_frame, Real(p_radius * p_to_frame.columns[0].length()), r_shape);
		return;
	}
	std::vector<Vector2> outline;
	for (int end = 0; end < 2; end++) {
		for (int i = 0; i <= ARC_POINTS; i++) {
			const auto [sine, cosine] = sine_cosine(Math_PI * (end + double(i) / ARC_POINTS));
			outline.push_back(Vector2(p_radius * cosine, p_radius * sine + (end == 0 ? p_half : -p_half)));
		}
	}
	add_outline(outline, p_to_frame, 0, r_shape);
}

void add_boundary(const Vector2 &p_normal, real_t p_distance, const Transform2D &p_to_frame, TranslatedShape &r_shape) {
	// Under a scale a normal does not transform like a point; two points on the line do.
	const Vector2 on_line = p_to_frame.xform(p_normal * p_distance);
	Vector2 normal = p_to_frame.basis_xform(p_normal.orthogonal()).orthogonal().normalized();
	if (normal.dot(p_to_frame.basis_xform(p_normal)) < 0) {
		normal = -normal;
	}
	const Border border = { { to_core(on_line), to_core(normal) }, {} };
	if (const Status status = check_border(border)) {
		ERR_PRINT_ONCE("SoftBody2D ignores a world boundary: " + to_godot(status->message()));
		return;
	}
	r_shape.border = border.plane;
}

// Where exactly two segments share an end, each knows where the other goes on. Ends are compared as given, so that
// rounding of the transform does not separate them.
void add_segments(const PackedVector2Array &p_ends, const Transform2D &p_to_frame, TranslatedShape &r_shape) {
	using Place = std::pair<real_t, real_t>;
	const auto place_of = [&](int64_t p_end) { return Place(p_ends[p_end].x, p_ends[p_end].y); };
	std::map<Place, std::vector<int64_t>> ends_at;
	for (int64_t i = 0; i + 1 < p_ends.size(); i += 2) {
		if (p_ends[i] != p_ends[i + 1]) {
			ends_at[place_of(i)].push_back(i);
			ends_at[place_of(i + 1)].push_back(i + 1);
		}
	}
	const auto beyond = [&](int64_t p_end) -> std::optional<Vec2> {
		const std::vector<int64_t> &here = ends_at[place_of(p_end)];
		if (here.size() != 2) {
			return {};
		}
		const int64_t other = here[0] == p_end ? here[1] : here[0];
		return to_core(p_to_frame.xform(p_ends[other ^ 1]));
	};
	for (int64_t i = 0; i + 1 < p_ends.size(); i += 2) {
		if (p_ends[i] == p_ends[i + 1]) {
			continue;
		}
		const std::size_t count = r_shape.colliders.size();
		add_outline({ p_ends[i], p_ends[i + 1] }, p_to_frame, 0, r_shape);
		if (r_shape.colliders.size() > count) {
			r_shape.colliders.back().ghost_at_first = beyond(i);
			r_shape.colliders.back().ghost_at_second = beyond(i + 1);
		}
	}
}

} // namespace

void make_border_finite(Vec2 middle, TranslatedShape &r_shape) {
	if (!r_shape.border) {
		return;
	}
	const Vec2 normal = r_shape.border->normal;
	const Vec2 front = middle - normal * signed_distance(*r_shape.border, middle);
	const Vec2 along = perpendicular(normal) * ONE_WAY_REACH;
	const Vec2 depth = normal * ONE_WAY_DEPTH;
	Collider collider;
	collider.vertices = { front - along, front + along, front + along - depth, front - along - depth };
	r_shape.border.reset();
	r_shape.colliders.push_back(std::move(collider));
}

TranslatedShape translate_shape(PhysicsServer2D::ShapeType p_type, const Variant &p_data, const Transform2D &p_to_frame) {
	TranslatedShape shape;
	switch (p_type) {
		case PhysicsServer2D::SHAPE_WORLD_BOUNDARY: {
			const Array values = p_data;
			add_boundary(values[0], values[1], p_to_frame, shape);
		} break;
		case PhysicsServer2D::SHAPE_SEGMENT: {
			const Rect2 ends = p_data; // position and "size" are the two ends
			add_outline({ ends.position, ends.size }, p_to_frame, 0, shape);
		} break;
		case PhysicsServer2D::SHAPE_CIRCLE: {
			add_round(p_data, 0, p_to_frame, shape);
		} break;
		case PhysicsServer2D::SHAPE_CAPSULE: {
			// Godot's own server takes (radius, height) and returns (height, radius). The height includes both caps, so
			// it is never the smaller of the two, whatever the order.
			const Vector2 size = p_data;
			const real_t radius = Math::min(size.x, size.y);
			const real_t height = Math::max(size.x, size.y);
			add_round(radius, Math::max<real_t>(0, height / 2 - radius), p_to_frame, shape);
		} break;
		case PhysicsServer2D::SHAPE_RECTANGLE: {
			const Vector2 half = p_data;
			add_outline({ -half, Vector2(half.x, -half.y), half, Vector2(-half.x, half.y) }, p_to_frame, 0, shape);
		} break;
		case PhysicsServer2D::SHAPE_CONVEX_POLYGON: {
			const PackedVector2Array points = p_data;
			add_outline(std::vector<Vector2>(points.ptr(), points.ptr() + points.size()), p_to_frame, 0, shape);
		} break;
		case PhysicsServer2D::SHAPE_CONCAVE_POLYGON: {
			add_segments(p_data, p_to_frame, shape); // pairs of segment ends
		} break;
		default:
			break;
	}
	return shape;
}

} // namespace softbody
