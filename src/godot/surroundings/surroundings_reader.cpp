// SPDX-License-Identifier: MIT
// Reads the static shapes near soft bodies from Godot's physics server.
#include "godot/surroundings/surroundings_reader.h"

#include "godot/convert.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/math.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/rect2.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace godot;

namespace softbody {

namespace {

// More shapes than this around one body are ignored; the query needs some bound.
constexpr int MAX_SHAPES = 256;

// Points of a half circle where a circle is squeezed by a scale that differs along x and y.
constexpr int ARC_POINTS = 16;

Surface read_surface(const RID &p_body, const Transform2D &p_transform) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	// PhysicsMaterial hands "rough" and "absorbent" to the server as a negative sign.
	const double friction = server->body_get_param(p_body, PhysicsServer2D::BODY_PARAM_FRICTION);
	const double bounce = server->body_get_param(p_body, PhysicsServer2D::BODY_PARAM_BOUNCE);
	Surface surface;
	surface.friction = Real(Math::abs(friction));
	surface.rough = friction < 0;
	surface.restitution = Real(std::clamp(Math::abs(bounce), 0.0, 1.0));
	surface.absorbent = bounce < 0;
	surface.linear_velocity = to_core(Vector2(server->body_get_state(p_body, PhysicsServer2D::BODY_STATE_LINEAR_VELOCITY)));
	surface.angular_velocity = Real(double(server->body_get_state(p_body, PhysicsServer2D::BODY_STATE_ANGULAR_VELOCITY)));
	surface.velocity_origin = to_core(p_transform.get_origin());
	surface.layer = server->body_get_collision_layer(p_body);
	surface.tag = server->body_get_object_instance_id(p_body);
	return surface;
}

void add_outline(std::vector<Vector2> p_points, const Transform2D &p_transform, Real p_radius,
		const Surface &p_surface, WorldData &r_world) {
	ConvexCollider collider;
	collider.radius = p_radius;
	collider.surface = p_surface;
	for (const Vector2 &point : p_points) {
		const Vec2 vertex = to_core(p_transform.xform(point));
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
	if (const Status status = r_world.add_collider(std::move(collider))) {
		ERR_PRINT_ONCE("SoftBody2D ignores a collision shape: " + to_godot(status->message()));
	}
}

bool has_uniform_scale(const Transform2D &p_transform) {
	const real_t along = p_transform.columns[0].length();
	const real_t across = p_transform.columns[1].length();
	const real_t skew = Math::abs(p_transform.columns[0].dot(p_transform.columns[1]));
	return Math::abs(along - across) <= 1e-4 * along && skew <= 1e-4 * along * across;
}

// Circle and capsule are one shape: a core segment of half length `p_half` along y, rounded.
void add_round(real_t p_radius, real_t p_half, const Transform2D &p_transform, const Surface &p_surface,
		WorldData &r_world) {
	if (has_uniform_scale(p_transform)) {
		std::vector<Vector2> core = { Vector2(0, -p_half) };
		if (p_half > 0) {
			core.push_back(Vector2(0, p_half));
		}
		add_outline(core, p_transform, Real(p_radius * p_transform.columns[0].length()), p_surface, r_world);
		return;
	}
	std::vector<Vector2> outline;
	for (int end = 0; end < 2; end++) {
		for (int i = 0; i <= ARC_POINTS; i++) {
			const double angle = Math_PI * (end + double(i) / ARC_POINTS);
			outline.push_back(Vector2(p_radius * std::cos(angle), p_radius * std::sin(angle) + (end == 0 ? p_half : -p_half)));
		}
	}
	add_outline(outline, p_transform, 0, p_surface, r_world);
}

void add_boundary(const Vector2 &p_normal, real_t p_distance, const Transform2D &p_transform,
		const Surface &p_surface, WorldData &r_world) {
	// Under a scale a normal does not transform like a point; two points on the line do.
	const Vector2 on_line = p_transform.xform(p_normal * p_distance);
	const Vector2 along = p_transform.basis_xform(p_normal.orthogonal());
	Vector2 normal = along.orthogonal().normalized();
	if (normal.dot(p_transform.basis_xform(p_normal)) < 0) {
		normal = -normal;
	}
	if (const Status status = r_world.add_border({ { to_core(on_line), to_core(normal) }, p_surface })) {
		ERR_PRINT_ONCE("SoftBody2D ignores a world boundary: " + to_godot(status->message()));
	}
}

} // namespace

SurroundingsReader::SurroundingsReader() {
	query_shape_ = PhysicsServer2D::get_singleton()->rectangle_shape_create();
	query_.instantiate();
	query_->set_shape_rid(query_shape_);
	query_->set_collide_with_areas(false);
}

SurroundingsReader::~SurroundingsReader() {
	query_.unref();
	if (PhysicsServer2D *server = PhysicsServer2D::get_singleton()) {
		server->free_rid(query_shape_);
	}
}

void SurroundingsReader::begin(WorldData &r_world) {
	known_.clear();
	r_world.clear_surroundings();
}

void SurroundingsReader::read(PhysicsDirectSpaceState2D *p_space, const Aabb &p_box, uint32_t p_mask,
		HullProxy &r_proxy, WorldData &r_world) {
	r_proxy.begin_near();
	if (p_mask == 0) {
		r_proxy.end_near();
		return;
	}
	const Vector2 half = to_godot((p_box.max - p_box.min) * Real(0.5));
	const Vector2 middle = to_godot((p_box.max + p_box.min) * Real(0.5));
	PhysicsServer2D::get_singleton()->shape_set_data(query_shape_, half);
	query_->set_transform(Transform2D(0, middle));
	query_->set_collision_mask(p_mask);
	const TypedArray<Dictionary> hits = p_space->intersect_shape(query_, MAX_SHAPES);
	for (int64_t i = 0; i < hits.size(); i++) {
		const Dictionary hit = hits[i];
		const RID body = hit["rid"];
		if (is_hull_proxy(body)) {
			continue;
		}
		r_proxy.note_near(body, PhysicsServer2D::get_singleton()->body_get_mode(body));
		const int shape_index = hit["shape"];
		if (known_.insert({ body.get_id(), shape_index }).second) {
			read_shape(body, shape_index, r_world);
		}
	}
	r_proxy.end_near();
}

void SurroundingsReader::read_shape(const RID &p_body, int p_shape_index, WorldData &r_world) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	const PhysicsServer2D::BodyMode mode = server->body_get_mode(p_body);
	if (mode != PhysicsServer2D::BODY_MODE_STATIC && mode != PhysicsServer2D::BODY_MODE_KINEMATIC) {
		return;
	}
	const Transform2D body_transform = server->body_get_state(p_body, PhysicsServer2D::BODY_STATE_TRANSFORM);
	const Transform2D transform = body_transform * server->body_get_shape_transform(p_body, p_shape_index);
	const RID shape = server->body_get_shape(p_body, p_shape_index);
	const Variant data = server->shape_get_data(shape);
	const Surface surface = read_surface(p_body, body_transform);

