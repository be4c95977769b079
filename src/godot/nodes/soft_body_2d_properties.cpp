// SPDX-License-Identifier: MIT
// The node's properties: checked, kept, and handed on to the core.
#include "godot/nodes/soft_body_2d.h"

#include "core/base/constants.h"
#include "core/creator/soft_body_creator.h"
#include "core/geometry/polygon.h"
#include "godot/convert.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <cmath>
#include <utility>
#include <vector>

using softbody::to_core;
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
bool SoftBody2D::change(const StringName &p_property, double &r_member, double p_value, const softbody::Status &p_range) {
	if (!accept(p_property, p_range)) {
		return false;
	}
	const double old = r_member;
	r_member = p_value;
	const softbody::Status status = softbody::check_settings(make_settings());
	const bool is_structure = &r_member == &mass_ || &r_member == &stiffness_ || &r_member == &damping_;
	if (!accept(p_property, status) || (is_structure && !accept_shape(p_property))) {
		r_member = old;
		return false;
	}
	return true;
}

// Whether a body can be built from the present values; if not, `p_property` is to blame.
bool SoftBody2D::accept_shape(const StringName &p_property) {
	const auto shape = make_shape(built_scale_);
	return accept(p_property, shape ? softbody::Status() : softbody::Status(shape.error()));
}

void SoftBody2D::set_hull(const PackedVector2Array &p_hull) {
	if (!accept("hull", softbody::check_hull(to_core(p_hull)))) {
		return;
	}
	const PackedVector2Array old = hull_;
	hull_ = p_hull;
	if (!accept_shape("hull")) {
		hull_ = old;
		return;
	}
	rebuild_body();
	update_configuration_warnings();
}

void SoftBody2D::set_mass(double p_mass) {
	if (change("mass", mass_, p_mass, softbody::check_above("mass", p_mass, 0, "kg"))) {
		apply_shape();
	}
}

void SoftBody2D::set_stiffness(double p_stiffness) {
	if (change("stiffness", stiffness_, p_stiffness, softbody::check_at_least("stiffness", p_stiffness, 0, "N/m"))) {
		apply_shape();
	}
}

void SoftBody2D::set_damping(double p_damping) {
	if (change("damping", damping_, p_damping, softbody::check_at_least("damping", p_damping, 0, "N·s/m"))) {
		apply_shape();
	}
}

void SoftBody2D::set_center_point(bool p_center_point) {
	if (center_point_ == p_center_point) {
		return;
	}
	center_point_ = p_center_point;
	if (!accept_shape("center_point")) {
		center_point_ = !p_center_point;
		return;
	}
	rebuild_body();
	update_configuration_warnings();
}

void SoftBody2D::set_pressure(double p_pressure) {
	if (change("pressure", pressure_, p_pressure, softbody::check_at_least("pressure", p_pressure, 0, "N/m"))) {
		apply_settings();
	}
}

