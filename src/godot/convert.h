// SPDX-License-Identifier: MIT
// The only crossing between Godot's types and the core's.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/string.hpp>
#include <godot_cpp/variant/transform2d.hpp>
#include <godot_cpp/variant/vector2.hpp>

#include <span>
#include <vector>

namespace softbody {

/// Godot's own conversion between lengths in 2D and meters [px/m].
inline constexpr Real PIXELS_PER_METER = 100;

inline Vec2 to_core(const godot::Vector2 &p_vector) {
	return { Real(p_vector.x), Real(p_vector.y) };
}

inline godot::Vector2 to_godot(Vec2 p_vector) {
	return godot::Vector2(p_vector.x, p_vector.y);
}

inline godot::String to_godot(const std::string &p_text) {
	return godot::String::utf8(p_text.c_str(), int64_t(p_text.size()));
}

/// The message of a refusal in the words of the nodes, where the hull is called polygon.
inline godot::String to_godot(const Error &p_error) {
	return to_godot(p_error.message()).replace("hull", "polygon");
}

inline std::vector<Vec2> to_core(const godot::PackedVector2Array &p_points) {
	std::vector<Vec2> points;
	points.reserve(size_t(p_points.size()));
	for (const godot::Vector2 &point : p_points) {
		points.push_back(to_core(point));
	}
	return points;
}

inline godot::PackedVector2Array to_godot(std::span<const Vec2> p_points) {
	godot::PackedVector2Array points;
	points.resize(int64_t(p_points.size()));
	godot::Vector2 *write = points.ptrw();
	for (const Vec2 point : p_points) {
		*write++ = to_godot(point);
	}
	return points;
}

/// Rotation and position of a transform; its scale and skew are left out.
inline Pose to_core_pose(const godot::Transform2D &p_transform) {
	return { to_core(p_transform.get_origin()), Rotation::from_angle(Real(p_transform.get_rotation())) };
}

/// Scale and skew of a transform; its rotation and position are left out.
inline godot::Transform2D scale_and_skew(const godot::Transform2D &p_transform) {
	godot::Transform2D scale = godot::Transform2D(-p_transform.get_rotation(), godot::Vector2()) * p_transform;
	scale.set_origin(godot::Vector2());
	return scale;
}

} // namespace softbody
