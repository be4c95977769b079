// SPDX-License-Identifier: MIT
// The node's properties: checked, kept, and handed on to the core.
#include "godot/nodes/soft_body_2d.h"

#include "core/base/constants.h"
#include "core/model/material.h"
#include "godot/convert.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <cmath>
#include <optional>
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
	const String message = to_godot(*p_status);
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
	const double old = std::exchange(r_member, p_value);
	if (!accept_values(p_property)) {
		r_member = old;
		return false;
	}
	return true;
}

// Whether a body can be built from the present values; if not, `p_property` is to blame.
bool SoftBody2D::accept_shape(const StringName &p_property) {
	const bool is_draft = body() == nullptr;
	auto design = make_design(design_transform(), is_draft);
	if (!accept(p_property, design ? softbody::Status() : softbody::Status(design.error()))) {
		return false;
	}
	if (is_draft) {
		design_.reset(); // what is asked for it makes it
	} else {
		design_ = std::move(design.value());
	}
	return true;
}

// Whether the values that are not the structure's make no other shape of it.
bool SoftBody2D::is_current(const Design &p_design) const {
	return !p_design.model_problem && p_design.wanted.model == choose_model().model && p_design.mass == mass_of_area(p_design.area);
}

// Whether the body can have the present values; if not, `p_property` is to blame. Springs and points are made anew only when
// other masses or another model of elasticity need them to be.
bool SoftBody2D::accept_values(const StringName &p_property) {
	const bool keeps_shape = design_ && is_current(*design_);
	if (body() == nullptr && !keeps_shape) {
		design_.reset();
		const auto draft = make_design(design_transform(), true);
		const auto settings = draft ? make_settings(draft.value()) : softbody::Result<softbody::BodySettings>(draft.error());
		return accept(p_property, settings ? softbody::Status() : softbody::Status(settings.error()));
	}
	const std::optional<Design> kept = design_;
	if (!keeps_shape) {
		auto made = make_design(design_transform());
		// A model that does not fit is this property's fault, unless it did not fit before.
		const bool is_worse = made && made.value().model_problem && !(kept && kept->model_problem);
		const softbody::Status problem = !made ? softbody::Status(made.error()) : is_worse ? made.value().model_problem : softbody::Status();
		if (!accept(p_property, problem)) {
			return false;
		}
		design_ = std::move(made.value());
	} else {
		const ModelChoice choice = choose_model(); // the same model, perhaps for another reason
		design_->wanted = choice;
		design_->used = choice;
	}
	const auto settings = make_settings(*design_);
	if (!accept(p_property, settings ? softbody::Status() : softbody::Status(settings.error()))) {
		design_ = kept;
		return false;
	}
	return true;
}

