// SPDX-License-Identifier: MIT
// The resource: a material that soft bodies share.
#include "godot/resources/soft_body_material_2d.h"

#include "godot/convert.h"
#include "godot/resources/material_binding.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

namespace godot {

String SoftBodyMaterial2D::describe() const {
	const String name = get_name().is_empty() ? get_path() : get_name();
	return name.is_empty() ? String("SoftBodyMaterial2D") : "SoftBodyMaterial2D '" + name + "'";
}

void SoftBodyMaterial2D::set_value(const softbody::MaterialField &p_field, double p_value) {
	if (const softbody::Status status = p_field.check(p_value)) {
		ERR_FAIL_MSG(describe() + ": " + p_field.name + " refused: " + softbody::to_godot(status->message()) + ". The old value stays.");
	}
	softbody::MaterialValues changed = values_;
	changed.*p_field.value = p_value;
	softbody::note_set(changed, p_field, !Engine::get_singleton()->is_editor_hint());
	take_over(changed);
}

void SoftBodyMaterial2D::take_over(const softbody::MaterialValues &p_values) {
	if (values_ != p_values) {
		values_ = p_values;
		emit_changed();
	}
}

Ref<SoftBodyMaterial2D> SoftBodyMaterial2D::make_preset(Preset p_preset) {
	Ref<SoftBodyMaterial2D> material;
	material.instantiate();
	material->set_preset(p_preset);
	return material;
}

void SoftBodyMaterial2D::set_preset(Preset p_preset) {
	ERR_FAIL_INDEX_MSG(int(p_preset), softbody::MaterialPresets::PRESET_COUNT, describe() + ": preset refused: " + itos(p_preset) + " must be at least 0 and below " + itos(softbody::MaterialPresets::PRESET_COUNT) + "; use a constant PRESET_*.");
	softbody::MaterialValues changed = values_;
	softbody::apply_preset(p_preset, changed);
	take_over(changed);
}

void SoftBodyMaterial2D::set_network_values_set(bool p_set) {
	softbody::MaterialValues changed = values_;
	softbody::set_network_values_set(changed, p_set);
	take_over(changed);
}

bool SoftBodyMaterial2D::_set(const StringName &p_name, const Variant &p_value) {
	return unfit_.set_former(*this, get_class_static(), p_name, p_value) || unfit_.set(*this, get_class_static(), p_name, p_value);
}

bool SoftBodyMaterial2D::_get(const StringName &p_name, Variant &r_value) const {
	return softbody::UnfitValues::get_former(*this, p_name, r_value) || unfit_.get(p_name, r_value);
}

void SoftBodyMaterial2D::_bind_methods() {
	using Values = softbody::MaterialValues;
	ADD_GROUP("Material", "");
	softbody::bind_preset<SoftBodyMaterial2D>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::youngs_modulus>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::poisson_ratio>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::damping_ratio>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::friction>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::bounce>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::rolling_resistance>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::inflation>();
	softbody::bind_material_value<SoftBodyMaterial2D, &Values::density>();
	ADD_GROUP("Dents and Tears", "");
	softbody::bind_damage_values<SoftBodyMaterial2D>();
	ADD_GROUP("Network", "");
	softbody::bind_network_values<SoftBodyMaterial2D>();
	ClassDB::bind_static_method("SoftBodyMaterial2D", D_METHOD("make_preset", "preset"), &SoftBodyMaterial2D::make_preset);

	softbody::bind_enumeration<SoftBodyMaterial2D>("Preset", { "PRESET_CUSTOM", "PRESET_JELLY", "PRESET_RUBBER", "PRESET_WATER_BALLOON", "PRESET_MARSHMALLOW", "PRESET_FOAM" });
}

} // namespace godot
