// SPDX-License-Identifier: MIT
// Claims about the values that a user sets: ranges, presets, and when raw values of a network count.
#include "core/model/material_values.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using namespace softbody;

namespace {

using Values = MaterialValues;

const MaterialField &field(double Values::*value) {
	return material_fields()[index_of(value)];
}

} // namespace

TEST_CASE("every material value is in the table once, with its default in range") {
	const Values defaults;
	CHECK(material_fields().size() == 17);
	for (const MaterialField &each : material_fields()) {
		CHECK(&field(each.value) == &each);
		CHECK(!each.check(defaults.*each.value));
		CHECK(each.check(-1)->name == each.name);
		CHECK(each.check(10 * double(std::numeric_limits<Real>::max()))); // finite where Real is float
	}
	CHECK(field(&Values::youngs_modulus).check(0));
	CHECK(!field(&Values::stiffness).check(0));
	CHECK(!field(&Values::poisson_ratio).check(0.49));
	CHECK(field(&Values::poisson_ratio).check(0.5));
}

TEST_CASE("a range refuses what is outside, and NaN") {
	const double nan = std::numeric_limits<double>::quiet_NaN();
	const double inf = std::numeric_limits<double>::infinity();
	for (const ValueRange &range : { ValueRange{}, ValueRange::at_least(1), ValueRange::above(1), ValueRange::between(1, 3) }) {
		CHECK(!range.check("x", 2));
		CHECK(range.check("x", nan)->name == "x");
		CHECK(range.check("x", inf));
	}
	CHECK(!ValueRange{}.check("x", -1e9));
	CHECK(!ValueRange::at_least(1).check("x", 1));
	CHECK(ValueRange::above(1).check("x", 1));
	CHECK(ValueRange::between(1, 3).check("x", 3.5));
}

TEST_CASE("a preset is known by its values, and by nothing else") {
	Values values;
	CHECK(preset_of(values) == MaterialPresets::PRESET_JELLY);
	for (int preset = 1; preset < MaterialPresets::PRESET_COUNT; ++preset) {
		apply_preset(MaterialPresets::Preset(preset), values);
		CHECK(preset_of(values) == preset);
		values.friction = double(float(values.friction)); // as Godot's PhysicsMaterial keeps it
		CHECK(preset_of(values) == preset);
	}
	values.friction = 0.125;
	CHECK(preset_of(values) == MaterialPresets::PRESET_CUSTOM);
	const Values before = values;
	apply_preset(MaterialPresets::PRESET_CUSTOM, values);
	CHECK(values == before);
}

TEST_CASE("raw values of a network count when they are set, and not after they are cleared") {
	Values values;
	note_set(values, field(&Values::youngs_modulus), true);
	CHECK_FALSE(values.has_network_values);
	note_set(values, field(&Values::stiffness), false);
	CHECK_FALSE(values.has_network_values); // at its default, in an editor
	note_set(values, field(&Values::stiffness), true);
	CHECK(values.has_network_values);
	values.damping = 3;
	values.inflation = 2;
	set_network_values_set(values, true);
	CHECK(values.damping == 3);
	set_network_values_set(values, false);
	CHECK(values.damping == Values{}.damping);
	CHECK(values.inflation == 2);
	CHECK_FALSE(values.has_network_values);
}
