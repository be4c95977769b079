// SPDX-License-Identifier: MIT
// From the node's properties to the core: what is refused, and the settings of the body.
#include "godot/nodes/soft_body_2d.h"

#include "core/model/material.h"
#include "godot/convert.h"
#include "godot/nodes/rope_part.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/server/soft_body_space_2d.h"

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

softbody::Status SoftBody2D::apply_elasticity(const Design &p_design, softbody::BodySettings &r_settings) const {
	const softbody::MaterialValues &material = material_.values();
	const softbody::SoftBodyShape &shape = *p_design.shape;
	if (p_design.used.model == ELASTIC_MODEL_NETWORK) {
		return softbody::apply_network({ material.stiffness, material.damping, material.shape_matching, material.shape_damping_ratio }, p_design.mass, shape, r_settings);
	}
	const bool is_draft = (p_design.used.model == ELASTIC_MODEL_MODES && shape.modes() == nullptr) || (p_design.used.model == ELASTIC_MODEL_TRIANGLES && shape.triangles() == nullptr);
	if (is_draft) {
		return softbody::check_material(softbody::to_material(material));
	}
	const auto model = softbody::ElasticModel(p_design.used.model - ELASTIC_MODEL_SPRINGS);
	softbody::Material firm = softbody::to_material(material);
	firm.youngs_modulus = softbody::Real(material.youngs_modulus * firmness_of(p_design).factor);
	const softbody::Status status = softbody::apply_material(firm, model, shape, r_settings);
	return status ? status : softbody::check_spring_rates(r_settings, shape);
}

softbody::Status SoftBody2D::check_elasticity(const Design &p_design) const {
	softbody::BodySettings settings;
	return apply_elasticity(p_design, settings);
}

softbody::Result<softbody::BodySettings> SoftBody2D::make_settings(const Design &p_design) const {
	softbody::BodySettings settings;
	const softbody::MaterialValues &material = material_.values();
	settings.pressure_stiffness = softbody::Real(material.pressure);
	settings.least_area = softbody::Real(values_.least_area);
	settings.least_stretch = softbody::Real(values_.least_stretch);
	settings.most_stretch = softbody::Real(values_.most_stretch);
	settings.inflation = softbody::Real(material.inflation);
	settings.yield_strain = softbody::Real(material.yield_strain);
	settings.flow_rate = softbody::Real(material.flow_rate);
	settings.max_dent = softbody::Real(material.max_dent);
	settings.dent_by = softbody::DentBy(values_.dent_by);
	const softbody::BodyMaterial::Surface surface = material_.surface();
	settings.friction = softbody::Real(surface.friction);
	settings.rough = surface.rough;
	settings.restitution = softbody::Real(surface.bounce);
	settings.absorbent = surface.absorbent;
	settings.rolling_resistance = softbody::Real(material.rolling_resistance);
	settings.gravity_scale = softbody::Real(values_.gravity_scale);
	settings.integrator = softbody::Integrator(values_.integrator);
	settings.substeps = values_.substeps != 0 ? values_.substeps : SoftBodySimulation2D::get_singleton()->settings().substeps;
	settings.collision_layer = values_.collision_layer;
	settings.collision_mask = values_.collision_mask;
	settings.can_sleep = values_.can_sleep;
	settings.can_fly_rigid = !values_.important;
	settings.contact_monitor = values_.contact_monitor;
	settings.self_collision = uses_self_collision(p_design);
	settings.failure_response = values_.failure_mode == FAILURE_MODE_FREEZE ? softbody::FailureResponse::FREEZE : softbody::FailureResponse::RESET;
	if (const softbody::SoftBodyData *found = body()) { // Of areas, too: `feel_areas` sets them.
		settings.linear_damp = found->settings().linear_damp;
		settings.angular_damp = found->settings().angular_damp;
	}
	if (rope() != nullptr) {
		rope()->apply(settings);
	} else if (softbody::Status status = apply_elasticity(p_design, settings)) {
		return *status;
	}
	if (softbody::Status status = softbody::check_settings(settings)) {
		return *status;
	}
	return settings;
}

std::optional<softbody::BodySettings> SoftBody2D::present_settings() const {
	const Design *found = design();
	const auto settings = found != nullptr ? make_settings(*found) : softbody::Result<softbody::BodySettings>(softbody::Error{});
	return settings ? std::optional(settings.value()) : std::nullopt;
}

softbody::SoftBodyData *SoftBody2D::body() {
	return const_cast<softbody::SoftBodyData *>(std::as_const(*this).body());
}

const softbody::SoftBodyData *SoftBody2D::body() const {
	if (space_ != nullptr) {
		return std::as_const(*space_).world().find(body_id_);
	}
	return stored_body_.get();
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

} // namespace godot
