// SPDX-License-Identifier: MIT
// The node's looks: their properties, and the rest shape that they are made for.
#include "godot/nodes/soft_body_2d.h"

#include "godot/convert.h"

#include <godot_cpp/core/class_db.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

using softbody::SkinStyle;
using softbody::Vec2;

namespace godot {

namespace {

// Hull, inner points and middle in the order the core holds them.
std::vector<Vec2> rest_points(const PackedVector2Array &p_polygon, const PackedVector2Array &p_inner_points, bool p_reversed, bool p_center_point) {
	std::vector<Vec2> points = softbody::to_core(p_polygon);
	if (p_reversed) {
		std::reverse(points.begin() + 1, points.end());
	}
	Vec2 sum;
	for (const Vec2 point : points) {
		sum += point;
	}
	const Vec2 middle = sum * (1 / softbody::Real(points.size()));
	for (const Vector2 &point : p_inner_points) {
		points.push_back(softbody::to_core(point));
	}
	if (p_center_point) {
		points.push_back(middle);
	}
	return points;
}

bool is_finite(const Vector2 &p_place) {
	return p_place.is_finite();
}

bool is_finite(const Color &p_color) {
	return Math::is_finite(p_color.r) && Math::is_finite(p_color.g) && Math::is_finite(p_color.b) && Math::is_finite(p_color.a);
}

template <class Array>
softbody::Status check_finite(const char *p_name, const Array &p_values) {
	for (int64_t i = 0; i < p_values.size(); i++) {
		if (!is_finite(p_values[i])) {
			return softbody::Error{ std::string(p_name) + "[" + std::to_string(i) + "]", "non-finite", "must be finite", "check the computation that produced this value" };
		}
	}
	return std::nullopt;
}

String size_warning(const char *p_property, int64_t p_size, int64_t p_polygon_size) {
	return "'" + String(p_property) + "' has " + String::num_int64(p_size) + " entries and the polygon " + String::num_int64(p_polygon_size) + " points, so it is not used. Give it one entry for each point of the polygon, or none.";
}

} // namespace

void SoftBody2D::update_topology() {
	rest_version_++;
	// Of the node's scale one pixel is this part; the parent's and the camera's are left out, as Godot's own lines do.
	const Vector2 scale = built_scale_.get_scale().abs();
	const real_t pixel = 1 / MAX(real_t(1e-3), (scale.x + scale.y) / 2);
	skin_.set_rest(rest_points(polygon_, inner_points_, polygon_reversed_, center_point_), std::size_t(polygon_.size()), polygon_reversed_, softbody::Real(pixel));
	remake_skin();
}

// The commands of the canvas item hold colors and textures; drawing them again also brings the meshes up to date.
void SoftBody2D::remake_skin() {
	settled_ = false;
	area_checked_ = false;
	queue_redraw();
}

void SoftBody2D::append_drawing_warnings(PackedStringArray &r_warnings) const {
	const SkinStyle &style = skin_.style();
	if (!style.vertex_colors.is_empty() && style.vertex_colors.size() != polygon_.size()) {
		r_warnings.push_back(size_warning("vertex_colors", style.vertex_colors.size(), polygon_.size()));
	}
	if (!style.uv.is_empty() && style.uv.size() != polygon_.size()) {
		r_warnings.push_back(size_warning("uv", style.uv.size(), polygon_.size()));
	}
}

void SoftBody2D::set_color(const Color &p_color) {
	skin_.change_style().color = p_color;
	remake_skin();
}

void SoftBody2D::set_vertex_colors(const PackedColorArray &p_colors) {
	if (!accept("vertex_colors", check_finite("vertex_colors", p_colors))) {
		return;
	}
	skin_.change_style().vertex_colors = p_colors;
	remake_skin();
	update_configuration_warnings();
}

void SoftBody2D::set_antialiased(bool p_antialiased) {
	skin_.change_style().antialiased = p_antialiased;
	remake_skin();
}

void SoftBody2D::set_smooth(bool p_smooth) {
	skin_.change_style().smooth = p_smooth;
	remake_skin();
}

// A texture that changes may have another size, or show another part of an atlas.
void SoftBody2D::follow_texture() {
	skin_.change_style();
	remake_skin();
}

void SoftBody2D::replace_texture(Ref<Texture2D> SkinStyle::*p_member, const Ref<Texture2D> &p_texture) {
	const Callable changed = own_callable("_follow_texture");
	SkinStyle &style = skin_.change_style();
	for (const Ref<Texture2D> &texture : { style.texture, style.outline_texture }) {
		if (texture.is_valid() && texture->is_connected("changed", changed)) {
			texture->disconnect("changed", changed);
		}
	}
	style.*p_member = p_texture;
	for (const Ref<Texture2D> &texture : { style.texture, style.outline_texture }) {
		if (texture.is_valid() && !texture->is_connected("changed", changed)) {
			texture->connect("changed", changed);
		}
	}
	remake_skin();
}

void SoftBody2D::set_texture(const Ref<Texture2D> &p_texture) {
	replace_texture(&SkinStyle::texture, p_texture);
}

void SoftBody2D::set_texture_offset(const Vector2 &p_offset) {
	skin_.change_style().texture_offset = p_offset;
	remake_skin();
}

void SoftBody2D::set_texture_scale(const Vector2 &p_scale) {
	skin_.change_style().texture_scale = p_scale;
	remake_skin();
}

void SoftBody2D::set_texture_rotation(double p_rotation) {
	skin_.change_style().texture_rotation = p_rotation;
	remake_skin();
}

void SoftBody2D::set_uv(const PackedVector2Array &p_uv) {
	if (!accept("uv", check_finite("uv", p_uv))) {
		return;
	}
	skin_.change_style().uv = p_uv;
	remake_skin();
	update_configuration_warnings();
}

void SoftBody2D::set_outline_width(double p_width) {
	if (accept("outline_width", softbody::check_at_least("outline_width", p_width, 0, "px"))) {
		skin_.change_style().outline_width = p_width;
		remake_skin();
	}
}

void SoftBody2D::set_outline_color(const Color &p_color) {
	skin_.change_style().outline_color = p_color;
	remake_skin();
}

void SoftBody2D::set_outline_texture(const Ref<Texture2D> &p_texture) {
	replace_texture(&SkinStyle::outline_texture, p_texture);
}

void SoftBody2D::set_outline_texture_mode(OutlineTextureMode p_mode) {
	if (accept("outline_texture_mode", softbody::check_between("outline_texture_mode", p_mode, 0, 1, ""))) {
		skin_.change_style().outline_texture_mode = SkinStyle::OutlineTextureMode(p_mode);
		remake_skin();
	}
}

SoftBody2D::OutlineTextureMode SoftBody2D::get_outline_texture_mode() const {
	return OutlineTextureMode(skin_.style().outline_texture_mode);
}

void SoftBody2D::bind_drawing() {
	ClassDB::bind_method(D_METHOD("set_color", "color"), &SoftBody2D::set_color);
	ClassDB::bind_method(D_METHOD("get_color"), &SoftBody2D::get_color);
	ClassDB::bind_method(D_METHOD("set_vertex_colors", "vertex_colors"), &SoftBody2D::set_vertex_colors);
	ClassDB::bind_method(D_METHOD("get_vertex_colors"), &SoftBody2D::get_vertex_colors);
	ClassDB::bind_method(D_METHOD("set_antialiased", "antialiased"), &SoftBody2D::set_antialiased);
	ClassDB::bind_method(D_METHOD("is_antialiased"), &SoftBody2D::is_antialiased);
	ClassDB::bind_method(D_METHOD("set_smooth", "smooth"), &SoftBody2D::set_smooth);
	ClassDB::bind_method(D_METHOD("is_smooth"), &SoftBody2D::is_smooth);
	ClassDB::bind_method(D_METHOD("set_texture", "texture"), &SoftBody2D::set_texture);
	ClassDB::bind_method(D_METHOD("get_texture"), &SoftBody2D::get_texture);
	ClassDB::bind_method(D_METHOD("set_texture_offset", "texture_offset"), &SoftBody2D::set_texture_offset);
	ClassDB::bind_method(D_METHOD("get_texture_offset"), &SoftBody2D::get_texture_offset);
	ClassDB::bind_method(D_METHOD("set_texture_scale", "texture_scale"), &SoftBody2D::set_texture_scale);
	ClassDB::bind_method(D_METHOD("get_texture_scale"), &SoftBody2D::get_texture_scale);
	ClassDB::bind_method(D_METHOD("set_texture_rotation", "texture_rotation"), &SoftBody2D::set_texture_rotation);
	ClassDB::bind_method(D_METHOD("get_texture_rotation"), &SoftBody2D::get_texture_rotation);
	ClassDB::bind_method(D_METHOD("set_uv", "uv"), &SoftBody2D::set_uv);
	ClassDB::bind_method(D_METHOD("get_uv"), &SoftBody2D::get_uv);
	ClassDB::bind_method(D_METHOD("set_outline_width", "outline_width"), &SoftBody2D::set_outline_width);
	ClassDB::bind_method(D_METHOD("get_outline_width"), &SoftBody2D::get_outline_width);
	ClassDB::bind_method(D_METHOD("set_outline_color", "outline_color"), &SoftBody2D::set_outline_color);
	ClassDB::bind_method(D_METHOD("get_outline_color"), &SoftBody2D::get_outline_color);
	ClassDB::bind_method(D_METHOD("set_outline_texture", "outline_texture"), &SoftBody2D::set_outline_texture);
	ClassDB::bind_method(D_METHOD("get_outline_texture"), &SoftBody2D::get_outline_texture);
	ClassDB::bind_method(D_METHOD("set_outline_texture_mode", "outline_texture_mode"), &SoftBody2D::set_outline_texture_mode);
	ClassDB::bind_method(D_METHOD("get_outline_texture_mode"), &SoftBody2D::get_outline_texture_mode);
	ClassDB::bind_method(D_METHOD("get_interpolated_polygon", "fraction"), &SoftBody2D::get_interpolated_polygon, DEFVAL(-1.0));
	ClassDB::bind_method(D_METHOD("get_interpolated_transform", "fraction"), &SoftBody2D::get_interpolated_transform, DEFVAL(-1.0));
	ClassDB::bind_method(D_METHOD("_follow_texture"), &SoftBody2D::follow_texture);
	ClassDB::bind_method(D_METHOD("_enter_screen"), &SoftBody2D::enter_screen);
	ClassDB::bind_method(D_METHOD("_leave_screen"), &SoftBody2D::leave_screen);

	BIND_ENUM_CONSTANT(OUTLINE_TEXTURE_TILE);
	BIND_ENUM_CONSTANT(OUTLINE_TEXTURE_STRETCH);
}

} // namespace godot