	switch (server->shape_get_type(shape)) {
		case PhysicsServer2D::SHAPE_WORLD_BOUNDARY: {
			const Array values = data;
			add_boundary(values[0], values[1], transform, surface, r_world);
		} break;
		case PhysicsServer2D::SHAPE_SEGMENT: {
			const Rect2 ends = data; // position and "size" are the two ends
			add_outline({ ends.position, ends.size }, transform, 0, surface, r_world);
		} break;
		case PhysicsServer2D::SHAPE_CIRCLE: {
			add_round(data, 0, transform, surface, r_world);
		} break;
		case PhysicsServer2D::SHAPE_CAPSULE: {
			// Godot's own server takes (radius, height) and returns (height, radius). The height includes
			// both caps, so it is never the smaller of the two, whatever the order.
			const Vector2 size = data;
			const real_t radius = Math::min(size.x, size.y);
			const real_t height = Math::max(size.x, size.y);
			add_round(radius, Math::max<real_t>(0, height / 2 - radius), transform, surface, r_world);
		} break;
		case PhysicsServer2D::SHAPE_RECTANGLE: {
			const Vector2 half = data;
			add_outline({ -half, Vector2(half.x, -half.y), half, Vector2(-half.x, half.y) }, transform, 0, surface, r_world);
		} break;
		case PhysicsServer2D::SHAPE_CONVEX_POLYGON: {
			const PackedVector2Array points = data;
			add_outline(std::vector<Vector2>(points.ptr(), points.ptr() + points.size()), transform, 0, surface, r_world);
		} break;
		case PhysicsServer2D::SHAPE_CONCAVE_POLYGON: {
			const PackedVector2Array points = data; // pairs of segment ends
			for (int64_t i = 0; i + 1 < points.size(); i += 2) {
				add_outline({ points[i], points[i + 1] }, transform, 0, surface, r_world);
			}
		} break;
		default:
			break; // a separation ray pushes characters up and has no surface
	}
}

} // namespace softbody
