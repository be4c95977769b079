// SPDX-License-Identifier: MIT
// The node's properties: checked, kept, and handed on to the core.
#include "godot/nodes/soft_body_2d.h"

#include "core/base/constants.h"
#include "godot/convert.h"
#include "godot/server/soft_body_server_2d.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <cmath>
#include <utility>

using softbody::to_godot;

namespace godot {

bool SoftBody2D::accept(const StringName &p_property, const softbody::Status &p_status) {
	if (!p_status) {
		if (refused_.erase(p_property)) {
			update_configuration_warnings();
		}
		return true;
	}
	const String message = to_godot(p_status->message());
	refused_[p_property] = message;
	update_configuration_warnings();
	ERR_FAIL_V_MSG(false, describe() + ": " + String(p_property) + " refused: " + message + ". The old value stays.");
}

// Takes a number over if its own range and the body as a whole allow it: in the core's precision a huge or
// tiny value can be refused that looks fine here.
bool SoftBody2D::change(const StringName &p_property, double &r_member, double p_value, const softbody::Status &p_range,
		bool p_is_structural) {
	if (!accept(p_property, p_range)) {
		return false;
	}
	const double old = r_member;
	r_member = p_value;
	if (!accept(p_property, softbody::check_settings(make_settings(mass_in_use()))) || (p_is_structural && !accept_shape(p_property))) {
		r_member = old;
		return false;
	}
	return true;
}

// Whether a body can be built from the present values; if not, `p_property` is to blame.
bool SoftBody2D::accept_shape(const StringName &p_property) {
	auto design = make_design(design_transform());
	if (!accept(p_property, design ? softbody::Status() : softbody::Status(design.error()))) {
		return false;
	}
	design_ = std::move(design.value());
	return true;
}

void SoftBody2D::set_mass(double p_mass) {
	if (change("mass", mass_, p_mass, softbody::check_above("mass", p_mass, 0, "kg"), true)) {
		apply_shape();
	}
}

void SoftBody2D::set_gravity_scale(double p_gravity_scale) {
	if (change("gravity_scale", gravity_scale_, p_gravity_scale, softbody::check_finite("gravity_scale", p_gravity_scale, ""), false)) {
		apply_settings();
	}
}

void SoftBody2D::set_integrator(Integrator p_integrator) {
	if (accept("integrator", softbody::check_between("integrator", p_integrator, 0, softbody::INTEGRATOR_COUNT - 1, ""))) {
		integrator_ = p_integrator;
		apply_settings();
	}
}

void SoftBody2D::set_substeps(int p_substeps) {
	if (accept("substeps", softbody::check_between("substeps", p_substeps, 0, softbody::MAX_SUBSTEPS, ""))) {
		substeps_ = p_substeps;
		apply_settings();
	}
}

void SoftBody2D::set_collision_layer(uint32_t p_layer) {
	collision_layer_ = p_layer;
	proxy_.set_layer(p_layer);
	apply_settings();
}

void SoftBody2D::set_collision_mask(uint32_t p_mask) {
	collision_mask_ = p_mask;
	apply_settings();
}

void SoftBody2D::set_self_collision(bool p_self_collision) {
	self_collision_ = p_self_collision;
	apply_settings();
}

// From properties to the core.

softbody::BodySettings SoftBody2D::make_settings(double p_mass) const {
	softbody::BodySettings settings;
	const softbody::MaterialValues &material = material_values();
	const double point_mass = p_mass / get_point_count();
	const double shape_stiffness = material.shape_matching * material.stiffness;
	settings.shape_stiffness = softbody::Real(shape_stiffness);
	// The shape-matching oscillator of one point has the frequency sqrt(k_s/m): c = 2 ζ sqrt(k_s m).
	settings.shape_damping = softbody::Real(2 * material.shape_damping * std::sqrt(shape_stiffness * point_mass));
	settings.pressure_stiffness = softbody::Real(material.pressure);
	settings.inflation = softbody::Real(material.inflation);
	settings.friction = softbody::Real(material.friction);
	settings.restitution = softbody::Real(material.bounce);
	settings.rolling_resistance = softbody::Real(material.rolling_resistance);
	settings.gravity_scale = softbody::Real(gravity_scale_);
	settings.integrator = softbody::Integrator(integrator_);
	settings.substeps = substeps_ != 0 ? substeps_ : SoftBodyServer2D::get_singleton()->settings().substeps;
	settings.collision_layer = collision_layer_;
	settings.collision_mask = collision_mask_;
	settings.can_sleep = can_sleep_;
	settings.contact_monitor = contact_monitor_;
	settings.self_collision = self_collision_;
	settings.failure_response = failure_mode_ == FAILURE_MODE_FREEZE ? softbody::FailureResponse::FREEZE : softbody::FailureResponse::RESET;
	if (const softbody::SoftBodyData *found = body()) { // Of areas, too: `feel_areas` sets them.
		settings.linear_damp = found->settings().linear_damp;
		settings.angular_damp = found->settings().angular_damp;
	}
	return settings;
}

softbody::SoftBodyData *SoftBody2D::body() {
	return const_cast<softbody::SoftBodyData *>(std::as_const(*this).body());
}

const softbody::SoftBodyData *SoftBody2D::body() const {
	if (space_ != nullptr) {
		return std::as_const(*space_).world().find(body_id_);
	}
	return stored_body_ ? &*stored_body_ : nullptr;
}

void SoftBody2D::apply_settings() {
	if (softbody::SoftBodyData *found = body()) {
		accept("settings", found->set_settings(make_settings(mass_in_use())));
	}
	update_configuration_warnings();
}

// Hands the accepted design on. It has the body's scale, and as many points.
void SoftBody2D::apply_shape() {
	softbody::SoftBodyData *found = body();
	if (found != nullptr && design() != nullptr) {
		accept("shape", found->set_shape(design_->shape));
	}
	apply_settings(); // the damping of shape matching depends on stiffness and mass
}

void SoftBody2D::bind_mass() {
	ClassDB::bind_method(D_METHOD("set_mass", "mass"), &SoftBody2D::set_mass);
	ClassDB::bind_method(D_METHOD("get_mass"), &SoftBody2D::get_mass);
	ClassDB::bind_method(D_METHOD("set_gravity_scale", "gravity_scale"), &SoftBody2D::set_gravity_scale);
	ClassDB::bind_method(D_METHOD("get_gravity_scale"), &SoftBody2D::get_gravity_scale);
	ClassDB::bind_method(D_METHOD("get_total_mass"), &SoftBody2D::get_total_mass);

	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "mass", PROPERTY_HINT_RANGE, "0.001,1000,0.001,or_greater,exp,suffix:kg"), "set_mass", "get_mass");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "gravity_scale", PROPERTY_HINT_RANGE, "-8,8,0.001,or_less,or_greater"), "set_gravity_scale", "get_gravity_scale");

}

