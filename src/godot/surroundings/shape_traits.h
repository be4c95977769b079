// SPDX-License-Identifier: MIT
// Traits of a shape that its node tells and the physics server does not.
#pragma once

#include <godot_cpp/core/object.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/vector2.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace softbody {

/// Traits of one shape.
struct ShapeTraits {
	bool disabled = false;
	std::optional<double> one_way_margin; ///< [px]; nothing for an ordinary shape

	friend bool operator==(const ShapeTraits &, const ShapeTraits &) = default;
};

/// The traits of shapes [0, `p_count`) of a CollisionObject2D, by index; unknown shapes are ordinary. O(shapes).
std::vector<ShapeTraits> read_shape_traits(godot::Object *p_owner, int p_count);

/// A number that changes when shapes of the CollisionObject2D are added, removed, enabled or disabled. O(shape owners).
uint64_t describe_shape_owners(godot::Object *p_owner);

/// The one-way margin of the tile whose collision polygon has its middle at `p_middle` in the world; empty if it is
/// ordinary. O(polygons of the tile).
std::optional<double> find_tile_margin(godot::Object *p_layer, const godot::RID &p_body, const godot::Vector2 &p_middle);

} // namespace softbody
