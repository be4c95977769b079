// SPDX-License-Identifier: MIT
// Setters of SoftBody2D that serve many properties, for the files that bind or call them.
#pragma once

#include "godot/nodes/soft_body_2d.h"

#include <cstddef>
#include <type_traits>
#include <utility>

namespace godot {

/// In the core's precision a huge or tiny value can be refused that its range allows: the body as a whole is asked, too.
template <auto VALUE>
void SoftBody2D::set_value(softbody::ValueOf<VALUE> p_value) {
	const ValueRule &rule = rule_of<VALUE>;
	if (!accept(rule.name, rule.range.check(rule.name, double(p_value)))) {
		return;
	}
	const softbody::ValueOf<VALUE> old = std::exchange(values_.*VALUE, p_value);
	if (rule.is_judged && !accept_values(rule.name)) {
		values_.*VALUE = old;
		return;
	}
	note_change();
	if (rule.effect != nullptr) {
		(this->*rule.effect)();
	}
}

/// Lets the body go on as it is deformed where its points stay. Other points make another body.
template <auto VALUE>
void SoftBody2D::set_structure(softbody::ValueOf<VALUE> p_value) {
	using Value = softbody::ValueOf<VALUE>;
	constexpr bool IS_SWITCH = std::is_same_v<Value, bool>;
	const char *name = rule_of<VALUE>.name;
	if ((IS_SWITCH && p_value == get_structure<VALUE>()) || !accept(name, softbody::BodyStructure::check(name, p_value))) {
		return;
	}
	const Value old = structure_.exchange<VALUE>(p_value);
	if (!take_over_structure(name, IS_SWITCH || std::is_same_v<Value, PackedVector2Array>)) {
		structure_.exchange<VALUE>(old);
	}
}

/// Another hull makes another body, which lies and moves as the old one is drawn.
template <auto VALUE>
void SoftBody2D::set_detail(softbody::ValueOf<VALUE> p_value) {
	const ValueRule &rule = rule_of<VALUE>;
	softbody::Status status;
	if constexpr (std::is_same_v<softbody::ValueOf<VALUE>, PackedFloat32Array>) {
		status = softbody::check_detail_weights(rule.name, { p_value.ptr(), std::size_t(p_value.size()) });
	} else {
		status = rule.range.check(rule.name, double(p_value));
	}
	if (p_value == get_detail<VALUE>() || !accept(rule.name, status)) {
		return;
	}
	const softbody::DrawnMotion before = drawn_motion();
	const softbody::ValueOf<VALUE> old = structure_.exchange_detail<VALUE>(p_value);
	if (take_over_structure(rule.name, true)) {
		take_over_motion(before);
	} else {
		structure_.exchange_detail<VALUE>(old);
	}
	notify_property_list_changed();
}

template <auto VALUE>
void SoftBody2D::set_scale_of_spring(int p_index, double p_scale) {
	if (find_spring(p_index) == nullptr) {
		return;
	}
	PackedFloat32Array scales = get_structure<VALUE>();
	if (scales.size() != get_spring_count()) {
		scales.resize(get_spring_count());
		scales.fill(1);
	}
	scales.set(p_index, float(p_scale));
	set_structure<VALUE>(scales);
}

template <auto VALUE>
void SoftBody2D::set_style(softbody::ValueOf<VALUE> p_value) {
	using Value = softbody::ValueOf<VALUE>;
	constexpr bool IS_ARRAY = std::is_same_v<Value, PackedVector2Array> || std::is_same_v<Value, PackedColorArray>;
	const ValueRule &rule = rule_of<VALUE>;
	softbody::Status status;
	if constexpr (IS_ARRAY) {
		status = softbody::check_all_finite(rule.name, p_value);
	} else if constexpr (std::is_same_v<Value, double> || std::is_enum_v<Value>) {
		status = rule.range.check(rule.name, double(p_value));
	}
	if (!accept(rule.name, status)) {
		return;
	}
	listen_to_textures(false);
	skin_.change_style().*VALUE = p_value;
	listen_to_textures(true);
	remake_skin();
	if (IS_ARRAY || std::is_same_v<Value, PackedInt32Array>) { // of another size than the polygon
		update_configuration_warnings();
	}
}

template <auto VALUE>
softbody::ValueOf<VALUE> SoftBody2D::get_contact_value(int p_index) const {
	const softbody::ContactReports::Record *contact = find_contact(p_index);
	return contact != nullptr ? contact->*VALUE : softbody::ValueOf<VALUE>();
}

} // namespace godot

VARIANT_ENUM_CAST(SoftBody2D::Integrator);
VARIANT_ENUM_CAST(SoftBody2D::ElasticModel);
VARIANT_ENUM_CAST(SoftBody2D::OutlineTextureMode);
VARIANT_ENUM_CAST(SoftBody2D::Look);
VARIANT_ENUM_CAST(SoftBody2D::MassMode);
VARIANT_ENUM_CAST(SoftBody2D::DampMode);
VARIANT_ENUM_CAST(SoftBody2D::FailureMode);
VARIANT_ENUM_CAST(SoftBody2D::DisableMode);
VARIANT_ENUM_CAST(SoftBody2D::SelfCollision);
VARIANT_ENUM_CAST(SoftBody2D::DentBy);
VARIANT_ENUM_CAST(SoftBody2D::DetailMode);
