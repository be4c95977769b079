// SPDX-License-Identifier: MIT
// The resource: a material that soft bodies share.
#include "godot/resources/soft_body_material_2d.h"

#include "godot/convert.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

namespace godot {

String SoftBodyMaterial2D::describe() const {
	const String name = get_name().is_empty() ? get_path() : get_name();
	return name.is_empty() ? String("SoftBodyMaterial2D") : "SoftBodyMaterial2D '" + name + "'";
}

void SoftBodyMaterial2D::set_value(const softbody::MaterialField &p_field, double p_value) {
	if (const softbody::Status status = softbody::check_material_value(p_field, p_value)) {
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
	ERR_FAIL_INDEX_MSG(int(p_preset), softbody::MATERIAL_PRESET_COUNT, describe() + ": preset refused: " + itos(p_preset) + " must be at least 0 and below " + itos(softbody::MATERIAL_PRESET_COUNT) + "; use a constant PRESET_*.");
	softbody::MaterialValues changed = values_;
	softbody::apply_preset(softbody::MaterialPreset(p_preset), changed);
	take_over(changed);
}

void SoftBodyMaterial2D::set_network_values_set(bool p_set) {
	softbody::MaterialValues changed = values_;
	softbody::set_network_values_set(changed, p_set);
	take_over(changed);
}

// A value that an old resource sets under a former name still counts.
bool SoftBodyMaterial2D::_set(const StringName &p_name, const Variant &p_value) {
	static const StringName SHAPE_DAMPING = "shape_damping";
	if (p_name != SHAPE_DAMPING) {
		return unfit_.set(*this, get_class_static(), p_name, p_value);
	}
	if (!unfit_.set(*this, get_class_static(), "shape_damping_ratio", p_value)) {
		set_material_value<&softbody::MaterialValues::shape_damping_ratio>(p_value);
		unfit_.note_former(*this, p_name, "'shape_damping' is called 'shape_damping_ratio' now. Its value was taken over: save the resource to store it as 'shape_damping_ratio', and change scripts that name 'shape_damping'.");
	}
	return true;
}

bool SoftBodyMaterial2D::_get(const StringName &p_name, Variant &r_value) const {
	static const StringName SHAPE_DAMPING = "shape_damping";
	if (p_name == SHAPE_DAMPING) {
		r_value = values_.shape_damping_ratio;
		return true;
	}
	return unfit_.get(p_name, r_value);
}

void SoftBodyMaterial2D::_bind_methods() {
	ADD_GROUP("Material", "");
	softbody::bind_preset<SoftBodyMaterial2D>();
	softbody::bind_elastic_values<SoftBodyMaterial2D>();
	softbody::bind_surface_values<SoftBodyMaterial2D>();
	softbody::material_binding::bind<SoftBodyMaterial2D, &softbody::MaterialValues::inflation>();
	softbody::material_binding::bind<SoftBodyMaterial2D, &softbody::MaterialValues::density>();
	ADD_GROUP("Network", "");
	softbody::bind_network_values<SoftBodyMaterial2D>();
	ClassDB::bind_static_method("SoftBodyMaterial2D", D_METHOD("make_preset", "preset"), &SoftBodyMaterial2D::make_preset);

	BIND_ENUM_CONSTANT(PRESET_CUSTOM);
	BIND_ENUM_CONSTANT(PRESET_JELLY);
	BIND_ENUM_CONSTANT(PRESET_RUBBER);
	BIND_ENUM_CONSTANT(PRESET_WATER_BALLOON);
	BIND_ENUM_CONSTANT(PRESET_MARSHMALLOW);
	BIND_ENUM_CONSTANT(PRESET_FOAM);
}

} // namespace godot
