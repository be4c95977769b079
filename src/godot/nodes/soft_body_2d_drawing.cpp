// SPDX-License-Identifier: MIT
// How the node is drawn: a triangle mesh between the last two physics ticks.
#include "godot/nodes/soft_body_2d.h"

#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/geometry2d.hpp>
#include <godot_cpp/classes/rendering_server.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/math.hpp>

#include <utility>
#include <vector>

namespace godot {

namespace {

Vector2 mean_of(const PackedVector2Array &p_points) {
	Vector2 sum;
	for (const Vector2 &point : p_points) {
		sum += point;
	}
	return sum / real_t(p_points.size());
}

// Hull and middle in the order the core holds them.
PackedVector2Array rest_points(const PackedVector2Array &p_hull, bool p_reversed) {
	PackedVector2Array points;
	const int64_t count = p_hull.size();
	for (int64_t i = 0; i < count; i++) {
		points.push_back(p_hull[p_reversed ? (count - i) % count : i]);
	}
	points.push_back(mean_of(points));
	return points;
}

} // namespace

// Triangles and texture coordinates come from the rest shape once: a fan around the centre point, which
// follows the body's inside, or, where the hull hides part of itself from it, cut ears.
void SoftBody2D::update_topology() {
	const int hull_count = int(hull_.size());
	const PackedVector2Array points = rest_points(hull_, hull_reversed_);
	triangles_.clear();
	const std::vector<softbody::Vec2> hull = softbody::to_core(points.slice(0, hull_count));
	if (softbody::is_star_shaped_about(softbody::to_core(points[hull_count]), hull)) {
		for (int i = 0; i < hull_count; i++) {
			for (const int index : { hull_count, i, (i + 1) % hull_count }) {
				triangles_.push_back(index);
			}
		}
	} else {
		triangles_ = Geometry2D::get_singleton()->triangulate_polygon(points.slice(0, hull_count));
	}

	const softbody::Aabb box = softbody::bounding_box(hull);
	const Vector2 corner = softbody::to_godot(box.min);
	const Vector2 size = softbody::to_godot(box.max - box.min);
	uvs_.clear();
	for (const Vector2 &point : points) {
		uvs_.push_back((point - corner) / size);
	}
	queue_redraw();
}

PackedVector2Array SoftBody2D::interpolated_points(double p_fraction, const Transform2D &p_relative_to) const {
	const int64_t count = current_.local_points.size();
	PackedVector2Array points;
	if (count == 0 || previous_.local_points.size() != count) {
		return points;
	}
	const real_t fraction = real_t(p_fraction);
	Transform2D frame;
	if (p_fraction <= 0 || p_fraction >= 1) {
		frame = p_fraction <= 0 ? previous_.transform : current_.transform; // exact at the ticks
	} else {
		frame = previous_.transform.interpolate_with(current_.transform, fraction);
	}
	const Transform2D transform = p_relative_to.affine_inverse() * frame;
	points.resize(count);
	Vector2 *write = points.ptrw();
	for (int64_t i = 0; i < count; i++) {
		write[i] = transform.xform(previous_.local_points[i].lerp(current_.local_points[i], fraction));
	}
	return points;
}

void SoftBody2D::draw() {
	PackedVector2Array points;
	if (space_ == nullptr || current_.local_points.is_empty()) {
		points = rest_points(hull_, hull_reversed_);
	} else {
		const double fraction = Engine::get_singleton()->get_physics_interpolation_fraction();
		const Transform2D transform = get_global_transform();
		if (is_physics_interpolated_and_enabled()) {
			// The engine moves the canvas item between the ticks; only the shape is left to us.
			const Transform2D frame = previous_.transform.interpolate_with(current_.transform, real_t(fraction));
			points = interpolated_points(fraction, frame);
		} else {
			points = interpolated_points(fraction, transform);
		}
	}
	if (triangles_.is_empty() || points.is_empty()) {
		return;
	}
	if (points.size() == hull_.size()) {
		points.push_back(mean_of(points)); // the fan needs a middle even where the body has no point there
	}
	PackedColorArray colors;
	colors.push_back(color_);
	RenderingServer::get_singleton()->canvas_item_add_triangle_array(get_canvas_item(), triangles_, points, colors,
			texture_.is_valid() ? uvs_ : PackedVector2Array(), PackedInt32Array(), PackedFloat32Array(),
			texture_.is_valid() ? texture_->get_rid() : RID());
}

void SoftBody2D::bind_drawing() {
	ClassDB::bind_method(D_METHOD("set_color", "color"), &SoftBody2D::set_color);
	ClassDB::bind_method(D_METHOD("get_color"), &SoftBody2D::get_color);
	ClassDB::bind_method(D_METHOD("set_texture", "texture"), &SoftBody2D::set_texture);
	ClassDB::bind_method(D_METHOD("get_texture"), &SoftBody2D::get_texture);
	ClassDB::bind_method(D_METHOD("get_interpolated_hull", "fraction"), &SoftBody2D::get_interpolated_hull);

	ADD_GROUP("Drawing", "");
	ADD_PROPERTY(PropertyInfo(Variant::COLOR, "color"), "set_color", "get_color");
	ADD_PROPERTY(PropertyInfo(Variant::OBJECT, "texture", PROPERTY_HINT_RESOURCE_TYPE, "Texture2D"), "set_texture", "get_texture");
}

} // namespace godot
