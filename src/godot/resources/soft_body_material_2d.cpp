// SPDX-License-Identifier: MIT
// The resource: a material that soft bodies share.
#include "godot/resources/soft_body_material_2d.h"

#include "godot/convert.h"

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
	if (values_.*p_field.value != p_value) {
		values_.*p_field.value = p_value;
		emit_changed();
	}
}

void SoftBodyMaterial2D::_bind_methods() {
	softbody::bind_material_values<SoftBodyMaterial2D>(true);
}

} // namespace godot