void SoftBody2D::set_inflation(double p_inflation) {
	if (change("inflation", inflation_, p_inflation, softbody::check_at_least("inflation", p_inflation, 0, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_friction(double p_friction) {
	if (change("friction", friction_, p_friction, softbody::check_at_least("friction", p_friction, 0, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_bounce(double p_bounce) {
	if (change("bounce", bounce_, p_bounce, softbody::check_between("bounce", p_bounce, 0, 1, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_rolling_resistance(double p_rolling_resistance) {
	if (change("rolling_resistance", rolling_resistance_, p_rolling_resistance, softbody::check_at_least("rolling_resistance", p_rolling_resistance, 0, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_shape_matching(double p_shape_matching) {
	if (change("shape_matching", shape_matching_, p_shape_matching, softbody::check_at_least("shape_matching", p_shape_matching, 0, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_shape_damping(double p_shape_damping) {
	if (change("shape_damping", shape_damping_, p_shape_damping, softbody::check_at_least("shape_damping", p_shape_damping, 0, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_gravity_scale(double p_gravity_scale) {
	if (change("gravity_scale", gravity_scale_, p_gravity_scale, softbody::check_finite("gravity_scale", p_gravity_scale, ""))) {
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

void SoftBody2D::set_color(const Color &p_color) {
	color_ = p_color;
	queue_redraw();
}

void SoftBody2D::set_texture(const Ref<Texture2D> &p_texture) {
	texture_ = p_texture;
	queue_redraw();
}

// From properties to the core.

softbody::BodySettings SoftBody2D::make_settings() const {
	softbody::BodySettings settings;
	const double point_mass = mass_ / get_point_count();
	const double shape_stiffness = shape_matching_ * stiffness_;
	settings.shape_stiffness = softbody::Real(shape_stiffness);
	// The shape-matching oscillator of one point has the frequency sqrt(k_s/m): c = 2 ζ sqrt(k_s m).
	settings.shape_damping = softbody::Real(2 * shape_damping_ * std::sqrt(shape_stiffness * point_mass));
	settings.pressure_stiffness = softbody::Real(pressure_);
	settings.inflation = softbody::Real(inflation_);
	settings.friction = softbody::Real(friction_);
	settings.restitution = softbody::Real(bounce_);
	settings.rolling_resistance = softbody::Real(rolling_resistance_);
	settings.gravity_scale = softbody::Real(gravity_scale_);
	settings.integrator = softbody::Integrator(integrator_);
	settings.substeps = substeps_;
	settings.collision_layer = collision_layer_;
	settings.collision_mask = collision_mask_;
	if (const softbody::SoftBodyData *found = body()) { // Of areas, too: `feel_areas` sets them.
		settings.linear_damp = found->settings().linear_damp;
		settings.angular_damp = found->settings().angular_damp;
	}
	return settings;
}

softbody::Result<std::shared_ptr<const softbody::SoftBodyShape>> SoftBody2D::make_shape(
		const Transform2D &p_transform) const {
	std::vector<softbody::Vec2> points;
	const Transform2D scale = softbody::scale_and_skew(p_transform);
	for (const Vector2 &point : hull_) {
		points.push_back(to_core(scale.xform(point)));
	}
	softbody::StructureOptions options;
	options.mass = softbody::Real(mass_);
	options.stiffness = softbody::Real(stiffness_);
	options.damping = softbody::Real(damping_);
	options.centre_point = center_point_;
	return softbody::SoftBodyCreator::create_polygon(points, options);
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
		accept("settings", found->set_settings(make_settings()));
	}
	update_configuration_warnings();
}

void SoftBody2D::apply_shape() {
	if (softbody::SoftBodyData *found = body()) {
		const auto shape = make_shape(built_scale_);
		if (accept("shape", shape ? softbody::Status() : softbody::Status(shape.error()))) {
			accept("shape", found->set_shape(shape.value()));
		}
	}
	apply_settings(); // the damping of shape matching depends on stiffness and mass
}

void SoftBody2D::bind_shape() {
	ClassDB::bind_method(D_METHOD("set_hull", "hull"), &SoftBody2D::set_hull);
	ClassDB::bind_method(D_METHOD("get_hull"), &SoftBody2D::get_hull);
	ClassDB::bind_method(D_METHOD("set_mass", "mass"), &SoftBody2D::set_mass);
	ClassDB::bind_method(D_METHOD("get_mass"), &SoftBody2D::get_mass);
	ClassDB::bind_method(D_METHOD("set_gravity_scale", "gravity_scale"), &SoftBody2D::set_gravity_scale);
	ClassDB::bind_method(D_METHOD("get_gravity_scale"), &SoftBody2D::get_gravity_scale);
	ClassDB::bind_method(D_METHOD("set_center_point", "center_point"), &SoftBody2D::set_center_point);
	ClassDB::bind_method(D_METHOD("has_center_point"), &SoftBody2D::has_center_point);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_circle_hull", "radius", "point_count"), &SoftBody2D::make_circle_hull);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_box_hull", "size", "spacing"), &SoftBody2D::make_box_hull);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_capsule_hull", "radius", "height", "spacing"), &SoftBody2D::make_capsule_hull);

	ADD_PROPERTY(PropertyInfo(Variant::PACKED_VECTOR2_ARRAY, "hull", PROPERTY_HINT_NONE, "suffix:px"), "set_hull", "get_hull");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "mass", PROPERTY_HINT_RANGE, "0.001,1000,0.001,or_greater,exp,suffix:kg"), "set_mass", "get_mass");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "gravity_scale", PROPERTY_HINT_RANGE, "-8,8,0.001,or_less,or_greater"), "set_gravity_scale", "get_gravity_scale");

	ADD_GROUP("Structure", "");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "center_point"), "set_center_point", "has_center_point");
}

void SoftBody2D::bind_material() {
	ClassDB::bind_method(D_METHOD("set_stiffness", "stiffness"), &SoftBody2D::set_stiffness);
	ClassDB::bind_method(D_METHOD("get_stiffness"), &SoftBody2D::get_stiffness);
	ClassDB::bind_method(D_METHOD("set_damping", "damping"), &SoftBody2D::set_damping);
	ClassDB::bind_method(D_METHOD("get_damping"), &SoftBody2D::get_damping);
	ClassDB::bind_method(D_METHOD("set_shape_matching", "shape_matching"), &SoftBody2D::set_shape_matching);
	ClassDB::bind_method(D_METHOD("get_shape_matching"), &SoftBody2D::get_shape_matching);
	ClassDB::bind_method(D_METHOD("set_shape_damping", "shape_damping"), &SoftBody2D::set_shape_damping);
	ClassDB::bind_method(D_METHOD("get_shape_damping"), &SoftBody2D::get_shape_damping);
	ClassDB::bind_method(D_METHOD("set_pressure", "pressure"), &SoftBody2D::set_pressure);
	ClassDB::bind_method(D_METHOD("get_pressure"), &SoftBody2D::get_pressure);
	ClassDB::bind_method(D_METHOD("set_inflation", "inflation"), &SoftBody2D::set_inflation);
	ClassDB::bind_method(D_METHOD("get_inflation"), &SoftBody2D::get_inflation);
	ClassDB::bind_method(D_METHOD("set_friction", "friction"), &SoftBody2D::set_friction);
	ClassDB::bind_method(D_METHOD("get_friction"), &SoftBody2D::get_friction);
	ClassDB::bind_method(D_METHOD("set_bounce", "bounce"), &SoftBody2D::set_bounce);
	ClassDB::bind_method(D_METHOD("get_bounce"), &SoftBody2D::get_bounce);
	ClassDB::bind_method(D_METHOD("set_rolling_resistance", "rolling_resistance"), &SoftBody2D::set_rolling_resistance);
	ClassDB::bind_method(D_METHOD("get_rolling_resistance"), &SoftBody2D::get_rolling_resistance);

	ADD_GROUP("Material", "");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "stiffness", PROPERTY_HINT_RANGE, "0,10000,0.1,or_greater,exp,suffix:N/m"), "set_stiffness", "get_stiffness");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "damping", PROPERTY_HINT_RANGE, String::utf8("0,20,0.001,or_greater,suffix:N·s/m")), "set_damping", "get_damping");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "shape_matching", PROPERTY_HINT_RANGE, "0,2,0.01,or_greater"), "set_shape_matching", "get_shape_matching");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "shape_damping", PROPERTY_HINT_RANGE, "0,1,0.01,or_greater"), "set_shape_damping", "get_shape_damping");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "pressure", PROPERTY_HINT_RANGE, "0,10000,0.1,or_greater,exp,suffix:N/m"), "set_pressure", "get_pressure");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "inflation", PROPERTY_HINT_RANGE, "0,3,0.01,or_greater"), "set_inflation", "get_inflation");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "friction", PROPERTY_HINT_RANGE, "0,1,0.01,or_greater"), "set_friction", "get_friction");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "bounce", PROPERTY_HINT_RANGE, "0,1,0.01"), "set_bounce", "get_bounce");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "rolling_resistance", PROPERTY_HINT_RANGE, "0,1,0.001,or_greater"), "set_rolling_resistance", "get_rolling_resistance");
}

