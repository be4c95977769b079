// SPDX-License-Identifier: MIT
// The body as a whole: how it moves and what pushes it, in the words of RigidBody2D.
#include "godot/nodes/soft_body_2d.h"

#include "core/dynamics/energy.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "godot/convert.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/math.hpp>

#include <cmath>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

// Part of a turn of a body with locked rotation that a step takes back. More: a body that contacts turn trembles.
constexpr double LOCK_RETURN = 0.6;
// Turn and spin [rad/s] that are left alone, so that the body comes to rest.
constexpr double LOCK_CALM = 0.003;
// Turn beyond which it is taken back at once.
constexpr double LOCK_TOLERANCE = 0.03;

softbody::Status check_velocity(const char *p_name, bool p_is_finite) {
	if (p_is_finite) {
		return {};
	}
	return softbody::Error{ p_name, "non-finite", "must be finite", "check the computation that produced this value" };
}

} // namespace

// Velocities. Those of a body that is still to be made are kept for it.

void SoftBody2D::set_linear_velocity(const Vector2 &p_velocity) {
	if (!accept("linear_velocity", check_velocity("linear_velocity", p_velocity.is_finite()))) {
		return;
	}
	if (softbody::SoftBodyData *found = followed_body()) {
		accept("linear_velocity", softbody::set_linear_velocity(*found, to_core(p_velocity)));
	} else {
		first_linear_velocity_ = p_velocity;
	}
}

Vector2 SoftBody2D::get_linear_velocity() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? to_godot(softbody::measure_frame(*found).velocity) : first_linear_velocity_;
}

void SoftBody2D::set_angular_velocity(double p_velocity) {
	if (!accept("angular_velocity", check_velocity("angular_velocity", Math::is_finite(p_velocity)))) {
		return;
	}
	if (softbody::SoftBodyData *found = followed_body()) {
		accept("angular_velocity", softbody::set_angular_velocity(*found, softbody::Real(p_velocity)));
	} else {
		first_angular_velocity_ = p_velocity;
	}
}

double SoftBody2D::get_angular_velocity() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(softbody::measure_frame(*found).angular_velocity) : first_angular_velocity_;
}

void SoftBody2D::set_axis_velocity(const Vector2 &p_axis_velocity) {
	const Vector2 axis = p_axis_velocity.normalized();
	const Vector2 velocity = get_linear_velocity();
	set_linear_velocity(velocity - axis * axis.dot(velocity) + p_axis_velocity);
}

void SoftBody2D::start_first_motion() {
	softbody::SoftBodyData *found = body();
	if (found == nullptr) {
		return;
	}
	if (first_linear_velocity_ != Vector2()) {
		softbody::set_linear_velocity(*found, to_core(first_linear_velocity_));
	}
	if (first_angular_velocity_ != 0) {
		softbody::set_angular_velocity(*found, softbody::Real(first_angular_velocity_));
	}
	first_linear_velocity_ = Vector2();
	first_angular_velocity_ = 0;
}

// Impulses and forces. A position is an offset from the node's origin, in global axes, as RigidBody2D has it.

template <auto PUSH>
void SoftBody2D::push(const char *p_what, const Vector2 &p_push, const Vector2 *p_position) {
	if (check_index(0)) {
		softbody::SoftBodyData &target = *followed_body();
		const softbody::Vec2 place = p_position != nullptr ? to_core(get_global_position() + *p_position) : softbody::measure_frame(target).center;
		accept(p_what, PUSH(target, to_core(p_push), place));
	}
}

void SoftBody2D::apply_impulse(const Vector2 &p_impulse, const Vector2 &p_position) {
	push<softbody::apply_rigid_impulse>("impulse", p_impulse, &p_position);
}

void SoftBody2D::apply_central_impulse(const Vector2 &p_impulse) {
	push<softbody::apply_rigid_impulse>("impulse", p_impulse, nullptr);
}

void SoftBody2D::apply_force(const Vector2 &p_force, const Vector2 &p_position) {
	push<softbody::add_rigid_force>("force", p_force, &p_position);
}

void SoftBody2D::apply_central_force(const Vector2 &p_force) {
	push<softbody::add_rigid_force>("force", p_force, nullptr);
}

void SoftBody2D::apply_torque_impulse(double p_torque) {
	if (check_index(0)) {
		accept("torque", softbody::apply_angular_impulse(*followed_body(), softbody::Real(p_torque)));
	}
}

void SoftBody2D::apply_torque(double p_torque) {
	if (check_index(0)) {
		accept("torque", softbody::add_torque(*followed_body(), softbody::Real(p_torque)));
	}
}

// Constant forces.

void SoftBody2D::set_constant_force(const Vector2 &p_force) {
	if (accept("constant_force", check_velocity("constant_force", p_force.is_finite()))) {
		constant_force_ = p_force;
	}
}

