// SPDX-License-Identifier: MIT
// The only crossing between Godot's types and the core's.
#pragma once

#include "core/base/elementary.h"
#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <godot_cpp/variant/color.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/string.hpp>
#include <godot_cpp/variant/transform2d.hpp>
#include <godot_cpp/variant/vector2.hpp>

#include <cmath>
#include <span>
#include <string>
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

inline bool is_finite(const godot::Vector2 &p_vector) {
	return p_vector.is_finite();
}

inline bool is_finite(const godot::Color &p_color) {
	return std::isfinite(p_color.r) && std::isfinite(p_color.g) && std::isfinite(p_color.b) && std::isfinite(p_color.a);
}

/// Refuses an array of vectors or colors by the name of its first entry that is not finite.
template <class Array>
Status check_all_finite(const std::string &p_name, const Array &p_values) {
	for (int64_t i = 0; i < p_values.size(); i++) {
		if (!is_finite(p_values[i])) {
			return Error{ p_name + "[" + std::to_string(i) + "]", "non-finite", "must be finite", "check the computation that produced this value" };
		}
	}
	return {};
}

/// Order of a body's points. The core holds a hull of negative winding reversed about its first point.
struct PointOrder {
	int hull_count = 0;
	bool is_reversed = false;

	/// Of the same point the core's index for the user's, or the user's for the core's. A reversal undoes itself.
	int mirror(int p_index) const {
		return is_reversed && p_index < hull_count ? (hull_count - p_index) % hull_count : p_index;
	}
	/// The same of the hull's edge from the point of that index to the next.
	int mirror_edge(int p_index) const { return is_reversed ? hull_count - 1 - p_index : p_index; }
};

// Transform2D::get_rotation, Transform2D(angle, origin) and Vector2::from_angle call the system's library, whose last digit differs
// between systems. What a step reads is turned by the functions below instead; scripts/test.sh engine looks for the others.

/// Angle of a transform's x axis in [-pi, pi], in radians, as Transform2D::get_rotation.
inline double angle_of(const godot::Transform2D &p_transform) {
	return angle_of(double(p_transform.columns[0].y), double(p_transform.columns[0].x));
}

/// Rotation of a transform: the direction of its x axis. No rotation where that axis has no length.
inline Rotation rotation_of(const godot::Transform2D &p_transform) {
	const double x = p_transform.columns[0].x;
	const double y = p_transform.columns[0].y;
	const double length = hypotenuse(x, y);
	return length == 0 ? Rotation() : Rotation{ Real(x / length), Real(y / length) };
}

/// A transform that only rotates.
inline godot::Transform2D to_godot(Rotation p_rotation) {
	return godot::Transform2D(p_rotation.c, p_rotation.s, -p_rotation.s, p_rotation.c, 0, 0);
}

/// A transform that only moves.
inline godot::Transform2D transform_to(Vec2 p_place) {
	return godot::Transform2D(1, 0, 0, 1, p_place.x, p_place.y);
}

/// Rotation and position of a transform; its scale and skew are left out.
inline Pose to_core_pose(const godot::Transform2D &p_transform) {
	return { to_core(p_transform.get_origin()), rotation_of(p_transform) };
}

/// Scale and skew of a transform; its rotation and position are left out.
inline godot::Transform2D scale_and_skew(const godot::Transform2D &p_transform) {
	const Rotation rotation = rotation_of(p_transform);
	godot::Transform2D scale = to_godot(Rotation{ rotation.c, -rotation.s }) * p_transform;
	scale.set_origin(godot::Vector2());
	return scale;
}

/// Whether two scales are alike up to this part of their size. A rotation read back from a matrix differs in the last
/// digits; that is no change of scale.
inline bool is_same_scale(const godot::Transform2D &p_a, const godot::Transform2D &p_b, double p_tolerance) {
	const double most = p_tolerance * double(p_a.columns[0].length() + p_a.columns[1].length());
	return p_a.columns[0].distance_to(p_b.columns[0]) <= most && p_a.columns[1].distance_to(p_b.columns[1]) <= most;
}

/// Whether a transform scales alike in all directions, up to this part.
inline bool is_uniform_scale(const godot::Transform2D &p_transform, double p_tolerance) {
	const double x = p_transform.columns[0].length();
	const double y = p_transform.columns[1].length();
	return std::abs(x - y) <= p_tolerance * x && std::abs(p_transform.columns[0].dot(p_transform.columns[1])) <= p_tolerance * x * y;
}

/// A scale in two factors: a size, and what is left, which is the identity or a mirror image if the scale is the same in
/// all directions. Any other scale is left as it is, with a size of 1.
struct SizedScale {
	godot::Transform2D rest;
	Real size = 1;

	explicit SizedScale(const godot::Transform2D &p_scale) : rest(p_scale) {
		constexpr double TOLERANCE = 1e-5;
		if (is_uniform_scale(p_scale, TOLERANCE)) {
			const real_t length = p_scale.columns[0].length();
			size = std::abs(length - 1) <= TOLERANCE ? Real(1) : Real(length);
			rest = godot::Transform2D(1, 0, 0, p_scale.determinant() < 0 ? -1 : 1, 0, 0);
		}
	}
};

} // namespace softbody
