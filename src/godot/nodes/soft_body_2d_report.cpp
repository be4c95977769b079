// SPDX-License-Identifier: MIT
// What will become of the body with its present values: plan of a step, stability, sag, cost, and warnings.
#include "godot/nodes/soft_body_2d.h"

#include "core/dynamics/fall_trial.h"
#include "core/creator/body_tear.h"
#include "core/dynamics/drop_trial.h"
#include "core/dynamics/load_trial.h"
#include "core/dynamics/stability_report.h"
#include "core/model/model_choice.h"
#include "godot/convert.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/project_settings.hpp>
#include <godot_cpp/classes/time.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/print_string.hpp>

#include <algorithm>
#include <atomic>
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

// Strength from which on a network has no folded shape in which it stays: falls of up to 450 px fold one of 1.7, none of 2.
constexpr softbody::Real UPRIGHT_STRENGTH = 2;
// Part of its area from which on a network's limits open its folds.
constexpr double LEAST_HOLDING_AREA = 0.5;

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
	r_result["reason"] = softbody::name_of(p_plan.reason);
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
	const auto settings = make_settings(copied);
	if (!settings) {
		return settings.error();
	}
	auto body = softbody::SoftBodyData::create(copied.shape, settings.value(), softbody::to_core_pose(transform));
	if (body) {
		pins_.apply(body.value(), structure_.order(copied.is_reversed));
	}
	return body;
}

Dictionary SoftBody2D::get_substep_plan() const {
	Dictionary result;
	if (const auto settings = present_settings()) {
		const Design *found = design();
		write_plan(softbody::plan_substeps(*found->shape, *settings, tick_length(), values_.collision_mask != 0), result);
		result["elastic_model"] = int(found->used.model);
		result["elastic_reason"] = found->used.reason;
		const bool is_network = found->used.model == ELASTIC_MODEL_NETWORK;
		result["elastic_error"] = is_network ? 0.0 : softbody::expected_error(softbody::ElasticModel(found->used.model - ELASTIC_MODEL_SPRINGS), std::size_t(structure_.hull_count()));
	}
	return result;
}

Dictionary SoftBody2D::get_stability_report(double p_time_limit_msec) const {
	Dictionary result = get_substep_plan();
	const Design *found = design();
	ERR_FAIL_COND_V_MSG(!(p_time_limit_msec > 0), Dictionary(), describe() + ": time_limit_msec must be above 0.");
	if (result.is_empty() || rope() != nullptr) { // a rope is stable, and has no shape that a load could press flat
		return result;
	}
	result.merge(get_detail_report());
	const softbody::StabilityReport report =
			softbody::report_stability(*found->shape, *present_settings(), project_gravity(), tick_length(), values_.collision_mask != 0);
	const softbody::MaterialValues &material = material_.values();
	const bool is_network = found->used.model == ELASTIC_MODEL_NETWORK;
	result["automatic_substeps"] = report.automatic.substeps;
	result["automatic_integrator"] = int(report.automatic.integrator);
	result["automatic_safe"] = report.automatic.safe;
	result["stiffness"] = report.stiffness;
	result["strength"] = report.strength;
	result["damping"] = report.damping;
	result["least_damping"] = is_network ? report.least_damping : softbody::Real(0);
	const softbody::Firmness firmness = firmness_of(*found);
	result["youngs_modulus"] = is_network ? 0.0 : material.youngs_modulus;
	result["youngs_modulus_in_use"] = is_network ? 0.0 : material.youngs_modulus * firmness.factor;
	result["firm_factor"] = firmness.factor;
	result["weight_decides"] = firmness.is_least;
	result["poisson_ratio"] = is_network ? 0.0 : material.poisson_ratio;

	result["folds_on_fall"] = !fall_outcome(*found, *present_settings()).keeps_shape();
	const auto copy = make_copy();
	if (!copy) {
		return result;
	}
	auto trial = softbody::LoadTrial::create(copy.value(), project_gravity(), softbody::PIXELS_PER_METER, tick_length());
	if (!trial) {
		return result;
	}
	result["microseconds_per_tick"] = settle(trial.value(), p_time_limit_msec);
	const double tick_msec = MAX(double(result["microseconds_per_tick"]), 1.0) / 1000;
	const int drop_steps = int(MIN(double(MOST_TRIAL_STEPS), 2 * p_time_limit_msec / tick_msec));
	const auto height_of = [&](const softbody::DropCheck &p_check) {
		return double(softbody::find_drop_height(copy.value(), project_gravity(), softbody::PIXELS_PER_METER, tick_length(), drop_steps, p_check));
	};
	if (copy.value().settings().can_dent()) {
		result["dent_drop"] = height_of([](const softbody::SoftBodyData &p_body) { return p_body.is_dented(); });
	}
	if (material.tear_stretch > 0) {
		const auto stretch = softbody::Real(most_bearable_strain());
		result["tear_drop"] = height_of([&](const softbody::SoftBodyData &p_body) { return softbody::is_overstretched(p_body, stretch); });
	}
	const softbody::LoadOutcome outcome = trial.value().outcome();
	result["sag"] = outcome.sag;
	result["area_loss"] = outcome.area_loss;
	result["folds"] = outcome.folded || outcome.area_loss > softbody::FOLDED_AREA_LOSS;
	result["settled"] = outcome.rests;
	double factor = 1;
	if (softbody::needs_more(outcome)) {
		const double step_msec = MAX(double(result["microseconds_per_tick"]), 1.0) / 1000;
		const int steps = int(MIN(double(MOST_TRIAL_STEPS), 5 * p_time_limit_msec / step_msec));
		factor = double(softbody::find_firm_factor(copy.value(), project_gravity(), softbody::PIXELS_PER_METER, tick_length(), steps));
	}
	// Where a trial would take too long, what the rule says of the usual structure.
	const double own = is_network ? material.stiffness : material.youngs_modulus * firmness.factor;
	const double by_rule = report.strength > 0 ? own * double(softbody::FIRM_STRENGTH / report.strength) : double(report.firm_stiffness);
	// As the value to set, which is multiplied for a large load.
	const double firm = (factor > 0 && own > 0 ? factor * own : by_rule) / firmness.for_load;
	result["firm_stiffness"] = is_network ? firm : 0.0;
	result["firm_youngs_modulus"] = is_network ? 0.0 : firm;
	return result;
}

