// SPDX-License-Identifier: MIT
// A user's choices for the looks of a body.
#pragma once

#include <godot_cpp/classes/texture2d.hpp>
#include <godot_cpp/variant/color.hpp>
#include <godot_cpp/variant/packed_color_array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/vector2.hpp>

namespace softbody {

/// Enumerations of the style. A base of the node, so that they have the names `SoftBody2D::…` that the class reference gives them.
struct SkinChoices {
	enum Look {
		LOOK_AUTOMATIC,
		LOOK_PLAIN,
		LOOK_SOFT,
	};

	enum OutlineTextureMode {
		OUTLINE_TEXTURE_TILE,
		OUTLINE_TEXTURE_STRETCH,
	};
};

/// Values of the node's properties; `doc_classes/SoftBody2D.xml` explains each.
struct SkinStyle : SkinChoices {
	Look look = LOOK_AUTOMATIC;
	godot::Color color{ 1, 1, 1 };
	godot::PackedColorArray vertex_colors; ///< one a hull point, in the user's order; ignored when of another size
	bool antialiased = false;
	bool smooth = false;

	godot::Ref<godot::Texture2D> texture;
	godot::Vector2 texture_offset; ///< [px of the texture]
	godot::Vector2 texture_scale{ 1, 1 };
	double texture_rotation = 0; ///< [rad]
	godot::PackedVector2Array uv; ///< one a hull point [px of the texture], like vertex_colors

	godot::Color outline_color{ 0, 0, 0 };
	double outline_width = 0; ///< [px of the node], 0 for none
	godot::Ref<godot::Texture2D> outline_texture;
	OutlineTextureMode outline_texture_mode = OUTLINE_TEXTURE_TILE;

	godot::Color cut_color{ 1, 1, 1 };
	double cut_width = 0; ///< [px of the node] of the band where the body was cut; 0: the outline goes on there
	godot::Ref<godot::Texture2D> cut_texture;
	godot::PackedInt32Array cut_edges; ///< edges that a cut made, from the hull point of that index to the next, in the user's order
};

} // namespace softbody
