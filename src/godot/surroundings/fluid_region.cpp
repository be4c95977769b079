// SPDX-License-Identifier: MIT
// The part of the plane that a fluid fills: the shapes of an area.
#include "godot/surroundings/fluid_region.h"

#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/classes/shape2d.hpp>
#include <godot_cpp/core/math.hpp>
#include <godot_cpp/variant/array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>

#include <algorithm>

using namespace godot;

namespace softbody {

namespace {

constexpr int ROUND_CORNERS = 32;

// A capsule of half the length `half` between the middles of its ends; a circle for 0.
PackedVector2Array round_corners(double radius, double half) {
	PackedVector2Array corners;
	for (int i = 0; i < ROUND_CORNERS; i++) {
		const auto [sine, cosine] = sine_cosine(Math_TAU * (i + 0.5) / ROUND_CORNERS);
		const Vector2 direction = Vector2(real_t(cosine), real_t(sine));
		corners.push_back(direction * real_t(radius) + Vector2(0, direction.y > 0 ? real_t(half) : -real_t(half)));
	}
	return corners;
}

PackedVector2Array corners_of(PhysicsServer2D::ShapeType type, const Variant &data) {
	switch (type) {
		case PhysicsServer2D::SHAPE_RECTANGLE: {
			const Vector2 half = data;
			PackedVector2Array corners;
			for (const Vector2 &corner : { Vector2(-1, -1), Vector2(1, -1), Vector2(1, 1), Vector2(-1, 1) }) {
				corners.push_back(corner * half);
			}
			return corners;
		}
		case PhysicsServer2D::SHAPE_CIRCLE:
			return round_corners(data, 0);
		case PhysicsServer2D::SHAPE_CAPSULE: {
			// In whichever order: the height includes both caps.
			const Vector2 size = data;
			const real_t radius = MIN(size.x, size.y);
			return round_corners(radius, MAX(real_t(0), MAX(size.x, size.y) / 2 - radius));
		}
		case PhysicsServer2D::SHAPE_CONVEX_POLYGON:
			return data;
		case PhysicsServer2D::SHAPE_WORLD_BOUNDARY: {
			const Array normal_and_distance = data;
			const Vector2 normal = normal_and_distance[0];
			const Vector2 along = normal.orthogonal() * real_t(WATER_REACH);
			const Vector2 top = normal * real_t(double(normal_and_distance[1]));
			const Vector2 down = normal * real_t(-WATER_REACH);
			PackedVector2Array corners;
			for (const Vector2 &corner : { top - along, top + along, top + along + down, top - along + down }) {
				corners.push_back(corner);
			}
			return corners;
		}
		default:
			return {};
	}
}

} // namespace

std::vector<std::vector<Vec2>> read_fluid_region(Area2D &area) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	std::vector<std::vector<Vec2>> region;
	const PackedInt32Array owners = area.get_shape_owners();
	for (const int32_t owner : owners) {
		if (area.is_shape_owner_disabled(uint32_t(owner))) {
			continue;
		}
		const Transform2D frame = area.get_global_transform() * area.shape_owner_get_transform(uint32_t(owner));
		for (int i = 0; i < area.shape_owner_get_shape_count(uint32_t(owner)); i++) {
			const RID shape = area.shape_owner_get_shape(uint32_t(owner), i)->get_rid();
			std::vector<Vec2> corners;
			for (const Vector2 &corner : corners_of(server->shape_get_type(shape), server->shape_get_data(shape))) {
				corners.push_back(to_core(frame.xform(corner)));
			}
			if (corners.size() < 3) {
				continue;
			}
			if (signed_area(corners) < 0) {
				std::ranges::reverse(corners);
			}
			region.push_back(std::move(corners));
		}
	}
	return region;
}

} // namespace softbody
