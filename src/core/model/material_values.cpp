// SPDX-License-Identifier: MIT
// What a body is made of, as numbers that a user sets: one table of names, ranges and units, and presets.
#include "core/model/material_values.h"

#include <algorithm>
#include <array>
#include <limits>

namespace softbody {

namespace {

using Values = MaterialValues;

constexpr double MOST_RATIO = 0.49; // MOST_POISSON_RATIO, as it is written
constexpr double MAX_DENT = 0.9; // MOST_DENT, as it is written

constexpr std::array FIELDS{
	MaterialField{ "youngs_modulus", &Values::youngs_modulus, ValueRange::above(0, "N/m") },
	MaterialField{ "poisson_ratio", &Values::poisson_ratio, ValueRange::between(0, MOST_RATIO) },
	MaterialField{ "damping_ratio", &Values::damping_ratio, ValueRange::at_least(0) },
	MaterialField{ "friction", &Values::friction, ValueRange::at_least(0) },
	MaterialField{ "bounce", &Values::bounce, ValueRange::between(0, 1) },
	MaterialField{ "rolling_resistance", &Values::rolling_resistance, ValueRange::at_least(0) },
	MaterialField{ "inflation", &Values::inflation, ValueRange::at_least(0) },
	MaterialField{ "yield_strain", &Values::yield_strain, ValueRange::at_least(0) },
	MaterialField{ "flow_rate", &Values::flow_rate, ValueRange::at_least(0, "1/s") },
	MaterialField{ "max_dent", &Values::max_dent, ValueRange::between(0, MAX_DENT) },
	MaterialField{ "tear_stretch", &Values::tear_stretch, ValueRange::at_least(0) },
	MaterialField{ "stiffness", &Values::stiffness, ValueRange::at_least(0, "N/m"), true },
	MaterialField{ "damping", &Values::damping, ValueRange::at_least(0, "N·s/m"), true },
	MaterialField{ "shape_matching", &Values::shape_matching, ValueRange::at_least(0), true },
	MaterialField{ "shape_damping_ratio", &Values::shape_damping_ratio, ValueRange::at_least(0), true },
	MaterialField{ "pressure", &Values::pressure, ValueRange::at_least(0, "N/m"), true },
	MaterialField{ "density", &Values::density, ValueRange::at_least(0, "kg/m²") },
};

/// What a preset sets: the first six fields, in their order.
struct PresetValues {
	std::array<double, 6> values;
};

// Each of the first six fields. Young's modulus is chosen for a body of 1 kg and 50 px, which 980 N weigh on: E R / (m g) is 15
// for jelly, and a body of half of that sags visibly.
constexpr std::array<PresetValues, MaterialPresets::PRESET_COUNT - 1> PRESETS{ {
		{ { 300, 0.45, 0.15, 0.4, 0, 0.03 } }, // jelly: the default values
		{ { 2000, 0.48, 0.05, 0.8, 0.3, 0.01 } }, // rubber
		{ { 120, 0.49, 0.06, 0.4, 0, 0.02 } }, // a balloon of water
		{ { 250, 0.1, 0.5, 0.6, 0, 0.08 } }, // marshmallow
		{ { 600, 0, 0.35, 0.6, 0, 0.05 } }, // foam
} };

} // namespace

Status MaterialField::check(double given) const {
	const bool fits = !(given > double(std::numeric_limits<Real>::max()));
	return range.check(name, fits ? given : std::numeric_limits<double>::infinity());
}

std::span<const MaterialField> material_fields() {
	return FIELDS;
}

std::size_t index_of(double MaterialValues::*value) {
	return std::size_t(std::ranges::find(FIELDS, value, &MaterialField::value) - FIELDS.begin());
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
	const MaterialValues defaults;
	for (const MaterialField &field : FIELDS) {
		if (field.is_of_network && !set) {
			values.*field.value = defaults.*field.value;
		}
	}
	values.has_network_values = set;
}

Material to_material(const MaterialValues &values) {
	return { Real(values.youngs_modulus), Real(values.poisson_ratio), Real(values.damping_ratio) };
}

void apply_preset(MaterialPresets::Preset preset, MaterialValues &values) {
	if (preset == MaterialPresets::PRESET_CUSTOM) {
		return;
	}
	const PresetValues &chosen = PRESETS[std::size_t(preset) - 1];
	for (std::size_t i = 0; i < chosen.values.size(); ++i) {
		values.*FIELDS[i].value = chosen.values[i];
	}
}

MaterialPresets::Preset preset_of(const MaterialValues &values) {
	for (int preset = 1; preset < MaterialPresets::PRESET_COUNT; ++preset) {
		MaterialValues like = values;
		apply_preset(MaterialPresets::Preset(preset), like);
		if (std::ranges::all_of(FIELDS, [&](const MaterialField &field) { return float(like.*field.value) == float(values.*field.value); })) {
			return MaterialPresets::Preset(preset);
		}
	}
	return MaterialPresets::PRESET_CUSTOM;
}

} // namespace softbody
