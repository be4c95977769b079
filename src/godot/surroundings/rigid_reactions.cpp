// SPDX-License-Identifier: MIT
// What soft bodies do to rigid bodies of Godot's physics server.
#include "godot/surroundings/rigid_reactions.h"

#include "godot/convert.h"

#include <godot_cpp/classes/physics_server2d.hpp>

using namespace godot;

namespace softbody {

void give_back_impulses(std::span<BodyRecord *const> p_bodies, const WorldData &p_world, double p_delta) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	for (BodyRecord *body : p_bodies) {
		if (!body->is_rigid()) {
			continue;
		}
		const Reaction reaction = body->take_reaction(p_world.reactions()[body->rigid_index], p_delta);
		if (reaction.impulse != Vec2{}) {
			server->body_apply_central_impulse(body->rid(), to_godot(reaction.impulse));
		}
		if (reaction.angular_impulse != 0) {
			server->body_apply_torque_impulse(body->rid(), reaction.angular_impulse);
		}
	}
}

void keep_rigid_bodies_asleep(std::span<BodyRecord *const> p_bodies) {
	for (BodyRecord *body : p_bodies) {
		if (body->is_rigid()) {
			body->keep_asleep();
		}
	}
}

} // namespace softbody
