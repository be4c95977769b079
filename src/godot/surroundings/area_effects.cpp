// SPDX-License-Identifier: MIT
// What areas do to a soft body.
#include "godot/surroundings/area_effects.h"

#include "core/model/body_frame.h"
#include "godot/convert.h"

#include <godot_cpp/classes/physics_direct_body_state2d.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>

#include <algorithm>

using namespace godot;

namespace softbody {

AreaEffects read_space_effects(const RID &space) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	const Vector2 direction = server->area_get_param(space, PhysicsServer2D::AREA_PARAM_GRAVITY_VECTOR);
	const double strength = server->area_get_param(space, PhysicsServer2D::AREA_PARAM_GRAVITY);
	AreaEffects effects;
	effects.gravity = to_core(direction * real_t(strength));
	effects.linear_damp = Real(double(server->area_get_param(space, PhysicsServer2D::AREA_PARAM_LINEAR_DAMP)));
	effects.angular_damp = Real(double(server->area_get_param(space, PhysicsServer2D::AREA_PARAM_ANGULAR_DAMP)));
	return effects;
}

AreaEffects read_area_effects(const RID &kinematic_body) {
	const PhysicsDirectBodyState2D *state = PhysicsServer2D::get_singleton()->body_get_direct_state(kinematic_body);
	AreaEffects effects;
	if (state != nullptr) {
		effects.gravity = to_core(state->get_total_gravity());
		effects.linear_damp = Real(state->get_total_linear_damp());
		effects.angular_damp = Real(state->get_total_angular_damp());
	}
	return effects;
}

// As Godot's own bodies: damping takes its part of the velocity at the beginning of a tick, and then come the forces.
void apply_area_effects(const AreaEffects &effects, const AreaEffects &space, Real delta, SoftBodyData &r_body) {
	const Vec2 gained = (effects.gravity - space.gravity) * (r_body.settings().gravity_scale * delta);
	const Real kept_spin = std::max(Real(0), 1 - effects.angular_damp * delta);
	const Real kept = std::max(Real(0), 1 - effects.linear_damp * delta);
	if (gained == Vec2{} && kept == 1 && kept_spin == 1) {
		return;
	}
	const BodyFrame frame = measure_frame(r_body);
	const Vec2 change = gained - frame.velocity * (1 - kept);
	const Real spin_change = frame.angular_velocity * (kept_spin - 1);
	const std::span<Vec2> velocities = r_body.mutable_velocities();
	for (std::size_t i = 0; i < velocities.size(); ++i) {
		if (r_body.inverse_masses()[i] > 0) {
			velocities[i] += change + perpendicular(r_body.positions()[i] - frame.centre) * spin_change;
		}
	}
}

} // namespace softbody
