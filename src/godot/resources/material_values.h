// SPDX-License-Identifier: MIT
// What a body is made of, as numbers: one list of values, ranges and units for the node and for the resource.
#pragma once

#include "core/base/error.h"
#include "core/model/material.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/variant/string.hpp>

#include <span>

namespace softbody {

/// In the units of the inspector. The class reference of SoftBodyMaterial2D says what each does.
struct MaterialValues {
	double youngs_modulus = 300; ///< [N/m]
	double poisson_ratio = 0.45; ///< [1]
	double damping_ratio = 0.15; ///< [1]
	double stiffness = 100; ///< [N/m]
	double damping = 0.12; ///< [N·s/m]
	double shape_matching = 0.4; ///< share of the stiffness [1]
	double shape_damping_ratio = 0.25; ///< damping ratio [1]
	double pressure = 0; ///< [N/m]
	double inflation = 1; ///< [1]
	double friction = 0.4; ///< [1]
	double bounce = 0; ///< [1]
	double rolling_resistance = 0.03; ///< [1]
	double density = 0; ///< [kg/m²]; 0 leaves the mass to the node. Only resources have one.
	/// Whether one of the raw values of the spring network was set: stiffness, damping, shape matching, its damping, pressure.
	bool has_network_values = false;

	friend bool operator==(const MaterialValues &, const MaterialValues &) = default;
};

/// Materials with a name. A preset sets Young's modulus, Poisson's ratio, damping ratio, friction, bounce and rolling
/// resistance.
enum class MaterialPreset {
	CUSTOM, ///< none of the others; sets nothing
	JELLY, ///< the default values
	RUBBER,
	WATER_BALLOON,
	MARSHMALLOW,
	FOAM,
};
inline constexpr int MATERIAL_PRESET_COUNT = 6;
inline constexpr const char *MATERIAL_PRESET_NAMES = "Custom,Jelly,Rubber,Water Balloon,Marshmallow,Foam";

/// One of them: its name, range, and how the inspector shows it.
struct MaterialField {
	const char *name;
	double MaterialValues::*value;
	double maximum; ///< the minimum is 0, which Young's modulus excludes
	const char *unit;
	const char *hint; ///< of PROPERTY_HINT_RANGE
	bool is_of_network = false; ///< a raw value of the spring network
};

/// In the inspector's order; `density` is the last.
std::span<const MaterialField> material_fields();
const MaterialField &material_field(double MaterialValues::*value);

/// After `field` was set: whether the raw values of the network count as set. One that `sticks` counts whatever its value, as
/// a script or a scene has set it; else they count while one of them differs from its default, so that undo takes that back.
void note_set(MaterialValues &values, const MaterialField &field, bool sticks);
/// Whether the raw values count as set. If not, they get their defaults.
void set_network_values_set(MaterialValues &values, bool set);
/// Gives the raw values their defaults: none counts as set any more.
void clear_network_values(MaterialValues &values);
/// What `apply_material` takes.
Material to_material(const MaterialValues &values);

void apply_preset(MaterialPreset preset, MaterialValues &values);
/// The preset with these values, or CUSTOM. O(presets).
MaterialPreset preset_of(const MaterialValues &values);

/// Refuses what is out of range, also what is finite here and not in the core's precision.
Status check_material_value(const MaterialField &field, double value);

template <class Class>
void bind_preset();
/// Each binds setter, getter and property of its fields to `Class::set_material_value<…>` and `Class::get_material_value<…>`.
/// These are Young's modulus, Poisson's ratio and damping ratio.
template <class Class>
void bind_elastic_values();
/// Friction, bounce and rolling resistance.
template <class Class>
void bind_surface_values();
/// The raw values of the spring network, and after them a stored property that tells whether they count as set.
/// A scene does not store a value that equals its default: without that property, saving would forget that it was set. And
/// `duplicate` sets every stored property, whatever its value: the property comes last, so it takes that back.
template <class Class>
void bind_network_values();

namespace material_binding {

template <class Class, double MaterialValues::*VALUE>
void bind() {
	const MaterialField &field = material_field(VALUE);
	const godot::String name = field.name;
	const godot::String setter = "set_" + name;
	const godot::String getter = "get_" + name;
	godot::ClassDB::bind_method(godot::D_METHOD(setter, name), &Class::template set_material_value<VALUE>);
	godot::ClassDB::bind_method(godot::D_METHOD(getter), &Class::template get_material_value<VALUE>);
	godot::ClassDB::add_property(Class::get_class_static(),
			godot::PropertyInfo(godot::Variant::FLOAT, name, godot::PROPERTY_HINT_RANGE, godot::String::utf8(field.hint)),
			setter, getter);
}

} // namespace material_binding

template <class Class>
void bind_preset() {
	godot::ClassDB::bind_method(godot::D_METHOD("set_preset", "preset"), &Class::set_preset);
	godot::ClassDB::bind_method(godot::D_METHOD("get_preset"), &Class::get_preset);
	godot::ClassDB::add_property(Class::get_class_static(),
			godot::PropertyInfo(godot::Variant::INT, "preset", godot::PROPERTY_HINT_ENUM, MATERIAL_PRESET_NAMES, godot::PROPERTY_USAGE_EDITOR),
			"set_preset", "get_preset");
}

template <class Class>
void bind_elastic_values() {
	using Values = MaterialValues;
	material_binding::bind<Class, &Values::youngs_modulus>();
	material_binding::bind<Class, &Values::poisson_ratio>();
	material_binding::bind<Class, &Values::damping_ratio>();
}

template <class Class>
void bind_surface_values() {
	using Values = MaterialValues;
	material_binding::bind<Class, &Values::friction>();
	material_binding::bind<Class, &Values::bounce>();
	material_binding::bind<Class, &Values::rolling_resistance>();
}

template <class Class>
void bind_network_values() {
	using Values = MaterialValues;
	material_binding::bind<Class, &Values::stiffness>();
	material_binding::bind<Class, &Values::damping>();
	material_binding::bind<Class, &Values::shape_matching>();
	material_binding::bind<Class, &Values::shape_damping_ratio>();
	material_binding::bind<Class, &Values::pressure>();
	godot::ClassDB::bind_method(godot::D_METHOD("clear_network_values"), &Class::clear_network_values);
	godot::ClassDB::bind_method(godot::D_METHOD("has_network_values"), &Class::has_network_values);
	godot::ClassDB::bind_method(godot::D_METHOD("set_network_values_set", "set"), &Class::set_network_values_set);
	godot::ClassDB::add_property(Class::get_class_static(),
			godot::PropertyInfo(godot::Variant::BOOL, "network_values_set", godot::PROPERTY_HINT_NONE, "", godot::PROPERTY_USAGE_NO_EDITOR),
			"set_network_values_set", "has_network_values");
}

} // namespace softbody
