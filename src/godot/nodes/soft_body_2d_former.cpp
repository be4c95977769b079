// SPDX-License-Identifier: MIT
// Names that properties had in earlier versions: a value that an old scene or script sets under one still counts.
#include "godot/nodes/soft_body_2d.h"

namespace godot {

namespace {

bool is_friction(const StringName &p_name) {
	static const StringName FRICTION = "friction";
	return p_name == FRICTION;
}

bool is_bounce(const StringName &p_name) {
	static const StringName BOUNCE = "bounce";
	return p_name == BOUNCE;
}

bool is_shape_damping(const StringName &p_name) {
	static const StringName SHAPE_DAMPING = "shape_damping";
	return p_name == SHAPE_DAMPING;
}

bool is_hull(const StringName &p_name) {
	static const StringName HULL = "hull";
	return p_name == HULL;
}

} // namespace

bool SoftBody2D::set_former(const StringName &p_name, const Variant &p_value) {
	if (is_hull(p_name)) {
		if (!unfit_.set(*this, get_class_static(), "polygon", p_value)) {
			set_polygon(p_value);
			unfit_.note_former(*this, p_name, "'hull' is called 'polygon' now. Its value was taken over: save the scene to store it as 'polygon', and change scripts and animations that name 'hull'.");
		}
		return true;
	}
	if (is_shape_damping(p_name)) {
		if (!unfit_.set(*this, get_class_static(), "shape_damping_ratio", p_value)) {
			set_material_value<&softbody::MaterialValues::shape_damping_ratio>(p_value);
			unfit_.note_former(*this, p_name, "'shape_damping' is called 'shape_damping_ratio' now. Its value was taken over: save the scene to store it as 'shape_damping_ratio', and change scripts and animations that name 'shape_damping'.");
		}
		return true;
	}
	if (is_friction(p_name) || is_bounce(p_name)) {
		set_former_surface(p_name, p_value);
		return true;
	}
	return false;
}

// A node had values of its own; a material that it shared with others counted instead of them.
void SoftBody2D::set_former_surface(const StringName &p_name, const Variant &p_value) {
	const bool is_number = p_value.get_type() == Variant::FLOAT || p_value.get_type() == Variant::INT;
	if (!is_number) {
		unfit_.note_former(*this, p_name, vformat("'%s' refused: a value of type %s, must be float. The old value stays.", p_name, Variant::get_type_name(p_value.get_type())));
		return;
	}
	const double value = p_value;
	const softbody::MaterialField &field = softbody::material_field(is_friction(p_name) ? &softbody::MaterialValues::friction : &softbody::MaterialValues::bounce);
	if (!accept(p_name, softbody::check_material_value(field, value))) {
		return;
	}
	const String moved = "'friction' and 'bounce' are those of 'physics_material_override' now. ";
	const String advice = " Save the scene, and change scripts and animations that name the old properties.";
	if (material_.is_valid()) {
		unfit_.note_former(*this, "physics_material_override", moved + String("The old values are dropped, as 'soft_body_material' has others, which counted.") + advice);
		return;
	}
	if (physics_material_override_.is_null() || physics_material_override_ != former_surface_) {
		former_surface_ = make_physics_material(surface());
		set_physics_material_override(former_surface_);
	}
	if (is_friction(p_name)) {
		former_surface_->set_friction(value);
	} else {
		former_surface_->set_bounce(value);
	}
	unfit_.note_former(*this, "physics_material_override", moved + String("The node was given a PhysicsMaterial of its own with the old values.") + advice);
}

bool SoftBody2D::get_former(const StringName &p_name, Variant &r_value) const {
	if (is_hull(p_name)) {
		r_value = polygon_;
	} else if (is_shape_damping(p_name)) {
		r_value = own_material_.shape_damping_ratio;
	} else if (is_friction(p_name)) {
		r_value = surface().friction;
	} else if (is_bounce(p_name)) {
		r_value = surface().bounce;
	} else {
		return false;
	}
	return true;
}

} // namespace godot
