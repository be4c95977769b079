// SPDX-License-Identifier: MIT
// Effects of areas on a soft body.
#include "godot/surroundings/area_effects.h"

#include "godot/convert.h"

#include <godot_cpp/classes/physics_direct_body_state2d.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>

#include <cmath>

using namespace godot;

namespace softbody {

namespace {

// Share of gravity that may change unnoticed: point gravity changes with every move, and a change keeps a body awake.
constexpr Real GRAVITY_TOLERANCE = Real(1e-3);

} // namespace

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

Status apply_area_effects(const AreaEffects &effects, const AreaEffects &space, SoftBodyData &r_body) {
	if (r_body.settings().linear_damp != effects.linear_damp || r_body.settings().angular_damp != effects.angular_damp) {
		BodySettings settings = r_body.settings();
		settings.linear_damp = effects.linear_damp;
		settings.angular_damp = effects.angular_damp;
		if (Status status = r_body.set_settings(settings)) {
			return status;
		}
	}
	const Real scale = r_body.settings().gravity_scale;
	Vec2 acceleration = (effects.gravity - space.gravity) * scale;
	const Real tolerance = GRAVITY_TOLERANCE * (length(effects.gravity) + length(space.gravity)) * std::abs(scale);
	if (length(acceleration) <= tolerance) {
		acceleration = {};
	} else if (length(acceleration - r_body.acceleration()) <= tolerance) {
		return {};
	}
	return r_body.set_acceleration(acceleration);
}

} // namespace softbody
