// SPDX-License-Identifier: MIT
// What soft bodies do to rigid bodies of Godot's physics server.
#pragma once

#include "core/model/world_data.h"
#include "godot/surroundings/body_record.h"

#include <span>

namespace softbody {

/// Hands impulses of soft bodies in the step of `p_delta` [s] to the physics server. Bodies without impulses are not
/// touched, so that they can sleep.
void give_back_impulses(std::span<BodyRecord *const> p_bodies, const WorldData &p_world, double p_delta);
/// Puts bodies that slept to sleep again, as proxies wake bodies near them when they move. Called after they have.
void keep_rigid_bodies_asleep(std::span<BodyRecord *const> p_bodies);

} // namespace softbody
