// SPDX-License-Identifier: MIT
// The project settings of soft bodies.
#include "godot/server/step_settings.h"

#include "core/base/error.h"
#include "godot/convert.h"

#include <godot_cpp/classes/project_settings.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/property_info.hpp>
#include <godot_cpp/variant/dictionary.hpp>

using namespace godot;

namespace softbody {

namespace {

constexpr const char *THREADS = "physics/soft_body_2d/solver/threads";
constexpr const char *CONTACT_SUBSTEPS = "physics/soft_body_2d/solver/contact_substeps";
constexpr const char *SUBSTEPS = "physics/soft_body_2d/solver/default_substeps";
constexpr const char *MOST_TEARS = "physics/soft_body_2d/solver/max_tears_per_tick";
constexpr const char *RIGID_FLIGHT = "physics/soft_body_2d/solver/rigid_flight";
constexpr const char *BUDGET = "physics/soft_body_2d/solver/budget_ms";
constexpr const char *CAN_SLEEP = "physics/soft_body_2d/sleep/enabled";
constexpr const char *PHYSICS_THREAD = "physics/2d/run_on_separate_thread"; // the engine's
constexpr const char *CHARACTER_MASS = "physics/soft_body_2d/characters/mass";
constexpr int MAX_THREADS = 64;
constexpr int MAX_TEARS = 1000;
constexpr double MAX_CHARACTER_MASS = 1e6; // [kg]
constexpr double MAX_BUDGET = 1000; // [ms]

void add_setting(const char *p_name, const Variant &p_default, PropertyHint p_hint, const String &p_hint_string) {
	ProjectSettings *settings = ProjectSettings::get_singleton();
	if (!settings->has_setting(p_name)) {
		settings->set_setting(p_name, p_default);
	}
	settings->set_initial_value(p_name, p_default);
	settings->set_as_basic(p_name, true);
	Dictionary info;
	info["name"] = p_name;
	info["type"] = p_default.get_type();
	info["hint"] = p_hint;
	info["hint_string"] = p_hint_string;
	settings->add_property_info(info);
}

double read_number(const char *p_name, double p_least, double p_most, double p_default) {
	const double value = ProjectSettings::get_singleton()->get_setting(p_name, p_default);
	const Status status = check_between(p_name, value, p_least, p_most, "");
	if (status) {
		ERR_PRINT("Project setting " + to_godot(status->message()) + ". " + rtos(p_default) + " is used instead.");
		return p_default;
	}
	return value;
}

int read_count(const char *p_name, int p_least, int p_most, int p_default) {
	const int64_t value = ProjectSettings::get_singleton()->get_setting(p_name, p_default);
	const Status status = check_between(p_name, double(value), p_least, p_most, "");
	if (status) {
		ERR_PRINT("Project setting " + to_godot(status->message()) + ". " + itos(p_default) + " is used instead.");
		return p_default;
	}
	return int(value);
}

} // namespace

void register_step_settings() {
	const StepSettings defaults;
	add_setting(THREADS, defaults.threads, PROPERTY_HINT_RANGE, "0," + itos(MAX_THREADS) + ",1");
	add_setting(CONTACT_SUBSTEPS, defaults.contact_substeps, PROPERTY_HINT_RANGE, "1," + itos(MAX_SUBSTEPS) + ",1");
	add_setting(SUBSTEPS, defaults.substeps, PROPERTY_HINT_RANGE, "0," + itos(MAX_SUBSTEPS) + ",1");
	add_setting(MOST_TEARS, defaults.most_tears, PROPERTY_HINT_RANGE, "0," + itos(MAX_TEARS) + ",1");
	add_setting(RIGID_FLIGHT, defaults.rigid_flight, PROPERTY_HINT_NONE, "");
	add_setting(BUDGET, defaults.budget_ms, PROPERTY_HINT_RANGE, "0,16,0.1,or_greater,suffix:ms");
	add_setting(CHARACTER_MASS, double(defaults.character_mass), PROPERTY_HINT_RANGE, "0,10,0.01,or_greater,suffix:kg");
	add_setting(CAN_SLEEP, defaults.can_sleep, PROPERTY_HINT_NONE, "");
}

StepSettings read_step_settings() {
	const StepSettings defaults;
	StepSettings settings;
	settings.has_physics_thread = ProjectSettings::get_singleton()->get_setting(PHYSICS_THREAD, false);
	settings.threads = read_count(THREADS, 0, MAX_THREADS, defaults.threads);
	settings.contact_substeps = read_count(CONTACT_SUBSTEPS, 1, MAX_SUBSTEPS, defaults.contact_substeps);
	settings.substeps = read_count(SUBSTEPS, 0, MAX_SUBSTEPS, defaults.substeps);
	settings.most_tears = read_count(MOST_TEARS, 0, MAX_TEARS, defaults.most_tears);
	settings.character_mass = Real(read_number(CHARACTER_MASS, 0, MAX_CHARACTER_MASS, double(defaults.character_mass)));
	settings.rigid_flight = ProjectSettings::get_singleton()->get_setting(RIGID_FLIGHT, defaults.rigid_flight);
	settings.budget_ms = read_number(BUDGET, 0, MAX_BUDGET, defaults.budget_ms);
	settings.can_sleep = ProjectSettings::get_singleton()->get_setting(CAN_SLEEP, defaults.can_sleep);
	return settings;
}

} // namespace softbody
