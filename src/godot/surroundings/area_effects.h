// SPDX-License-Identifier: MIT
// Effects of areas on a soft body: gravity and damping.
#pragma once

#include "core/base/error.h"
#include "core/model/soft_body_data.h"

#include <godot_cpp/variant/rid.hpp>

#include <algorithm>

namespace softbody {

/// Gravity and damping at one body, including all areas that it overlaps.
struct AreaEffects {
	Vec2 gravity; ///< before the body's gravity_scale [px/s²]
	Real linear_damp = 0; ///< decay of the velocity [1/s]
	Real angular_damp = 0; ///< decay of the spin [1/s]

	friend bool operator==(const AreaEffects &, const AreaEffects &) = default;
};

/// How a body's own damping combines with that of areas: as `RigidBody2D.DampMode`. Areas may have a negative one; the
/// sum is at least 0, as a soft body must not gain energy by it.
struct DampChoice {
	Real damp = 0;
	bool replaces = false; ///< false: added to that of the areas

	Real combined_with(Real of_areas) const { return replaces ? damp : std::max(Real(0), damp + of_areas); }
};

/// Effects outside of all areas: the space's default gravity, if it has a direction, and damping.
AreaEffects read_space_effects(const godot::RID &space);

/// Effects that the engine worked out for a kinematic body in its last step, in which the body must have been in the
/// space. The four ways of overriding, priorities and gravity points are the engine's own.
AreaEffects read_area_effects(const godot::RID &kinematic_body);

/// Applies gravity, as an acceleration beside the world's, and damping, as settings. `space` are the effects that the
/// world applies already. A sleeping body wakes on a change. Refuses non-finite values and negative damping.
Status apply_area_effects(const AreaEffects &effects, const AreaEffects &space, SoftBodyData &r_body);

} // namespace softbody
