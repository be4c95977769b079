// SPDX-License-Identifier: MIT
// Translates shapes of Godot's physics server for the core.
#pragma once

#include "core/geometry/plane.h"
#include "core/model/surroundings.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/variant/transform2d.hpp>
#include <godot_cpp/variant/variant.hpp>

#include <optional>
#include <vector>

namespace softbody {

/// A shape as colliders of the core, without a surface.
struct TranslatedShape {
	std::vector<Collider> colliders;
	std::optional<Plane> border; ///< of a world boundary
};

/// Translates a shape of any kind, with any transform: turned, scaled, skewed, mirrored. `p_data` is the result of
/// `PhysicsServer2D.shape_get_data()`; `p_to_frame` maps from the shape to the frame of the result. Round shapes stay
/// round under a uniform scale, and become polygons under another. Segments of a concave shape that share an end with
/// one other segment are joined as a chain. A separation ray has no surface and gives nothing. Shapes that the core
/// refuses are left out with an error.
TranslatedShape translate_shape(godot::PhysicsServer2D::ShapeType p_type, const godot::Variant &p_data,
		const godot::Transform2D &p_to_frame);

/// Half the width of a one-way border [px]. Larger: single precision rounds contacts more coarsely.
inline constexpr Real ONE_WAY_REACH = 40000;

/// Turns a border, if there is one, into a collider with the same front, as only colliders can be one-way. It ends
/// ONE_WAY_REACH to either side of `middle`, a place in the same frame.
void make_border_finite(Vec2 middle, TranslatedShape &r_shape);

} // namespace softbody
