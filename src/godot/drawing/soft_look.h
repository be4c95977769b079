// SPDX-License-Identifier: MIT
// The look of a body for which nobody has chosen another: a smooth outline, a fill, and a darker rim that fades inward.
#pragma once

#include "core/base/vec2.h"
#include "godot/drawing/skin_style.h"

#include <godot_cpp/classes/canvas_item.hpp>

#include <cstddef>
#include <span>

namespace softbody {

/// Whether a node has a color or a shader that are not properties of its body: modulate, self_modulate or material.
bool is_tinted(const godot::CanvasItem &item);

/// Whether a body of this style is drawn in the soft look. LOOK_AUTOMATIC is soft where all that says how a body is drawn has
/// its default value; `is_tinted` tells whether the node has a modulate or material of its own.
bool is_drawn_soft(const SkinStyle &style, bool is_tinted);

/// The fill color of the style; that of the soft look where LOOK_AUTOMATIC chose it.
godot::Color color_of_look(const SkinStyle &style, bool is_soft);

/// The style as the soft look draws it: smooth and antialiased.
SkinStyle soften(const SkinStyle &style);

/// Width of the soft look's rim for a body with this outline [length of the outline]; 0 where the style has an outline of its own.
Real soft_rim_width(const SkinStyle &style, std::span<const Vec2> hull);

/// Brightness of the rim at its outer edge, as a share of that of the fill.
inline constexpr float RIM_SHADE = 0.5f;

/// Pieces of each edge of a hull in the soft look, 1..4: so many that the rim has about 32 corners.
std::size_t soft_pieces(std::size_t hull_count);

} // namespace softbody