void SoftBody2D::bind_collision() {
	ClassDB::bind_method(D_METHOD("set_collision_layer", "layer"), &SoftBody2D::set_collision_layer);
	ClassDB::bind_method(D_METHOD("get_collision_layer"), &SoftBody2D::get_collision_layer);
	ClassDB::bind_method(D_METHOD("set_collision_mask", "mask"), &SoftBody2D::set_collision_mask);
	ClassDB::bind_method(D_METHOD("get_collision_mask"), &SoftBody2D::get_collision_mask);
	ClassDB::bind_method(D_METHOD("set_self_collision", "self_collision"), &SoftBody2D::set_self_collision);
	ClassDB::bind_method(D_METHOD("has_self_collision"), &SoftBody2D::has_self_collision);

	ADD_GROUP("Collision", "");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_layer", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_layer", "get_collision_layer");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_mask", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_mask", "get_collision_mask");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "self_collision"), "set_self_collision", "has_self_collision");
}

void SoftBody2D::bind_solver() {
	ClassDB::bind_method(D_METHOD("set_integrator", "integrator"), &SoftBody2D::set_integrator);
	ClassDB::bind_method(D_METHOD("get_integrator"), &SoftBody2D::get_integrator);
	ClassDB::bind_method(D_METHOD("set_substeps", "substeps"), &SoftBody2D::set_substeps);
	ClassDB::bind_method(D_METHOD("get_substeps"), &SoftBody2D::get_substeps);

	ADD_GROUP("Solver", "");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "integrator", PROPERTY_HINT_ENUM, "Automatic,Explicit Euler,Semi-Implicit Euler,Midpoint,Heun,Runge-Kutta 4,Velocity Verlet,XPBD"), "set_integrator", "get_integrator");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "substeps", PROPERTY_HINT_RANGE, "0,64,1"), "set_substeps", "get_substeps");

	BIND_ENUM_CONSTANT(INTEGRATOR_AUTOMATIC);
	BIND_ENUM_CONSTANT(INTEGRATOR_EXPLICIT_EULER);
	BIND_ENUM_CONSTANT(INTEGRATOR_SEMI_IMPLICIT_EULER);
	BIND_ENUM_CONSTANT(INTEGRATOR_MIDPOINT);
	BIND_ENUM_CONSTANT(INTEGRATOR_HEUN);
	BIND_ENUM_CONSTANT(INTEGRATOR_RUNGE_KUTTA_4);
	BIND_ENUM_CONSTANT(INTEGRATOR_VELOCITY_VERLET);
	BIND_ENUM_CONSTANT(INTEGRATOR_XPBD);
}

} // namespace godot