void SoftBody2D::set_constant_torque(double p_torque) {
	if (accept("constant_torque", check_velocity("constant_torque", Math::is_finite(p_torque)))) {
		constant_torque_ = p_torque;
	}
}

void SoftBody2D::add_constant_central_force(const Vector2 &p_force) {
	set_constant_force(constant_force_ + p_force);
}

void SoftBody2D::add_constant_force(const Vector2 &p_force, const Vector2 &p_position) {
	const Vector2 arm = p_position - (get_center_of_mass_position() - get_global_position());
	set_constant_force(constant_force_ + p_force);
	set_constant_torque(constant_torque_ + arm.cross(p_force));
}

void SoftBody2D::add_constant_torque(double p_torque) {
	set_constant_torque(constant_torque_ + p_torque);
}

void SoftBody2D::apply_constant_forces() {
	if (constant_force_ != Vector2()) {
		apply_central_force(constant_force_);
	}
	if (constant_torque_ != 0) {
		apply_torque(constant_torque_);
	}
}

Vector2 SoftBody2D::get_gravity() const {
	const softbody::SoftBodyData *found = followed_body();
	return found != nullptr && space_ != nullptr ? to_godot(found->total_acceleration(space_->world().gravity())) : Vector2();
}

// Locked rotation. It is the one that the user has given the node last.

void SoftBody2D::lock_rotation() {
	locked_rotation_ = softbody::angle_of(known_transform_);
	note_change();
}

double SoftBody2D::turned_by(const softbody::BodyFrame &p_frame) const {
	const bool is_locked = values_.lock_rotation && p_frame.rotation_defined && pins_.points().is_empty();
	return is_locked ? std::remainder(double(p_frame.rotation.angle()) - locked_rotation_, Math_TAU) : 0.0;
}

// A torque for the coming step, which takes the spin away and turns the body back softly: friction in the step meets a held body.
void SoftBody2D::hold_rotation(softbody::SoftBodyData &r_body, double p_delta) const {
	if (!values_.lock_rotation || !pins_.points().is_empty()) {
		return;
	}
	const softbody::BodyFrame frame = softbody::measure_frame(r_body);
	const double turned = turned_by(frame);
	if (std::abs(turned) < LOCK_CALM && std::abs(double(frame.angular_velocity)) < LOCK_CALM) {
		return;
	}
	const double wanted_spin = -LOCK_RETURN * turned / p_delta;
	r_body.queue_load({ {}, softbody::Real(double(frame.inertia) * (wanted_spin - double(frame.angular_velocity)) / p_delta) });
}

// What has turned the body far in one step is undone at once.
void SoftBody2D::undo_turn(softbody::SoftBodyData &r_body) const {
	if (!values_.lock_rotation) {
		return;
	}
	const softbody::BodyFrame frame = softbody::measure_frame(r_body);
	if (std::abs(turned_by(frame)) > LOCK_TOLERANCE) {
		r_body.teleport({ frame.center, frame.rotation }, { frame.center, softbody::Rotation::from_angle(softbody::Real(locked_rotation_)) });
		softbody::set_angular_velocity(r_body, 0);
	}
}

// Mass and place.

Vector2 SoftBody2D::get_center_of_mass_position() const {
	if (const softbody::SoftBodyData *found = followed_body()) {
		return to_godot(softbody::measure_frame(*found).center);
	}
	return (is_inside_tree() ? get_global_transform() : get_transform()).xform(get_center_of_mass());
}

Vector2 SoftBody2D::get_center_of_mass() const {
	if (const softbody::SoftBodyData *found = followed_body()) {
		return get_global_transform().affine_inverse().xform(to_godot(softbody::measure_frame(*found).center));
	}
	const Design *found = design();
	return found != nullptr ? found->scale.affine_inverse().xform(to_godot(found->shape->origin_offset())) : Vector2();
}

double SoftBody2D::get_inertia() const {
	if (const softbody::SoftBodyData *found = followed_body()) {
		return double(softbody::measure_frame(*found).inertia);
	}
	const Design *found = design();
	return found != nullptr ? double(found->shape->rest_inertia()) : 0.0;
}

double SoftBody2D::get_kinetic_energy() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? softbody::measure_energy(*found, {}).kinetic : 0.0;
}

void SoftBody2D::teleport(const Transform2D &p_transform) {
	ERR_FAIL_COND_MSG(!p_transform.is_finite() || p_transform.determinant() == 0, describe() + ": teleport: the transform must be finite and invertible.");
	if (is_inside_tree()) {
		set_global_transform(p_transform);
		take_over_transform();
		reset_physics_interpolation();
	} else {
		set_transform(p_transform);
	}
}

void SoftBody2D::reset() {
	rebuild_body(false);
}

} // namespace godot
