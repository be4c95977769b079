// SPDX-License-Identifier: MIT
// Draws a body for Debug → Visible Collision Shapes.
#include "godot/drawing/debug_drawing.h"

#include "core/skin/triangulation.h"
#include "godot/convert.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/project_settings.hpp>
#include <godot_cpp/classes/rendering_server.hpp>
#include <godot_cpp/classes/resource.hpp>
#include <godot_cpp/core/math.hpp>
#include <godot_cpp/variant/packed_color_array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>

using namespace godot;

namespace softbody {

namespace {

constexpr int Z_ABOVE_BODIES = 1;
constexpr real_t FULL_COLOR_STRAIN = 0.2; // at which a spring is fully red or blue
constexpr real_t SPRING_WIDTH = 1.5; // px, like the following
constexpr real_t CENTER_SIZE = 5;
constexpr real_t CONTACT_SIZE = 4;
constexpr real_t NORMAL_LENGTH = 14;
constexpr int FONT_SIZE = 11;
const Color RELAXED(0.9, 0.9, 0.9, 0.7);
const Color STRETCHED(1, 0.2, 0.1);
const Color PRESSED(0.2, 0.4, 1);

RenderingServer *server() {
	return RenderingServer::get_singleton();
}

Color setting(const char *p_name, const Color &p_otherwise) {
	return ProjectSettings::get_singleton()->get_setting(p_name, p_otherwise);
}

Vector2 mean_of(std::span<const Vec2> p_points, std::span<const Real> p_masses) {
	Vec2 sum;
	Real mass = 0;
	for (std::size_t i = 0; i < p_points.size(); i++) {
		sum += p_points[i] * p_masses[i];
		mass += p_masses[i];
	}
	return to_godot(sum * (1 / mass));
}

} // namespace

DebugDrawing::DebugDrawing(const RID &parent) {
	item_ = server()->canvas_item_create();
	server()->canvas_item_set_parent(item_, parent);
	server()->canvas_item_set_z_index(item_, Z_ABOVE_BODIES);
	server()->canvas_item_set_z_as_relative_to_parent(item_, true);
}

DebugDrawing::~DebugDrawing() {
	server()->free_rid(item_);
}

void DebugDrawing::draw(const SoftBodyData &body, std::span<const Vec2> points, const Transform2D &frame,
		std::span<const Contact> contacts, const SubstepPlan &plan) {
	const Vector2 scale = frame.get_scale().abs();
	const real_t pixel = 1 / MAX(real_t(1e-3), (scale.x + scale.y) / 2);
	server()->canvas_item_clear(item_);
	draw_hull(body, points);
	if (!body.settings().is_elastic()) { // springs take no part beside elastic modes
		draw_springs(body, points, pixel);
	}
	const Vector2 center = mean_of(points, body.shape().masses());
	const Vector2 arm_x = Vector2(CENTER_SIZE * pixel, 0);
	const Vector2 arm_y = Vector2(0, CENTER_SIZE * pixel);
	server()->canvas_item_add_line(item_, center - arm_x, center + arm_x, Color(1, 1, 0), 2 * pixel);
	server()->canvas_item_add_line(item_, center - arm_y, center + arm_y, Color(1, 1, 0), 2 * pixel);
	draw_contacts(contacts, frame, pixel);
	draw_text(plan, frame, center);
}

void DebugDrawing::draw_hull(const SoftBodyData &body, std::span<const Vec2> points) {
	const std::span<const Vec2> rest = body.shape().rest_hull();
	PackedInt32Array indices;
	for (const Triangle &triangle : triangulate(rest, rest.size())) {
		for (const std::uint32_t corner : triangle) {
			indices.push_back(int32_t(corner));
		}
	}
	Color color = setting("debug/shapes/collision/shape_color", Color(0, 0.6, 0.7, 0.42));
	PackedVector2Array hull = to_godot(points.first(rest.size()));
	PackedColorArray colors;
	colors.push_back(color);
	server()->canvas_item_add_triangle_array(item_, indices, hull, colors);
	hull.push_back(hull[0]);
	color.a = 1;
	colors.set(0, color);
	server()->canvas_item_add_polyline(item_, hull, colors);
}

void DebugDrawing::draw_springs(const SoftBodyData &body, std::span<const Vec2> points, real_t pixel) {
	PackedVector2Array ends;
	PackedColorArray colors;
	for (const Spring2D &spring : body.shape().springs()) {
		// At the body's own scale: a length in the node's frame is one in the world over the node's scale.
		const real_t length_now = length(body.positions()[spring.a] - body.positions()[spring.b]);
		const real_t strain = length_now / spring.rest_length - 1;
		const real_t share = MIN(real_t(1), Math::abs(strain) / FULL_COLOR_STRAIN);
		ends.push_back(to_godot(points[spring.a]));
		ends.push_back(to_godot(points[spring.b]));
		colors.push_back(RELAXED.lerp(strain > 0 ? STRETCHED : PRESSED, share));
	}
	if (!ends.is_empty()) {
		server()->canvas_item_add_multiline(item_, ends, colors, SPRING_WIDTH * pixel);
	}
}

void DebugDrawing::draw_contacts(std::span<const Contact> contacts, const Transform2D &frame, real_t pixel) {
	const Color color = setting("debug/shapes/collision/contact_color", Color(1, 0.2, 0.1, 0.8));
	const Transform2D to_local = frame.affine_inverse();
	for (const Contact &contact : contacts) {
		const Vector2 place = to_local.xform(to_godot(contact.point));
		const Vector2 tip = to_local.xform(to_godot(contact.point + contact.normal * Real(NORMAL_LENGTH)));
		server()->canvas_item_add_circle(item_, place, CONTACT_SIZE * pixel, color);
		server()->canvas_item_add_line(item_, place, tip, color, 2 * pixel);
	}
}

void DebugDrawing::draw_text(const SubstepPlan &plan, const Transform2D &frame, const Vector2 &place) {
	const Object *themes = Engine::get_singleton()->get_singleton("ThemeDB");
	const Ref<Resource> font = themes == nullptr ? Variant() : themes->get("fallback_font");
	if (font.is_null()) {
		return;
	}
	const String frequency = String::num(plan.frequency, 0);
	const String text = String::utf8("Ω ") + frequency + " rad/s / " + String::num_int64(plan.substeps);
	// Upright and of constant size, however the node is turned and scaled.
	Transform2D upright = frame.affine_inverse();
	upright.set_origin(place);
	server()->canvas_item_add_set_transform(item_, upright);
	font->call("draw_string", item_, Vector2(CENTER_SIZE + 2, -CENTER_SIZE), text, 0, -1, FONT_SIZE);
	server()->canvas_item_add_set_transform(item_, Transform2D());
}

} // namespace softbody
