// SPDX-License-Identifier: MIT
// The jelly circle that a new node shows, and a world in pixels with y down to drop it into.
#pragma once

#include "core/model/world_data.h"
#include "scenes/circle.h"

#include <cmath>

namespace softbody::testing {

inline constexpr Real JELLY_RADIUS = 50; ///< [px]
inline constexpr int JELLY_HULL_POINTS = 16;
inline constexpr Real JELLY_MASS = 1; ///< [kg]
inline constexpr Real JELLY_STIFFNESS = 100; ///< [N/m]
inline constexpr Real JELLY_DAMPING = Real(0.12); ///< [N·s/m]
inline constexpr Real PIXELS_PER_METER = 100;
inline constexpr Real PIXEL_GRAVITY = 980; ///< [px/s²], towards +y
inline constexpr Real FRAME = Real(1) / 60; ///< [s]

/// Shape matching of 0.4 k at a damping ratio of a quarter, and the rolling resistance of the node.
inline BodySettings jelly_settings(Real stiffness = JELLY_STIFFNESS) {
	BodySettings settings;
	const Real point_mass = JELLY_MASS / (JELLY_HULL_POINTS + 1);
	settings.shape_stiffness = DEFAULT_SHAPE_MATCHING * stiffness;
	settings.shape_damping = 2 * Real(0.25) * std::sqrt(settings.shape_stiffness * point_mass);
	settings.rolling_resistance = Real(0.03);
	return settings;
}

/// The node's limits of shape: half of a body's area, a fifth of its thickness, three times its length.
inline void set_default_limits(BodySettings &settings) {
	settings.least_area = Real(0.5);
	settings.least_stretch = Real(0.2);
	settings.most_stretch = 3;
}

inline SoftBodyData jelly_circle(Vec2 center, const BodySettings &settings = jelly_settings()) {
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS,
			{ JELLY_MASS, JELLY_STIFFNESS, JELLY_DAMPING, true });
	return SoftBodyData::create(shape.value(), settings, Pose{ center, {} }).value();
}

inline WorldData pixel_world() {
	WorldData world;
	world.set_gravity({ 0, PIXEL_GRAVITY });
	world.set_length_unit(PIXELS_PER_METER);
	return world;
}

/// Solid below y = `height`, as seen on a screen.
inline Border floor_at(Real height, const Surface &surface = {}) {
	return { { { 0, height }, { 0, -1 } }, surface };
}

/// An upright box with positive winding.
inline Collider box_collider(Vec2 center, Vec2 half) {
	return { { { center.x - half.x, center.y - half.y }, { center.x + half.x, center.y - half.y },
					 { center.x + half.x, center.y + half.y }, { center.x - half.x, center.y + half.y } },
		0, {} };
}

} // namespace softbody::testing
