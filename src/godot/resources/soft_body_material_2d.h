// SPDX-License-Identifier: MIT
// The resource: a material that soft bodies share.
#pragma once

#include "godot/resources/material_values.h"
#include "godot/resources/unfit_values.h"

#include <godot_cpp/classes/resource.hpp>

namespace godot {

/// See doc_classes/SoftBodyMaterial2D.xml. It only keeps checked values and tells by the signal `changed` that one of them
/// is another; nodes listen and take them over.
class SoftBodyMaterial2D : public Resource {
	GDCLASS(SoftBodyMaterial2D, Resource)

public:
	/// Same values as softbody::MaterialPreset.
	enum Preset {
		PRESET_CUSTOM,
		PRESET_JELLY,
		PRESET_RUBBER,
		PRESET_WATER_BALLOON,
		PRESET_MARSHMALLOW,
		PRESET_FOAM,
	};

	const softbody::MaterialValues &values() const { return values_; }

	template <double softbody::MaterialValues::*VALUE>
	void set_material_value(double p_value) {
		set_value(softbody::material_field(VALUE), p_value);
	}
	template <double softbody::MaterialValues::*VALUE>
	double get_material_value() const {
		return values_.*VALUE;
	}
	static Ref<SoftBodyMaterial2D> make_preset(Preset p_preset);
	void set_preset(Preset p_preset);
	Preset get_preset() const { return Preset(softbody::preset_of(values_)); }
	void set_network_values_set(bool p_set);
	void clear_network_values() { set_network_values_set(false); }
	bool has_network_values() const { return values_.has_network_values; }

protected:
	static void _bind_methods();
	bool _set(const StringName &p_name, const Variant &p_value);
	bool _get(const StringName &p_name, Variant &r_value) const;
	void _get_property_list(List<PropertyInfo> *r_list) const { unfit_.append_to(r_list); }

private:
	void set_value(const softbody::MaterialField &p_field, double p_value);
	void take_over(const softbody::MaterialValues &p_values);
	/// "SoftBodyMaterial2D 'res://jelly.tres'": how messages name this resource.
	String describe() const;

	softbody::MaterialValues values_;
	softbody::UnfitValues unfit_;
};

} // namespace godot

VARIANT_ENUM_CAST(SoftBodyMaterial2D::Preset);