void SoftBody2D::bind_collision() {
	ClassDB::bind_method(D_METHOD("set_collision_layer", "layer"), &SoftBody2D::set_collision_layer);
	ClassDB::bind_method(D_METHOD("get_collision_layer"), &SoftBody2D::get_collision_layer);
	ClassDB::bind_method(D_METHOD("set_collision_mask", "mask"), &SoftBody2D::set_collision_mask);
	ClassDB::bind_method(D_METHOD("get_collision_mask"), &SoftBody2D::get_collision_mask);

	ADD_GROUP("Collision", "collision_");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_layer", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_layer", "get_collision_layer");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_mask", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_mask", "get_collision_mask");
}

void SoftBody2D::bind_solver() {
	ClassDB::bind_method(D_METHOD("set_integrator", "integrator"), &SoftBody2D::set_integrator);
	ClassDB::bind_method(D_METHOD("get_integrator"), &SoftBody2D::get_integrator);
	ClassDB::bind_method(D_METHOD("set_substeps", "substeps"), &SoftBody2D::set_substeps);
	ClassDB::bind_method(D_METHOD("get_substeps"), &SoftBody2D::get_substeps);
	ClassDB::bind_method(D_METHOD("get_substep_plan"), &SoftBody2D::get_substep_plan);

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
