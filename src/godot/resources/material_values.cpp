// SPDX-License-Identifier: MIT
// What a body is made of, as numbers: one list of values, ranges and units for the node and for the resource.
#include "godot/resources/material_values.h"

#include "core/base/real.h"

#include <algorithm>
#include <array>
#include <limits>

namespace softbody {

namespace {

using Values = MaterialValues;

constexpr double UNBOUNDED = std::numeric_limits<double>::infinity();

constexpr std::array FIELDS{
	MaterialField{ "stiffness", &Values::stiffness, UNBOUNDED, "N/m", "0,10000,0.1,or_greater,exp,suffix:N/m", true },
	MaterialField{ "damping", &Values::damping, UNBOUNDED, "N·s/m", "0,20,0.001,or_greater,suffix:N·s/m", true },
	MaterialField{ "shape_matching", &Values::shape_matching, UNBOUNDED, "", "0,2,0.01,or_greater", false },
	MaterialField{ "shape_damping", &Values::shape_damping, UNBOUNDED, "", "0,1,0.01,or_greater", false },
	MaterialField{ "pressure", &Values::pressure, UNBOUNDED, "N/m", "0,10000,0.1,or_greater,exp,suffix:N/m", false },
	MaterialField{ "inflation", &Values::inflation, UNBOUNDED, "", "0,3,0.01,or_greater", false },
	MaterialField{ "friction", &Values::friction, UNBOUNDED, "", "0,1,0.01,or_greater", false },
	MaterialField{ "bounce", &Values::bounce, 1, "", "0,1,0.01", false },
	MaterialField{ "rolling_resistance", &Values::rolling_resistance, UNBOUNDED, "", "0,1,0.001,or_greater", false },
	MaterialField{ "density", &Values::density, UNBOUNDED, "kg/m²", "0,10,0.01,or_greater,suffix:kg/m²", true },
};

} // namespace

std::span<const MaterialField> material_fields() {
	return FIELDS;
}

const MaterialField &material_field(double MaterialValues::*value) {
	return *std::ranges::find(FIELDS, value, &MaterialField::value);
}

Status check_material_value(const MaterialField &field, double value) {
	if (value > double(std::numeric_limits<Real>::max())) {
		value = UNBOUNDED; // what it would be in the core
	}
	return field.maximum < UNBOUNDED ? check_between(field.name, value, 0, field.maximum, field.unit)
									 : check_at_least(field.name, value, 0, field.unit);
}

} // namespace softbody
