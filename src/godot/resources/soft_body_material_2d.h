// SPDX-License-Identifier: MIT
// The resource: a material that soft bodies share.
#pragma once

#include "core/model/material_values.h"
#include "godot/resources/unfit_values.h"

#include <godot_cpp/classes/resource.hpp>

#include <utility>

namespace godot {

/// See doc_classes/SoftBodyMaterial2D.xml. It keeps checked values and tells by the signal `changed` that one of them is
/// another. Nodes that share it listen, and a node without a shared material has one of its own (`BodyMaterial`).
class SoftBodyMaterial2D : public Resource, public softbody::MaterialPresets {
	GDCLASS(SoftBodyMaterial2D, Resource)

public:
	const softbody::MaterialValues &values() const { return values_; }
	/// Replaces the values by checked ones, without a signal. For the node whose own material this is.
	softbody::MaterialValues exchange_values(const softbody::MaterialValues &p_values) { return std::exchange(values_, p_values); }

	template <double softbody::MaterialValues::*VALUE>
	void set_material_value(double p_value) {
		set_value(softbody::material_fields()[softbody::index_of(VALUE)], p_value);
	}
	template <double softbody::MaterialValues::*VALUE>
	double get_material_value() const {
		return values_.*VALUE;
	}
	static Ref<SoftBodyMaterial2D> make_preset(Preset p_preset);
	void set_preset(Preset p_preset);
	Preset get_preset() const { return softbody::preset_of(values_); }
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
