// SPDX-License-Identifier: MIT
// What a body is made of, as numbers that a user sets: one table of names, ranges and units, and presets.
#pragma once

#include "core/base/value_range.h"
#include "core/model/material.h"

#include <cstddef>
#include <span>

namespace softbody {

/// What a user of a body sets, in the units of an editor. The class reference of SoftBodyMaterial2D says what each does.
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
	double yield_strain = 0; ///< BodySettings::yield_strain [1]
	double flow_rate = 30; ///< BodySettings::flow_rate [1/s]
	double max_dent = 0.5; ///< BodySettings::max_dent [1]
	double tear_stretch = 0; ///< TearLimits::stretch [1]; 0: never
	double density = 0; ///< [kg/m²]; 0 leaves the mass to the node. Only resources have one.
	/// Whether one of the raw values of the spring network was set: stiffness, damping, shape matching, its damping, pressure.
	bool has_network_values = false;

	friend bool operator==(const MaterialValues &, const MaterialValues &) = default;
};

/// Materials with a name. Setting one sets Young's modulus, Poisson's ratio, damping ratio, friction, bounce and rolling
/// resistance. A base of SoftBodyMaterial2D, which gives the constants to scripts.
struct MaterialPresets {
	enum Preset {
		PRESET_CUSTOM, ///< none of the others; sets nothing
		PRESET_JELLY, ///< the default values
		PRESET_RUBBER,
		PRESET_WATER_BALLOON,
		PRESET_MARSHMALLOW,
		PRESET_FOAM,
	};
	static constexpr int PRESET_COUNT = PRESET_FOAM + 1;
};

/// One of the values: its name and range.
struct MaterialField {
	const char *name;
	double MaterialValues::*value;
	ValueRange range;
	bool is_of_network = false; ///< a raw value of the spring network

	/// Refuses a value out of range, also one that is finite here and not as a `Real`.
	Status check(double given) const;
};

/// In the order in which an editor shows them; `density` is the last.
std::span<const MaterialField> material_fields();
/// The index in `material_fields()`.
std::size_t index_of(double MaterialValues::*value);

/// After `field` was set: whether the raw values of the network count as set. One that `sticks` counts whatever its value, as
/// a script or a scene has set it; else they count while one of them differs from its default, so that undo takes that back.
void note_set(MaterialValues &values, const MaterialField &field, bool sticks);
/// Whether the raw values count as set. If not, they get their defaults.
void set_network_values_set(MaterialValues &values, bool set);
/// What `apply_material` takes.
Material to_material(const MaterialValues &values);

void apply_preset(MaterialPresets::Preset preset, MaterialValues &values);
/// The preset with these values, or PRESET_CUSTOM. Single precision counts. O(presets).
MaterialPresets::Preset preset_of(const MaterialValues &values);

} // namespace softbody
