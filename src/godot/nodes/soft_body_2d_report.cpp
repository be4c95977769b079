// SPDX-License-Identifier: MIT
// What will become of the body with its present values: plan of a step, stability, sag, cost, and warnings.
#include "godot/nodes/soft_body_2d.h"

#include "core/dynamics/load_trial.h"
#include "core/dynamics/stability_report.h"
#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/project_settings.hpp>
#include <godot_cpp/classes/time.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

// Steps of all the trials together that look for the stiffness that holds, a step of a body of 16 points taking some 3 us.
constexpr int MOST_TRIAL_STEPS = 5000;
// Steps that a clock leaves out: the first ones fill caches and arrange the world.
constexpr size_t UNTIMED_STEPS = 3;

const char *reason_text(softbody::PlanReason p_reason) {
	switch (p_reason) {
		case softbody::PlanReason::STABILITY:
			return "stability";
		case softbody::PlanReason::CONTACTS:
			return "contacts";
		case softbody::PlanReason::TOO_STIFF:
			return "too_stiff";
		case softbody::PlanReason::FIXED:
			return "fixed";
		case softbody::PlanReason::UNSTABLE:
			break;
	}
	return "unstable";
}

softbody::Real tick_length() {
	return softbody::Real(1.0 / Engine::get_singleton()->get_physics_ticks_per_second());
}

void write_plan(const softbody::SubstepPlan &p_plan, Dictionary &r_result) {
	r_result["frequency"] = p_plan.frequency;
	r_result["damping_rate"] = p_plan.damping_rate;
	r_result["integrator"] = int(p_plan.integrator);
	r_result["substeps"] = p_plan.substeps;
	r_result["stability_margin"] = p_plan.stability_margin;
	r_result["safe"] = p_plan.safe;
	r_result["reason"] = reason_text(p_plan.reason);
	r_result["cost"] = p_plan.cost;
}

// Lets the copy settle, and takes the time of its steps meanwhile [us]: the median, which no other program disturbs.
double settle(softbody::LoadTrial &r_trial, double p_time_limit_msec) {
	std::vector<double> times;
	const Time *clock = Time::get_singleton();
	const uint64_t begin = clock->get_ticks_usec();
	uint64_t last = begin;
	while (r_trial.step()) {
		const uint64_t now = clock->get_ticks_usec();
		times.push_back(double(now - last));
		last = now;
		if (double(now - begin) > 1000 * p_time_limit_msec && times.size() > UNTIMED_STEPS) {
			break;
		}
	}
	if (times.size() <= UNTIMED_STEPS) {
		return 0;
	}
	// The clock counts whole microseconds, of which a step takes few: the mean of the middle half tells parts of one.
	std::sort(times.begin() + UNTIMED_STEPS, times.end());
	const size_t count = times.size() - UNTIMED_STEPS;
	double sum = 0;
	size_t taken = 0;
	for (size_t i = count / 4; i < count - count / 4; i++) {
		sum += times[UNTIMED_STEPS + i];
		taken++;
	}
	return taken > 0 ? sum / double(taken) : 0.0;
}

} // namespace

softbody::Vec2 SoftBody2D::project_gravity() {
	const ProjectSettings *settings = ProjectSettings::get_singleton();
	const Vector2 direction = settings->get_setting("physics/2d/default_gravity_vector", Vector2(0, 1));
	return to_core(direction.normalized() * real_t(double(settings->get_setting("physics/2d/default_gravity", 980.0))));
}

softbody::Result<softbody::SoftBodyData> SoftBody2D::make_copy() const {
	const Transform2D transform = is_inside_tree() ? get_global_transform() : get_transform();
	auto made = make_design(transform);
	if (!made) {
		return made.error();
	}
	const Design &copied = made.value();
	auto body = softbody::SoftBodyData::create(copied.shape, make_settings(copied.mass), softbody::to_core_pose(transform));
	if (body) {
		for (const int32_t point : pinned_points_) {
			if (point < get_point_count()) {
				body.value().set_pinned(uint32_t(public_index(size_t(point), copied.is_reversed)), true);
			}
		}
	}
	return body;
}

Dictionary SoftBody2D::get_substep_plan() const {
	Dictionary result;
	if (const Design *found = design()) {
		write_plan(softbody::plan_substeps(*found->shape, make_settings(found->mass), tick_length(), collision_mask_ != 0), result);
	}
	return result;
}

