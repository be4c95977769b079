// SPDX-License-Identifier: MIT
// What the node is made of: its own values, or those of a material that it shares with others.
#include "godot/nodes/soft_body_2d.h"

#include "core/model/model_choice.h"
#include "godot/convert.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>

#include <utility>

namespace godot {

namespace {

const char *const REASON_CHOSEN = "chosen";
const char *const REASON_OWN_SPRINGS = "own_springs";
const char *const REASON_PAINTED_SPRINGS = "painted_springs";
const char *const REASON_MATERIAL = "material";

} // namespace

const char *const SoftBody2D::REASON_NETWORK_VALUES = "network_values";

// A scene and a script mean what they set; what is edited in the inspector counts while it differs from the default, so that
// it can be taken back.
void SoftBody2D::set_own_material_value(const softbody::MaterialField &p_field, double p_value) {
	const StringName property = p_field.name;
	if (!accept(property, softbody::check_material_value(p_field, p_value))) {
		return;
	}
	softbody::MaterialValues changed = own_material_;
	changed.*p_field.value = p_value;
	softbody::note_set(changed, p_field, !Engine::get_singleton()->is_editor_hint() || !is_inside_tree());
	take_over_own_values(property, changed);
}

bool SoftBody2D::take_over_own_values(const StringName &p_property, const softbody::MaterialValues &p_values) {
	const softbody::MaterialValues old = std::exchange(own_material_, p_values);
	if (material_.is_valid()) {
		return true;
	}
	if (!accept_values(p_property)) {
		own_material_ = old;
		return false;
	}
	apply_shape();
	return true;
}

void SoftBody2D::set_network_values_set(bool p_set) {
	softbody::MaterialValues changed = own_material_;
	softbody::set_network_values_set(changed, p_set);
	take_over_own_values("elastic_model", changed);
}

void SoftBody2D::set_elastic_model(ElasticModel p_model) {
	if (!accept("elastic_model", softbody::check_between("elastic_model", p_model, 0, ELASTIC_MODEL_COUNT - 1, ""))) {
		return;
	}
	const ElasticModel old = std::exchange(elastic_model_, p_model);
	if (!accept_values("elastic_model")) {
		elastic_model_ = old;
		return;
	}
	apply_shape();
}

// By the properties alone, so that the order in which they were set does not count.
SoftBody2D::ModelChoice SoftBody2D::choose_model() const {
	if (elastic_model_ != ELASTIC_MODEL_AUTOMATIC) {
		return { elastic_model_, REASON_CHOSEN };
	}
	if (!springs_.is_empty()) {
		return { ELASTIC_MODEL_NETWORK, REASON_OWN_SPRINGS };
	}
	if (!spring_stiffness_scales_.is_empty() || !spring_damping_scales_.is_empty() || !spring_length_scales_.is_empty()) {
		return { ELASTIC_MODEL_NETWORK, REASON_PAINTED_SPRINGS };
	}
	if (material_values().has_network_values) {
		return { ELASTIC_MODEL_NETWORK, REASON_NETWORK_VALUES };
	}
	return { ElasticModel(ELASTIC_MODEL_SPRINGS + int(softbody::choose_elastic_model(std::size_t(polygon_.size())))), REASON_MATERIAL };
}

SoftBody2D::ElasticModel SoftBody2D::get_elastic_model_in_use() const {
	const ModelChoice choice = choose_model();
	if (!design_ && (choice.model == ELASTIC_MODEL_NETWORK || choice.model == ELASTIC_MODEL_MODES)) {
		return choice.model; // without the time that modes take; every outline has some
	}
	const Design *found = design();
	return found != nullptr ? found->used.model : choice.model;
}

void SoftBody2D::set_soft_body_material(const Ref<SoftBodyMaterial2D> &p_material) {
	if (p_material == material_) {
		return;
	}
	const Callable listener = own_callable("_take_over_material");
	if (material_.is_valid()) {
		material_->disconnect("changed", listener);
	}
	material_ = p_material;
	if (material_.is_valid() && !material_->is_connected("changed", listener)) {
		material_->connect("changed", listener);
	}
	take_over_material();
	notify_property_list_changed();
}

// Values that no body can have, like a density that overflows, are the material's fault: the body stays as it is.
void SoftBody2D::take_over_material() {
	if (accept_values("soft_body_material")) {
		apply_shape();
	}
	// Only when it matters: the inspector forgets a slider that is being dragged.
	const bool density_decides = material_values().density > 0;
	if (density_decides != density_decides_) {
		density_decides_ = density_decides;
		notify_property_list_changed();
	}
}

const softbody::MaterialValues &SoftBody2D::material_values() const {
	return material_.is_valid() ? material_->values() : own_material_;
}

double SoftBody2D::mass_of_area(double p_area) const {
	const double density = material_values().density;
	// A density is one of real things: per square meter, not per square pixel.
	constexpr double PIXELS = double(softbody::PIXELS_PER_METER) * softbody::PIXELS_PER_METER;
	return density > 0 ? density * p_area / PIXELS : mass_;
}

double SoftBody2D::mass_in_use() const {
	const Design *found = design();
	return found != nullptr ? found->mass : mass_;
}

// What a material overrides is shown, not edited; it is saved, so that nothing is lost when the material goes.
void SoftBody2D::_validate_property(PropertyInfo &p_property) const {
	if (material_.is_null()) {
		return;
	}
	for (const softbody::MaterialField &field : softbody::material_fields()) {
		if (p_property.name == StringName(field.name)) {
			p_property.usage |= PROPERTY_USAGE_READ_ONLY;
		}
	}
	if (p_property.name == StringName("preset") || (p_property.name == StringName("mass") && density_decides_)) {
		p_property.usage |= PROPERTY_USAGE_READ_ONLY;
	}
}

void SoftBody2D::bind_material() {
	ClassDB::bind_method(D_METHOD("set_soft_body_material", "material"), &SoftBody2D::set_soft_body_material);
	ClassDB::bind_method(D_METHOD("get_soft_body_material"), &SoftBody2D::get_soft_body_material);
	ClassDB::bind_method(D_METHOD("_take_over_material"), &SoftBody2D::take_over_material);
}

void SoftBody2D::bind_network() {
	ClassDB::bind_method(D_METHOD("set_elastic_model", "elastic_model"), &SoftBody2D::set_elastic_model);
	ClassDB::bind_method(D_METHOD("get_elastic_model"), &SoftBody2D::get_elastic_model);
	ClassDB::bind_method(D_METHOD("get_elastic_model_in_use"), &SoftBody2D::get_elastic_model_in_use);

	bind_springs();

	BIND_ENUM_CONSTANT(ELASTIC_MODEL_AUTOMATIC);
	BIND_ENUM_CONSTANT(ELASTIC_MODEL_NETWORK);
	BIND_ENUM_CONSTANT(ELASTIC_MODEL_SPRINGS);
	BIND_ENUM_CONSTANT(ELASTIC_MODEL_SPRINGS_AND_SHAPE);
	BIND_ENUM_CONSTANT(ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA);
	BIND_ENUM_CONSTANT(ELASTIC_MODEL_MODES);
	BIND_ENUM_CONSTANT(ELASTIC_MODEL_TRIANGLES);
}

} // namespace godot
