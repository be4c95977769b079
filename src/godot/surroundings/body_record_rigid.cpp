// SPDX-License-Identifier: MIT
// A RigidBody2D of the engine: how the core takes it over, and hands impulses back, awake and asleep.
#include "godot/surroundings/body_record.h"

#include "godot/convert.h"

#include <algorithm>
#include <cmath>

using namespace godot;

namespace softbody {

namespace {

// Least cosine of the angle between a support and the direction against the weight [1].
constexpr double LEAST_SUPPORT = 0.2;

// A sleeping body is woken when its load would have given it this speed [px/s] or spin [rad/s], below which the engine
// lets bodies sleep by default. Larger: it stays in place longer when its support gives way. Smaller: trembling soft
// bodies wake it.
constexpr Real WAKING_SPEED = 2;
constexpr Real WAKING_SPIN = Real(0.14);

// Tolerance for the load that soft bodies carry of a sleeping body without waking it, as a share of its weight. Larger:
// it hangs in the air when its support gives way slowly. Smaller: the remaining motion of soft bodies wakes bodies that
// fell asleep on them.
constexpr Real BALANCE_TOLERANCE = Real(0.25);
constexpr Real SIDEWAYS_TOLERANCE = Real(0.2); // of BALANCE_TOLERANCE, for loads across the weight

// Angular acceleration by soft bodies [rad/s²] below which a support against turning is not estimated.
constexpr Real LEAST_TURN = Real(0.1);

// The part of a load that a support does not bear. `p_support` is the direction of its push, as long as the share of the
// load against it that it bears.
Vec2 unsupported(Vec2 p_load, Vec2 p_support) {
	const Real share = length(p_support);
	return share > 0 ? p_load - p_support * (std::min(dot(p_load, p_support), Real(0)) / share) : p_load;
}

bool is_touch(const Reaction &p_reaction) {
	return p_reaction.impulse != Vec2{} || p_reaction.angular_impulse != 0;
}

} // namespace

void BodyRecord::poll_rigid(PhysicsDirectBodyState2D *p_state, double p_delta) {
	RigidBody body;
	body.tag = object_id_;
	body.pose = to_core_pose(transform_);
	body.center_of_mass = to_core(scale_.xform(p_state->get_center_of_mass_local()));
	body.inverse_mass = Real(p_state->get_inverse_mass());
	body.inverse_inertia = Real(p_state->get_inverse_inertia());
	const bool is_woken = was_rigid_ && is_sleeping_ && !p_state->is_sleeping();
	const Vec2 velocity = to_core(p_state->get_linear_velocity()); // before it is changed, at once or in a queue
	const Vec2 carried = is_woken ? take_back_fall(p_delta) : Vec2{};
	body.pose.position += carried * Real(p_delta);
	weight_ = to_core(p_state->get_total_gravity() + p_state->get_constant_force() * p_state->get_inverse_mass());
	is_sleeping_ = p_state->is_sleeping();
	body.asleep = is_sleeping_;
	if (is_sleeping_ && was_rigid_) { // its support is the one with which it fell asleep
		body.support = rigid_body_.support;
		body.turn_support = rigid_body_.turn_support;
	} else if (is_sleeping_) { // without support it would fall
		const Real pull = length(weight_);
		body.support = pull > 0 ? weight_ * (-1 / pull) : Vec2{};
		body.turn_support = pull > 0 ? Real(1) : Real(0);
	} else {
		body.linear_velocity = velocity + carried;
		body.angular_velocity = Real(p_state->get_angular_velocity());
		if (is_woken) { // nothing was handed over from which a support could be told
			body.support = rigid_body_.support;
			body.turn_support = rigid_body_.turn_support;
		} else if (was_rigid_) {
			estimate_support(p_state, p_delta, body);
		}
	}
	body.acceleration = unsupported(weight_, body.support); // which makes it fall
	rigid_body_ = body;
	was_rigid_ = true;
}

// A body that something else wakes in the engine's step falls in it, as soft bodies hand nothing over to a sleeping one.
// Returns the velocity that was taken back.
Vec2 BodyRecord::take_back_fall(double p_delta) {
	if (!last_reaction_.beside_sleeper && !is_touch(last_reaction_)) {
		return {};
	}
	const Vec2 carried = unsupported(weight_, rigid_body_.support) * Real(-p_delta);
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	const Vector2 velocity = server->body_get_state(rid_, PhysicsServer2D::BODY_STATE_LINEAR_VELOCITY);
	transform_.set_origin(transform_.get_origin() + to_godot(carried * Real(p_delta)));
	server->body_set_state(rid_, PhysicsServer2D::BODY_STATE_TRANSFORM, transform_);
	server->body_set_state(rid_, PhysicsServer2D::BODY_STATE_LINEAR_VELOCITY, velocity + to_godot(carried));
	return carried;
}

Reaction BodyRecord::take_reaction(const Reaction &p_reaction, double p_delta) {
	const bool has_touched = is_touch(p_reaction) || is_touch(last_reaction_) || is_touch(withheld_) || last_reaction_.beside_sleeper;
	last_reaction_ = p_reaction;
	if (!is_sleeping_ || !(rigid_body_.inverse_mass > 0)) {
		withheld_ = {};
		return p_reaction;
	}
	if (p_reaction.beside_sleeper || !has_touched) {
		return {};
	}
	Vec2 load = unsupported(p_reaction.impulse + weight_ * (Real(p_delta) / rigid_body_.inverse_mass), rigid_body_.support);
	Real turn = p_reaction.angular_impulse * (1 - rigid_body_.turn_support);
	// It fell asleep slow, not in perfect balance.
	const Real tolerance = BALANCE_TOLERANCE * length(weight_) * Real(p_delta) / rigid_body_.inverse_mass;
	const Real pull = length(weight_);
	const Vec2 down = pull > 0 ? weight_ * (1 / pull) : Vec2{};
	const Real along = dot(load, down);
	if (std::abs(along) < tolerance && length(load - down * along) < tolerance * SIDEWAYS_TOLERANCE) {
		load = {};
	}
	if (std::abs(turn) * std::sqrt(rigid_body_.inverse_inertia / rigid_body_.inverse_mass) < tolerance) {
		turn = 0;
	}
	const Reaction before = withheld_;
	withheld_.impulse += load;
	withheld_.angular_impulse += turn;
	if (length(withheld_.impulse) * rigid_body_.inverse_mass < WAKING_SPEED &&
			std::abs(withheld_.angular_impulse) * rigid_body_.inverse_inertia < WAKING_SPIN) {
		return {};
	}
	// After waking, its weight and support act in the engine's step.
	withheld_ = {};
	is_sleeping_ = false;
	PhysicsServer2D::get_singleton()->body_set_state(rid_, PhysicsServer2D::BODY_STATE_SLEEPING, false);
	return { before.impulse + p_reaction.impulse, before.angular_impulse + p_reaction.angular_impulse };
}

// The engine wakes bodies near a body whose shapes change, though the two do not collide.
void BodyRecord::keep_asleep() {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	if (is_sleeping_ && is_there() && !bool(server->body_get_state(rid_, PhysicsServer2D::BODY_STATE_SLEEPING))) {
		server->body_set_state(rid_, PhysicsServer2D::BODY_STATE_SLEEPING, true);
	}
}

void BodyRecord::let_go() {
	const bool is_held = last_reaction_.beside_sleeper || is_touch(last_reaction_);
	if (is_sleeping_ && is_held && is_there()) {
		PhysicsServer2D::get_singleton()->body_set_state(rid_, PhysicsServer2D::BODY_STATE_SLEEPING, false);
	}
}

// The engine does not tell what a body rests on. But the expected gain of velocity in the last tick by its weight and
// by soft bodies is known, and so is the actual gain; the difference is the work of others. As far as it cancels the
// load, it is taken for a support that will do so again. Only the part against the weight counts: a second crate on top
// of one that lies on a soft body presses too, and is no support.
void BodyRecord::estimate_support(PhysicsDirectBodyState2D *p_state, double p_delta, RigidBody &r_body) const {
	const Real delta = Real(p_delta);
	const Vec2 weight = weight_ * delta;
	const Vec2 load = weight + last_reaction_.impulse * r_body.inverse_mass;
	const Real kept = std::max(Real(0), 1 - delta * Real(p_state->get_total_linear_damp()));
	const Vec2 free = (rigid_body_.linear_velocity + last_reaction_.impulse * r_body.inverse_mass) * kept + weight;
	const Vec2 help = r_body.linear_velocity - free;
	const Real strength = length(help);
	const Real pull = length(weight);
	if (!(strength > 0) || !(dot(help, weight) < Real(LEAST_SUPPORT) * -strength * pull)) {
		return;
	}
	const Vec2 direction = help * (1 / strength);
	const Real pressing = -dot(load, direction);
	if (!(pressing > 0)) {
		return;
	}
	const Real share = std::min(strength / pressing, Real(1));
	r_body.support = direction * share;
	// Support against turning, where soft bodies have tried to turn it; until then it is assumed.
	const Real turn = last_reaction_.angular_impulse * r_body.inverse_inertia;
	r_body.turn_support = share;
	if (std::abs(turn) > LEAST_TURN * delta) {
		const Real kept_turn = std::max(Real(0), 1 - delta * Real(p_state->get_total_angular_damp()));
		const Real help_turn = r_body.angular_velocity - (rigid_body_.angular_velocity + turn) * kept_turn;
		r_body.turn_support = std::clamp(-help_turn / turn, Real(0), Real(1));
	}
}

} // namespace softbody
