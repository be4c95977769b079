// SPDX-License-Identifier: MIT
// What a body is made of, as numbers: one list of values, ranges and units for the node and for the resource.
#include "godot/resources/material_values.h"

#include "core/base/real.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace softbody {

namespace {

using Values = MaterialValues;

constexpr double UNBOUNDED = std::numeric_limits<double>::infinity();

constexpr double MOST_RATIO = 0.49; // MOST_POISSON_RATIO, as it is written

constexpr std::array FIELDS{
	MaterialField{ "youngs_modulus", &Values::youngs_modulus, UNBOUNDED, "N/m", "1,10000,0.1,or_greater,exp,suffix:N/m" },
	MaterialField{ "poisson_ratio", &Values::poisson_ratio, MOST_RATIO, "", "0,0.49,0.01" },
	MaterialField{ "damping_ratio", &Values::damping_ratio, UNBOUNDED, "", "0,2,0.01,or_greater" },
	MaterialField{ "friction", &Values::friction, UNBOUNDED, "", "0,1,0.01,or_greater" },
	MaterialField{ "bounce", &Values::bounce, 1, "", "0,1,0.01" },
	MaterialField{ "rolling_resistance", &Values::rolling_resistance, UNBOUNDED, "", "0,1,0.001,or_greater" },
	MaterialField{ "inflation", &Values::inflation, UNBOUNDED, "", "0,3,0.01,or_greater" },
	MaterialField{ "stiffness", &Values::stiffness, UNBOUNDED, "N/m", "0,10000,0.1,or_greater,exp,suffix:N/m", true },
	MaterialField{ "damping", &Values::damping, UNBOUNDED, "N·s/m", "0,20,0.001,or_greater,suffix:N·s/m", true },
	MaterialField{ "shape_matching", &Values::shape_matching, UNBOUNDED, "", "0,2,0.01,or_greater", true },
	MaterialField{ "shape_damping_ratio", &Values::shape_damping_ratio, UNBOUNDED, "", "0,1,0.01,or_greater", true },
	MaterialField{ "pressure", &Values::pressure, UNBOUNDED, "N/m", "0,10000,0.1,or_greater,exp,suffix:N/m", true },
	MaterialField{ "density", &Values::density, UNBOUNDED, "kg/m²", "0,10,0.01,or_greater,suffix:kg/m²" },
};

/// What a preset sets: the first six fields, in their order.
struct PresetValues {
	std::array<double, 6> values;
};

// Each of the first six fields. Young's modulus is chosen for a body of 1 kg and 50 px, which 980 N weigh on: E R / (m g) is 15
// for jelly, and a body of half of that sags visibly.
constexpr std::array<PresetValues, MATERIAL_PRESET_COUNT - 1> PRESETS{ {
		{ { 300, 0.45, 0.15, 0.4, 0, 0.03 } }, // jelly: the default values
		{ { 2000, 0.48, 0.05, 0.8, 0.3, 0.01 } }, // rubber
		{ { 120, 0.49, 0.06, 0.4, 0, 0.02 } }, // a balloon of water
		{ { 250, 0.1, 0.5, 0.6, 0, 0.08 } }, // marshmallow
		{ { 600, 0, 0.35, 0.6, 0, 0.05 } }, // foam
} };

} // namespace

std::span<const MaterialField> material_fields() {
	return FIELDS;
}

const MaterialField &material_field(double MaterialValues::*value) {
	return *std::ranges::find(FIELDS, value, &MaterialField::value);
}

void note_set(MaterialValues &values, const MaterialField &field, bool sticks) {
	if (!field.is_of_network) {
		return;
	}
	const MaterialValues defaults;
	values.has_network_values = sticks || std::ranges::any_of(FIELDS, [&](const MaterialField &each) {
		return each.is_of_network && values.*each.value != defaults.*each.value;
	});
}

void set_network_values_set(MaterialValues &values, bool set) {
	if (set) {
		values.has_network_values = true;
	} else {
		clear_network_values(values);
	}
}

void clear_network_values(MaterialValues &values) {
	const MaterialValues defaults;
	for (const MaterialField &field : FIELDS) {
		if (field.is_of_network) {
			values.*field.value = defaults.*field.value;
		}
	}
	values.has_network_values = false;
}

Material to_material(const MaterialValues &values) {
	return { Real(values.youngs_modulus), Real(values.poisson_ratio), Real(values.damping_ratio) };
}

void apply_preset(MaterialPreset preset, MaterialValues &values) {
	if (preset == MaterialPreset::CUSTOM) {
		return;
	}
	const PresetValues &chosen = PRESETS[std::size_t(preset) - 1];
	for (std::size_t i = 0; i < chosen.values.size(); ++i) {
		values.*FIELDS[i].value = chosen.values[i];
	}
}

MaterialPreset preset_of(const MaterialValues &values) {
	for (std::size_t preset = 0; preset < PRESETS.size(); ++preset) {
		MaterialValues like = values;
		apply_preset(MaterialPreset(preset + 1), like);
		if (like == values) {
			return MaterialPreset(preset + 1);
		}
	}
	return MaterialPreset::CUSTOM;
}

Status check_material_value(const MaterialField &field, double value) {
	if (value > double(std::numeric_limits<Real>::max())) {
		value = UNBOUNDED; // what it would be in the core
	}
	if (field.value == &Values::youngs_modulus) {
		return check_above(field.name, double(Real(value)), 0, field.unit);
	}
	return field.maximum < UNBOUNDED ? check_between(field.name, value, 0, field.maximum, field.unit)
									 : check_at_least(field.name, value, 0, field.unit);
}

} // namespace softbody
