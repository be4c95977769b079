// SPDX-License-Identifier: MIT
// The look of a body for which nobody has chosen another: a smooth outline, a fill, and a darker rim that fades inward.
#include "godot/drawing/soft_look.h"

#include "core/geometry/polygon.h"

#include <godot_cpp/classes/material.hpp>

#include <algorithm>
#include <cmath>

using namespace godot;

namespace softbody {

namespace {

// Between dark and bright: it stands out from the light and the dark canvas of the editor alike.
const Color SOFT_COLOR(0.2f, 0.62f, 0.57f);
// Width of the rim, as a share of twice the area over the perimeter: of the radius of a disc, of the width of a thin strip.
constexpr Real RIM_SHARE = Real(0.16);
constexpr std::size_t RIM_CORNERS = 32;
constexpr std::size_t MOST_PIECES = 4;

} // namespace

bool is_tinted(const CanvasItem &item) {
	const Color white(1, 1, 1);
	return item.get_modulate() != white || item.get_self_modulate() != white || item.get_material().is_valid();
}

bool is_drawn_soft(const SkinStyle &style, bool is_tinted) {
	if (style.look != SkinStyle::LOOK_AUTOMATIC) {
		return style.look == SkinStyle::LOOK_SOFT;
	}
	const SkinStyle untouched;
	return !is_tinted && style.color == untouched.color && style.vertex_colors.is_empty() && !style.antialiased && !style.smooth &&
			style.texture.is_null() && style.uv.is_empty() && style.outline_width == 0 && style.outline_texture.is_null();
}

Color color_of_look(const SkinStyle &style, bool is_soft) {
	return is_soft && style.look == SkinStyle::LOOK_AUTOMATIC ? SOFT_COLOR : style.color;
}

SkinStyle soften(const SkinStyle &style) {
	SkinStyle soft = style;
	soft.color = color_of_look(style, true);
	soft.smooth = true;
	soft.antialiased = true;
	return soft;
}

Real soft_rim_width(const SkinStyle &style, std::span<const Vec2> hull) {
	if (style.outline_width > 0) {
		return 0;
	}
	const Real outline = perimeter(hull);
	return outline > 0 ? RIM_SHARE * 2 * std::abs(signed_area(hull)) / outline : 0;
}

std::size_t soft_pieces(std::size_t hull_count) {
	return std::clamp((RIM_CORNERS + hull_count - 1) / hull_count, std::size_t(1), MOST_PIECES);
}

} // namespace softbody
