// SPDX-License-Identifier: MIT
// What the node is made of: its own values, or those of a material that it shares with others.
#include "godot/nodes/soft_body_2d.h"

#include "godot/convert.h"

#include <godot_cpp/core/class_db.hpp>

namespace godot {

void SoftBody2D::set_own_material_value(const softbody::MaterialField &p_field, double p_value) {
	if (change(p_field.name, own_material_.*p_field.value, p_value, softbody::check_material_value(p_field, p_value), p_field.is_structural) && material_.is_null()) {
		if (p_field.is_structural) {
			apply_shape();
		} else {
			apply_settings();
		}
	}
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
	if (accept("soft_body_material", softbody::check_settings(make_settings(mass_in_use()))) && accept_shape("soft_body_material")) {
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
	// A density is one of real things: per square metre, not per square pixel.
	constexpr double PIXELS = double(softbody::PIXELS_PER_METRE) * softbody::PIXELS_PER_METRE;
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
	if (p_property.name == StringName("mass") && density_decides_) {
		p_property.usage |= PROPERTY_USAGE_READ_ONLY;
	}
}

void SoftBody2D::bind_material() {
	ADD_GROUP("Material", "");
	ClassDB::bind_method(D_METHOD("set_soft_body_material", "material"), &SoftBody2D::set_soft_body_material);
	ClassDB::bind_method(D_METHOD("get_soft_body_material"), &SoftBody2D::get_soft_body_material);
	ADD_PROPERTY(PropertyInfo(Variant::OBJECT, "soft_body_material", PROPERTY_HINT_RESOURCE_TYPE, "SoftBodyMaterial2D"), "set_soft_body_material", "get_soft_body_material");
	softbody::bind_material_values<SoftBody2D>(false);
	ClassDB::bind_method(D_METHOD("_take_over_material"), &SoftBody2D::take_over_material);
}

} // namespace godot