// Elastic modes and triangles hold any shape; of springs only a trial knows.
softbody::FallOutcome SoftBody2D::fall_outcome(const Design &p_design, const softbody::BodySettings &p_settings) const {
	if (rope() != nullptr || p_design.used.model != ELASTIC_MODEL_NETWORK || values_.collision_mask == 0 || !pins_.points().is_empty()) {
		return {};
	}
	if (falls_ == nullptr) {
		falls_ = std::make_unique<softbody::FallMemory>();
	}
	return falls_->outcome_of(p_design.shape, p_settings, project_gravity(), softbody::PIXELS_PER_METER, tick_length());
}

void SoftBody2D::append_stability_warnings(const Design &p_design, PackedStringArray &r_warnings) const {
	const softbody::MaterialValues &material = material_.values();
	const bool is_network = p_design.used.model == ELASTIC_MODEL_NETWORK;
	// A network of its own is no fault. It is one that a material was given and has no effect.
	const softbody::MaterialValues defaults;
	if (decided_by_network_values(p_design) && !(softbody::to_material(material) == softbody::to_material(defaults))) {
		r_warnings.push_back("youngs_modulus, poisson_ratio and damping_ratio have no effect, as raw values of the spring network are set as well (stiffness, damping, shape_matching, shape_damping_ratio or pressure): these are kept and used. To use the material, set elastic_model to Modes; to keep the network without this warning, set it to Network.");
	}
	const auto settings = make_settings(p_design);
	if (!settings) {
		return;
	}
	const softbody::StabilityReport report = softbody::report_stability(*p_design.shape, settings.value(), project_gravity(), tick_length(), values_.collision_mask != 0);
	const softbody::Firmness firmness = firmness_of(p_design);
	if (firmness.is_least) {
		const double least = material.youngs_modulus * firmness.factor / firmness.for_load;
		r_warnings.push_back("Young's modulus " + String::num(material.youngs_modulus) + " N/m is too low for the body's weight: it is made as firm as with " + String::num(std::ceil(least)) + " N/m. Use at least that, less mass or gravity_scale, or switch firm_for_weight off.");
	}
	if (report.is_too_soft()) {
		// What is painted on single springs stays: the node's own value has to make up for it.
		const double own = is_network ? material.stiffness : material.youngs_modulus;
		const double firm = report.strength > 0 ? own * double(softbody::FIRM_STRENGTH / report.strength) : double(report.firm_stiffness);
		const String name = is_network ? "Stiffness " : "Young's modulus ";
		const String end = is_network ? " N/m is too low for the body's weight: it will fold. Use at least " : " N/m is too low for the body's weight: it will be pressed flat. Use at least ";
		r_warnings.push_back(name + String::num(own) + end + String::num(std::ceil(firm)) + " N/m, or less mass or gravity_scale.");
	}
	// A network that carries itself may still have a second, folded shape in which it stays after a fall.
	const bool may_stay_folded = is_network && !report.is_too_soft() && report.strength < UPRIGHT_STRENGTH && values_.least_area < LEAST_HOLDING_AREA;
	if (may_stay_folded) {
		const double upright = material.stiffness * double(UPRIGHT_STRENGTH / report.strength);
		r_warnings.push_back("Stiffness " + String::num(material.stiffness) + " N/m carries the body's weight, but a body that falls may stay folded. Use at least " + String::num(std::ceil(upright)) + " N/m, less mass or gravity_scale, or a least_area of " + String::num(LEAST_HOLDING_AREA) + ".");
	}
	const softbody::FallOutcome fall = report.is_too_soft() || may_stay_folded ? softbody::FallOutcome() : fall_outcome(p_design, settings.value());
	if (!fall.keeps_shape()) {
		const String loss = fall.folded ? String("its outline crosses itself") : String::num_int64(int64_t(std::round(100 * fall.area_loss))) + " % of its area are gone";
		String remedy = "Use a higher stiffness, fewer polygon points, or elastic_model Modes.";
		if (material.shape_matching < softbody::DEFAULT_SHAPE_MATCHING) {
			remedy = "Use a shape_matching of " + String::num(double(softbody::DEFAULT_SHAPE_MATCHING), 2) + ", fewer polygon points, or elastic_model Modes.";
		} else if (report.plan.integrator == softbody::Integrator::XPBD && settings.value().integrator == softbody::Integrator::AUTOMATIC) {
			remedy = "So many points with such springs are solved by XPBD, which does not always hold them. Use fewer polygon points, or elastic_model Modes.";
		}
		r_warnings.push_back("The network does not keep its shape: after a fall by twice its radius " + loss + ". " + remedy);
	}
	if (is_network && report.rings()) {
		const double share = report.damping > 0 ? material.damping / double(report.damping) : 1.0;
		r_warnings.push_back(vformat(String::utf8("Damping %s N·s/m is too low to calm strong deformations. Use at least %s N·s/m."), material.damping, String::num(share * double(report.least_damping), 3)));
	}
	if (!report.plan.safe) {
		const String remedy = is_network ? "the stiffness or the damping" : "youngs_modulus or damping_ratio";
		r_warnings.push_back("With these values a step is not stable in " + String::num_int64(report.plan.substeps) + " substeps. Lower " + remedy + ", raise the mass, use fewer polygon points, or set substeps to 0 (automatic).");
	}
}