Dictionary SoftBody2D::get_stability_report(double p_time_limit_msec) const {
	Dictionary result;
	const Design *found = design();
	ERR_FAIL_COND_V_MSG(!(p_time_limit_msec > 0), result, describe() + ": time_limit_msec must be above 0.");
	if (found == nullptr) {
		return result;
	}
	const softbody::BodySettings settings = make_settings(found->mass);
	const softbody::StabilityReport report =
			softbody::report_stability(*found->shape, settings, project_gravity(), tick_length(), collision_mask_ != 0);
	write_plan(report.plan, result);
	result["automatic_substeps"] = report.automatic.substeps;
	result["automatic_integrator"] = int(report.automatic.integrator);
	result["automatic_safe"] = report.automatic.safe;
	result["stiffness"] = report.stiffness;
	result["strength"] = report.strength;
	result["damping"] = report.damping;
	result["least_damping"] = report.least_damping;

	const auto copy = make_copy();
	if (!copy) {
		return result;
	}
	auto trial = softbody::LoadTrial::create(copy.value(), project_gravity(), softbody::PIXELS_PER_METRE, tick_length());
	if (!trial) {
		return result;
	}
	result["microseconds_per_tick"] = settle(trial.value(), p_time_limit_msec);
	const softbody::LoadOutcome outcome = trial.value().outcome();
	result["sag"] = outcome.sag;
	result["area_loss"] = outcome.area_loss;
	result["folds"] = outcome.folded || outcome.area_loss > softbody::FOLDED_AREA_LOSS;
	result["settled"] = outcome.rests;
	double factor = 1;
	if (softbody::needs_more(outcome)) {
		const double step_msec = MAX(double(result["microseconds_per_tick"]), 1.0) / 1000;
		const int steps = int(MIN(double(MOST_TRIAL_STEPS), 5 * p_time_limit_msec / step_msec));
		factor = double(softbody::find_firm_factor(copy.value(), project_gravity(), softbody::PIXELS_PER_METRE, tick_length(), steps));
	}
	const double own = material_values().stiffness;
	// Where a trial would take too long, what the rule says of the usual structure.
	const double by_rule = report.stiffness > 0 ? own * double(report.firm_stiffness / report.stiffness) : double(report.firm_stiffness);
	result["firm_stiffness"] = factor > 0 && own > 0 ? factor * own : by_rule;
	return result;
}

PackedStringArray SoftBody2D::get_warnings() const {
	PackedStringArray warnings;
	for (const KeyValue<StringName, String> &refused : refused_) {
		warnings.push_back("The last value given to '" + String(refused.key) + "' was refused: " + refused.value + ". The previous value is in use.");
	}
	unfit_.append_warnings(warnings);
	const Design *found = design();
	if (found != nullptr) {
		for (const String &problem : found->problems) {
			warnings.push_back("Left out of the body, as it does not fit the rest of its structure: " + problem + ".");
		}
	}
	const std::vector<softbody::Vec2> hull = to_core(hull_);
	for (int64_t i = 0; i < inner_points_.size(); i++) {
		if (!softbody::point_in_polygon(to_core(inner_points_[i]), hull)) {
			warnings.push_back("inner_points[" + String::num_int64(i) + "] lies outside the hull: it is part of the body, but touches nothing. Move it inside.");
		}
	}
	if (found != nullptr) {
		const softbody::StabilityReport report = softbody::report_stability(*found->shape, make_settings(found->mass), project_gravity(), tick_length(), collision_mask_ != 0);
		const double stiffness = material_values().stiffness;
		const double damping = material_values().damping;
		// What is painted on single springs stays: the node's own value has to make up for it.
		const double stiffness_share = report.stiffness > 0 ? stiffness / double(report.stiffness) : 1.0;
		const double damping_share = report.damping > 0 ? damping / double(report.damping) : 1.0;
		if (report.is_too_soft()) {
			warnings.push_back("Stiffness " + String::num(stiffness) + " N/m is too low for the body's weight: it will fold. Use at least " + String::num(std::ceil(stiffness_share * double(report.firm_stiffness))) + " N/m, or less mass or gravity_scale.");
		}
		if (report.rings()) {
			warnings.push_back(vformat(String::utf8("Damping %s N·s/m is too low to calm strong deformations. Use at least %s N·s/m."), damping, String::num(damping_share * double(report.least_damping), 3)));
		}
		if (!report.plan.safe) {
			warnings.push_back("With these values a step is not stable in " + String::num_int64(report.plan.substeps) + " substeps. Lower the stiffness or the damping, raise the mass, use fewer hull points, or set substeps to 0 (automatic).");
		}
	}
	append_pin_warnings(warnings);
	append_drawing_warnings(warnings);
	return warnings;
}

void SoftBody2D::bind_report() {
	ClassDB::bind_method(D_METHOD("get_substep_plan"), &SoftBody2D::get_substep_plan);
	ClassDB::bind_method(D_METHOD("get_stability_report", "time_limit_msec"), &SoftBody2D::get_stability_report, DEFVAL(30.0));
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBody2D::get_warnings);
}

} // namespace godot
