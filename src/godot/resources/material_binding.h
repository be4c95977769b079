// SPDX-License-Identifier: MIT
// Binds what a body is made of, alike for the node and for the resource.
#pragma once

#include "core/model/material_values.h"
#include "godot/resources/property_binding.h"

namespace softbody {

/// How the inspector shows each of `material_fields()`, for PROPERTY_HINT_RANGE.
inline constexpr const char *MATERIAL_HINTS[] = {
	"1,10000,0.1,or_greater,exp,suffix:N/m", // youngs_modulus
	"0,0.49,0.01", // poisson_ratio
	"0,2,0.01,or_greater", // damping_ratio
	"0,1,0.01,or_greater", // friction
	"0,1,0.01", // bounce
	"0,1,0.001,or_greater", // rolling_resistance
	"0,3,0.01,or_greater", // inflation
	"0,0.5,0.001,or_greater", // yield_strain
	"0,300,0.1,or_greater,suffix:1/s", // flow_rate
	"0,0.9,0.01", // max_dent
	"0,2,0.01,or_greater", // tear_stretch
	"0,10000,0.1,or_greater,exp,suffix:N/m", // stiffness
	"0,20,0.001,or_greater,suffix:N·s/m", // damping
	"0,2,0.01,or_greater", // shape_matching
	"0,1,0.01,or_greater", // shape_damping_ratio
	"0,10000,0.1,or_greater,exp,suffix:N/m", // pressure
	"0,10,0.01,or_greater,suffix:kg/m²", // density
};

/// Binds setter, getter and property of a value to `Class::set_material_value<…>` and `Class::get_material_value<…>`.
template <class Class, double MaterialValues::*VALUE>
void bind_material_value() {
	const std::size_t index = index_of(VALUE);
	bind_property(material_fields()[index].name, &Class::template set_material_value<VALUE>, &Class::template get_material_value<VALUE>, godot::PROPERTY_HINT_RANGE, MATERIAL_HINTS[index]);
}

/// What leaves dents, and what tears.
template <class Class>
void bind_damage_values() {
	using Values = MaterialValues;
	bind_material_value<Class, &Values::yield_strain>();
	bind_material_value<Class, &Values::flow_rate>();
	bind_material_value<Class, &Values::max_dent>();
	bind_material_value<Class, &Values::tear_stretch>();
}

template <class Class>
void bind_preset() {
	bind_property("preset", &Class::set_preset, &Class::get_preset, godot::PROPERTY_HINT_ENUM, "Custom,Jelly,Rubber,Water Balloon,Marshmallow,Foam", nullptr, nullptr, godot::PROPERTY_USAGE_EDITOR);
}

/// The raw values of the spring network, and after them a stored property that tells whether they count as set.
/// A scene does not store a value that equals its default: without that property, saving would forget that it was set. And
/// `duplicate` sets every stored property, whatever its value: the property comes last, so it takes that back.
template <class Class>
void bind_network_values() {
	using Values = MaterialValues;
	bind_material_value<Class, &Values::stiffness>();
	bind_material_value<Class, &Values::damping>();
	bind_material_value<Class, &Values::shape_matching>();
	bind_material_value<Class, &Values::shape_damping_ratio>();
	bind_material_value<Class, &Values::pressure>();
	bind_property("network_values_set", &Class::set_network_values_set, &Class::has_network_values, godot::PROPERTY_HINT_NONE, "", "has_network_values", nullptr, godot::PROPERTY_USAGE_NO_EDITOR);
	godot::ClassDB::bind_method(godot::D_METHOD("clear_network_values"), &Class::clear_network_values);
}

} // namespace softbody