// Whether the network is in use for its raw values alone, as in scenes of versions without a material.
bool SoftBody2D::decided_by_network_values(const Design &p_design) {
	return p_design.used.reason == REASON_NETWORK_VALUES;
}

// Once, as it concerns every body of an older project.
void SoftBody2D::tell_network_once() const {
#ifdef DEBUG_ENABLED
	static std::atomic<bool> told = false;
	if (choose_model().reason == REASON_NETWORK_VALUES && !told.exchange(true)) {
		print_line("Note: " + describe() + ", perhaps among others, has raw values of a spring network (stiffness, damping, shape_matching, shape_damping_ratio or pressure), set by a scene or a script. They are kept and used instead of youngs_modulus, poisson_ratio and damping_ratio. Set elastic_model to Network to say that this is meant, or to Modes to use the material.");
	}
#endif
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
	if (rope() == nullptr) { // whose structure follows from its path
		structure_.append_warnings(warnings);
	}
	if (const softbody::Status as_drawn = structure_.check_as_drawn(); as_drawn && material_.values().tear_stretch > 0) {
		warnings.push_back("tear_stretch does nothing: " + to_godot(*as_drawn) + ".");
	}
	if (found != nullptr && rope() == nullptr) { // which is stable, and has no shape to keep
		append_stability_warnings(*found, warnings);
	}
	pins_.append_warnings(*this, get_point_count(), warnings);
	append_drawing_warnings(warnings);
	return warnings;
}

} // namespace godot
