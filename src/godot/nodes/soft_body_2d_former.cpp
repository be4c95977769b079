// SPDX-License-Identifier: MIT
// Names that properties had in earlier versions: a value that an old scene or script sets under one still counts.
#include "godot/nodes/soft_body_2d.h"

namespace godot {

bool SoftBody2D::set_former(const StringName &p_name, const Variant &p_value) {
	static const StringName HULL = "hull";
	static const StringName POLYGON = "polygon";
	if (p_name != HULL) {
		return false;
	}
	if (!unfit_.set(*this, get_class_static(), POLYGON, p_value)) {
		set_polygon(p_value);
		unfit_.note_former(*this, p_name, "'hull' is called 'polygon' now. Its value was taken over: save the scene to store it as 'polygon', and change scripts and animations that name 'hull'.");
	}
	return true;
}

bool SoftBody2D::get_former(const StringName &p_name, Variant &r_value) const {
	static const StringName HULL = "hull";
	if (p_name == HULL) {
		r_value = polygon_;
		return true;
	}
	return false;
}

} // namespace godot
