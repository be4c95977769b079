// SPDX-License-Identifier: MIT
// What a body is made of, as numbers: one list of values, ranges and units for the node and for the resource.
#pragma once

#include "core/base/error.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/variant/string.hpp>

#include <span>

namespace softbody {

/// In the units of the inspector. The class reference of SoftBodyMaterial2D says what each does.
struct MaterialValues {
	double stiffness = 100; ///< [N/m]
	double damping = 0.12; ///< [N·s/m]
	double shape_matching = 0.4; ///< share of the stiffness [1]
	double shape_damping = 0.25; ///< damping ratio [1]
	double pressure = 0; ///< [N/m]
	double inflation = 1; ///< [1]
	double friction = 0.4; ///< [1]
	double bounce = 0; ///< [1]
	double rolling_resistance = 0.03; ///< [1]
	double density = 0; ///< [kg/m²]; 0 leaves the mass to the node. Only resources have one.
};

/// One of them: its name, range, and how the inspector shows it.
struct MaterialField {
	const char *name;
	double MaterialValues::*value;
	double maximum; ///< the minimum is 0
	const char *unit;
	const char *hint; ///< of PROPERTY_HINT_RANGE
	bool is_structural; ///< belongs to the springs and masses: changing it makes another shape
};

/// In the inspector's order; `density` is the last.
std::span<const MaterialField> material_fields();
const MaterialField &material_field(double MaterialValues::*value);

/// Refuses what is out of range, also what is finite here and not in the core's precision.
Status check_material_value(const MaterialField &field, double value);

/// Binds setter, getter and property of each field to `Class::set_material_value<…>` and `Class::get_material_value<…>`.
template <class Class>
void bind_material_values(bool p_with_density);

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
void bind_material_values(bool p_with_density) {
	using Values = MaterialValues;
	material_binding::bind<Class, &Values::stiffness>();
	material_binding::bind<Class, &Values::damping>();
	material_binding::bind<Class, &Values::shape_matching>();
	material_binding::bind<Class, &Values::shape_damping>();
	material_binding::bind<Class, &Values::pressure>();
	material_binding::bind<Class, &Values::inflation>();
	material_binding::bind<Class, &Values::friction>();
	material_binding::bind<Class, &Values::bounce>();
	material_binding::bind<Class, &Values::rolling_resistance>();
	if (p_with_density) {
		material_binding::bind<Class, &Values::density>();
	}
}

} // namespace softbody