void SoftBody2D::set_mass(double p_mass) {
	if (change("mass", mass_, p_mass, softbody::check_above("mass", p_mass, 0, "kg"))) {
		apply_shape();
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

namespace {

bool is_layer_number(int p_number, const char *p_what) {
	ERR_FAIL_COND_V_MSG(p_number < 1 || p_number > 32, false, vformat("Collision %s number must be between 1 and 32 inclusive.", p_what));
	return true;
}

uint32_t with_bit(uint32_t p_bits, int p_number, bool p_value) {
	const uint32_t bit = 1u << (p_number - 1);
	return p_value ? p_bits | bit : p_bits & ~bit;
}

} // namespace

void SoftBody2D::set_collision_layer_value(int p_layer_number, bool p_value) {
	if (is_layer_number(p_layer_number, "layer")) {
		set_collision_layer(with_bit(collision_layer_, p_layer_number, p_value));
	}
}

bool SoftBody2D::get_collision_layer_value(int p_layer_number) const {
	return is_layer_number(p_layer_number, "layer") && (collision_layer_ & (1u << (p_layer_number - 1))) != 0;
}

void SoftBody2D::set_collision_mask_value(int p_layer_number, bool p_value) {
	if (is_layer_number(p_layer_number, "mask")) {
		set_collision_mask(with_bit(collision_mask_, p_layer_number, p_value));
	}
}

bool SoftBody2D::get_collision_mask_value(int p_layer_number) const {
	return is_layer_number(p_layer_number, "mask") && (collision_mask_ & (1u << (p_layer_number - 1))) != 0;
}

void SoftBody2D::set_self_collision(SelfCollision p_self_collision) {
	if (accept("self_collision", softbody::check_between("self_collision", p_self_collision, SELF_COLLISION_OFF, SELF_COLLISION_AUTOMATIC, ""))) {
		self_collision_ = p_self_collision;
		apply_settings();
	}
}

bool SoftBody2D::has_self_collision() const {
	const Design *found = design();
	return self_collision_ == SELF_COLLISION_ON || (self_collision_ == SELF_COLLISION_AUTOMATIC && found != nullptr && found->has_deep_dents);
}

// From properties to the core.

// Refuses as a whole what is fine one by one: rates of springs that leave the range of numbers.
softbody::Status SoftBody2D::apply_elasticity(const Design &p_design, softbody::BodySettings &r_settings) const {
	const softbody::MaterialValues &material = material_values();
	const softbody::SoftBodyShape &shape = *p_design.shape;
	if (p_design.used.model == ELASTIC_MODEL_NETWORK) {
		const double point_mass = p_design.mass / double(shape.point_count());
		const double shape_stiffness = material.shape_matching * material.stiffness;
		r_settings.spring_stiffness_scale = softbody::Real(material.stiffness);
		r_settings.spring_damping_scale = softbody::Real(material.damping);
		r_settings.shape_stiffness = softbody::Real(shape_stiffness);
		// The shape-matching oscillator of one point has the frequency sqrt(k_s/m): c = 2 ζ sqrt(k_s m).
		r_settings.shape_damping = softbody::Real(2 * material.shape_damping_ratio * std::sqrt(shape_stiffness * point_mass));
	} else if ((p_design.used.model == ELASTIC_MODEL_MODES && shape.modes() == nullptr) ||
			(p_design.used.model == ELASTIC_MODEL_TRIANGLES && shape.triangles() == nullptr)) { // of a draft
		return softbody::check_material(softbody::to_material(material));
	} else {
		const auto model = softbody::ElasticModel(p_design.used.model - ELASTIC_MODEL_SPRINGS);
		if (softbody::Status status = softbody::apply_material(softbody::to_material(material), model, shape, r_settings)) {
			return status;
		}
	}
	const auto check_rate = [](const char *p_name, softbody::Real p_scale, softbody::Real p_rate, const char *p_remedy) {
		const bool fits = std::isfinite(p_scale * p_rate);
		return fits ? softbody::Status() : softbody::Error{ p_name, "too large for the masses", "must stay within the range of numbers", p_remedy };
	};
	if (softbody::Status status = check_rate("stiffness", r_settings.spring_stiffness_scale, shape.spring_frequency_squared(), "give less stiffness or more mass")) {
		return status;
	}
	return check_rate("damping", r_settings.spring_damping_scale, shape.spring_damping_rate(), "give less damping or more mass");
}

softbody::Status SoftBody2D::check_elasticity(const Design &p_design) const {
	softbody::BodySettings settings;
	return apply_elasticity(p_design, settings);
}

softbody::Result<softbody::BodySettings> SoftBody2D::make_settings(const Design &p_design) const {
	softbody::BodySettings settings;
	const softbody::MaterialValues &material = material_values();
	settings.pressure_stiffness = softbody::Real(material.pressure);
	settings.least_area = softbody::Real(least_area_);
	settings.least_stretch = softbody::Real(least_stretch_);
	settings.most_stretch = softbody::Real(most_stretch_);
	settings.inflation = softbody::Real(material.inflation);
	const Surface surface_values = surface();
	settings.friction = softbody::Real(surface_values.friction);
	settings.rough = surface_values.rough;
	settings.restitution = softbody::Real(surface_values.bounce);
	settings.absorbent = surface_values.absorbent;
	settings.rolling_resistance = softbody::Real(material.rolling_resistance);
	settings.gravity_scale = softbody::Real(gravity_scale_);
	settings.integrator = softbody::Integrator(integrator_);
	settings.substeps = substeps_ != 0 ? substeps_ : SoftBodySimulation2D::get_singleton()->settings().substeps;
	settings.collision_layer = collision_layer_;
	settings.collision_mask = collision_mask_;
	settings.can_sleep = can_sleep_;
	settings.contact_monitor = contact_monitor_;
	settings.self_collision = self_collision_ == SELF_COLLISION_ON || (self_collision_ == SELF_COLLISION_AUTOMATIC && p_design.has_deep_dents);
	settings.failure_response = failure_mode_ == FAILURE_MODE_FREEZE ? softbody::FailureResponse::FREEZE : softbody::FailureResponse::RESET;
	if (const softbody::SoftBodyData *found = body()) { // Of areas, too: `feel_areas` sets them.
		settings.linear_damp = found->settings().linear_damp;
		settings.angular_damp = found->settings().angular_damp;
	}
	if (softbody::Status status = apply_elasticity(p_design, settings)) {
		return *status;
	}
	if (softbody::Status status = softbody::check_settings(settings)) {
		return *status;
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
	softbody::SoftBodyData *found = body();
	note_change();
	if (found != nullptr && design() != nullptr) {
		const auto settings = make_settings(*design_);
		accept("settings", settings ? found->set_settings(settings.value()) : softbody::Status(settings.error()));
	}
	update_configuration_warnings();
}

// Hands the accepted design on. It has the body's scale. Where it has other points, the body takes its rest shape.
void SoftBody2D::apply_shape() {
	softbody::SoftBodyData *found = body();
	if (found != nullptr && design() != nullptr && found->point_count() != design_->shape->point_count()) {
		rebuild_body(true);
		update_configuration_warnings();
		return;
	}
	if (found != nullptr && design() != nullptr && found->shared_shape() != design_->shape) {
		accept("shape", found->set_shape(design_->shape));
	}
	apply_settings(); // which depend on the shape: a material on its modes, the damping of shape matching on its mass
}

void SoftBody2D::set_least_area(double p_share) {
	if (change("least_area", least_area_, p_share, softbody::check_between("least_area", p_share, 0, 1, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_least_stretch(double p_share) {
	if (change("least_stretch", least_stretch_, p_share, softbody::check_between("least_stretch", p_share, 0, 1, ""))) {
		apply_settings();
	}
}

void SoftBody2D::set_most_stretch(double p_share) {
	if (change("most_stretch", most_stretch_, p_share, softbody::check_at_least("most_stretch", p_share, 1, ""))) {
		apply_settings();
	}
}

void SoftBody2D::bind_limits() {
	ClassDB::bind_method(D_METHOD("set_least_area", "least_area"), &SoftBody2D::set_least_area);
	ClassDB::bind_method(D_METHOD("get_least_area"), &SoftBody2D::get_least_area);
	ClassDB::bind_method(D_METHOD("set_least_stretch", "least_stretch"), &SoftBody2D::set_least_stretch);
	ClassDB::bind_method(D_METHOD("get_least_stretch"), &SoftBody2D::get_least_stretch);
	ClassDB::bind_method(D_METHOD("set_most_stretch", "most_stretch"), &SoftBody2D::set_most_stretch);
	ClassDB::bind_method(D_METHOD("get_most_stretch"), &SoftBody2D::get_most_stretch);
}

void SoftBody2D::bind_mass() {
	ClassDB::bind_method(D_METHOD("set_mass", "mass"), &SoftBody2D::set_mass);
	ClassDB::bind_method(D_METHOD("get_mass"), &SoftBody2D::get_mass);
	ClassDB::bind_method(D_METHOD("set_gravity_scale", "gravity_scale"), &SoftBody2D::set_gravity_scale);
	ClassDB::bind_method(D_METHOD("get_gravity_scale"), &SoftBody2D::get_gravity_scale);
	ClassDB::bind_method(D_METHOD("get_total_mass"), &SoftBody2D::get_total_mass);
}

void SoftBody2D::bind_collision() {
	ClassDB::bind_method(D_METHOD("set_collision_layer", "layer"), &SoftBody2D::set_collision_layer);
	ClassDB::bind_method(D_METHOD("get_collision_layer"), &SoftBody2D::get_collision_layer);
	ClassDB::bind_method(D_METHOD("set_collision_mask", "mask"), &SoftBody2D::set_collision_mask);
	ClassDB::bind_method(D_METHOD("get_collision_mask"), &SoftBody2D::get_collision_mask);
	ClassDB::bind_method(D_METHOD("set_collision_layer_value", "layer_number", "value"), &SoftBody2D::set_collision_layer_value);
	ClassDB::bind_method(D_METHOD("get_collision_layer_value", "layer_number"), &SoftBody2D::get_collision_layer_value);
	ClassDB::bind_method(D_METHOD("set_collision_mask_value", "layer_number", "value"), &SoftBody2D::set_collision_mask_value);
	ClassDB::bind_method(D_METHOD("get_collision_mask_value", "layer_number"), &SoftBody2D::get_collision_mask_value);
	ClassDB::bind_method(D_METHOD("set_self_collision", "self_collision"), &SoftBody2D::set_self_collision);
	ClassDB::bind_method(D_METHOD("get_self_collision"), &SoftBody2D::get_self_collision);
	ClassDB::bind_method(D_METHOD("has_self_collision"), &SoftBody2D::has_self_collision);

	BIND_ENUM_CONSTANT(SELF_COLLISION_OFF);
	BIND_ENUM_CONSTANT(SELF_COLLISION_ON);
	BIND_ENUM_CONSTANT(SELF_COLLISION_AUTOMATIC);
}

void SoftBody2D::bind_solver() {
	ClassDB::bind_method(D_METHOD("set_integrator", "integrator"), &SoftBody2D::set_integrator);
	ClassDB::bind_method(D_METHOD("get_integrator"), &SoftBody2D::get_integrator);
	ClassDB::bind_method(D_METHOD("set_substeps", "substeps"), &SoftBody2D::set_substeps);
	ClassDB::bind_method(D_METHOD("get_substeps"), &SoftBody2D::get_substeps);

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
