// SPDX-License-Identifier: MIT
// What areas do to a soft body: another gravity, and damping.
#pragma once

#include "core/base/error.h"
#include "core/model/soft_body_data.h"

#include <godot_cpp/variant/rid.hpp>

#include <algorithm>

namespace softbody {

/// Gravity and damping at one body, with all areas that it overlaps counted in.
struct AreaEffects {
	Vec2 gravity; ///< before the body's gravity_scale [px/s²]
	Real linear_damp = 0; ///< what the velocity loses a second, as a part of it [1/s]
	Real angular_damp = 0; ///< the same of the spin [1/s]

	friend bool operator==(const AreaEffects &, const AreaEffects &) = default;
};

/// How a body's own damping and that of areas meet: as `RigidBody2D.DampMode`. Areas may have a negative one; together it is
/// at least 0, as a soft body has nothing that could feed on it.
struct DampChoice {
	Real damp = 0;
	bool replaces = false; ///< false: added to that of the areas

	Real combined_with(Real of_areas) const { return replaces ? damp : std::max(Real(0), damp + of_areas); }
};

/// Of a space where no area is: its default gravity, if it has a direction, and damping.
AreaEffects read_space_effects(const godot::RID &space);

/// What the engine has worked out for a kinematic body in its last step, which must have been in the space by then: the
/// four ways of overriding, priorities and gravity points are the engine's own.
AreaEffects read_area_effects(const godot::RID &kinematic_body);

/// Hands the body the gravity, as an acceleration of its own beside the world's, and the damping, as settings. `space` is
/// what the world does to all bodies already. A body that sleeps wakes when one of them has changed.
/// Refuses what the core refuses, values that are not finite and negative damping.
Status apply_area_effects(const AreaEffects &effects, const AreaEffects &space, SoftBodyData &r_body);

} // namespace softbody
