// SPDX-License-Identifier: MIT
// What scripts can ask of the body and do to it: points, forces, measures.
#include "godot/nodes/soft_body_2d.h"

#include "core/dynamics/energy.h"
#include "core/dynamics/substep_plan.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "godot/convert.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <cmath>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

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

} // namespace

// Points.

std::size_t SoftBody2D::core_index(int p_index) const {
	const int hull_count = int(hull_.size());
	return std::size_t(hull_reversed_ && p_index < hull_count ? (hull_count - p_index) % hull_count : p_index);
}

bool SoftBody2D::check_index(int p_index) const {
	ERR_FAIL_COND_V_MSG(body() == nullptr, false, describe() + ": has no body yet; add the node to the scene tree first.");
	ERR_FAIL_COND_V_MSG(p_index < 0 || p_index >= get_point_count(), false, describe() + ": point index " + itos(p_index) + " must be between 0 and " + itos(get_point_count() - 1) + ".");
	return true;
}

int SoftBody2D::get_point_count() const {
	return int(hull_.size()) + (center_point_ ? 1 : 0);
}

PackedVector2Array SoftBody2D::get_point_positions() const {
	PackedVector2Array points;
	if (const softbody::SoftBodyData *found = followed_body()) {
		for (int i = 0; i < get_point_count(); i++) {
			points.push_back(to_godot(found->positions()[core_index(i)]));
		}
	}
	return points;
}

PackedVector2Array SoftBody2D::get_point_velocities() const {
	PackedVector2Array velocities;
	if (const softbody::SoftBodyData *found = followed_body()) {
		for (int i = 0; i < get_point_count(); i++) {
			velocities.push_back(to_godot(found->velocities()[core_index(i)]));
		}
	}
	return velocities;
}

PackedVector2Array SoftBody2D::get_interpolated_hull(double p_fraction) const {
	ERR_FAIL_COND_V_MSG(!(p_fraction >= 0 && p_fraction <= 1), PackedVector2Array(), describe() + ": fraction = " + String::num(p_fraction) + " must be between 0 and 1.");
	const PackedVector2Array points = interpolated_points(p_fraction, Transform2D());
	PackedVector2Array hull;
	for (int i = 0; i < int(hull_.size()) && !points.is_empty(); i++) {
		hull.push_back(points[int64_t(core_index(i))]);
	}
	return hull;
}

int SoftBody2D::get_nearest_point(const Vector2 &p_global_position) const {
	const PackedVector2Array points = get_point_positions();
	int nearest = -1;
	for (int i = 0; i < int(points.size()); i++) {
		if (nearest < 0 || points[i].distance_squared_to(p_global_position) < points[nearest].distance_squared_to(p_global_position)) {
			nearest = i;
		}
	}
	return nearest;
}

bool SoftBody2D::has_point(const Vector2 &p_global_position) const {
	const softbody::SoftBodyData *found = followed_body();
	return found != nullptr && softbody::point_in_polygon(to_core(p_global_position), found->hull());
}

// Forces.

void SoftBody2D::apply_point_force(int p_index, const Vector2 &p_force) {
	if (check_index(p_index)) {
		accept("force", followed_body()->add_external_force(uint32_t(core_index(p_index)), to_core(p_force)));
	}
}

void SoftBody2D::apply_point_impulse(int p_index, const Vector2 &p_impulse) {
	if (check_index(p_index)) {
		accept("impulse", followed_body()->apply_impulse(uint32_t(core_index(p_index)), to_core(p_impulse)));
	}
}

void SoftBody2D::apply_central_force(const Vector2 &p_force) {
	if (!check_index(0)) {
		return;
	}
	softbody::SoftBodyData &target = *followed_body();
	const softbody::SoftBodyShape &shape = target.shape();
	for (uint32_t i = 0; i < shape.point_count(); i++) {
		if (!accept("force", target.add_external_force(i, to_core(p_force) * (shape.masses()[i] / shape.total_mass())))) {
			return;
		}
	}
}

void SoftBody2D::apply_central_impulse(const Vector2 &p_impulse) {
	if (!check_index(0)) {
		return;
	}
	softbody::SoftBodyData &target = *followed_body();
	const softbody::SoftBodyShape &shape = target.shape();
	for (uint32_t i = 0; i < shape.point_count(); i++) {
		if (!accept("impulse", target.apply_impulse(i, to_core(p_impulse) * (shape.masses()[i] / shape.total_mass())))) {
			return;
		}
	}
}

// Measures.

Vector2 SoftBody2D::get_center_of_mass_position() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? to_godot(softbody::measure_frame(*found).centre) : get_global_position();
}

Vector2 SoftBody2D::get_linear_velocity() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? to_godot(softbody::measure_frame(*found).velocity) : Vector2();
}

double SoftBody2D::get_angular_velocity() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(softbody::measure_frame(*found).angular_velocity) : 0.0;
}

double SoftBody2D::get_area() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(softbody::signed_area(found->hull())) : get_rest_area();
}

double SoftBody2D::get_rest_area() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(found->shape().rest_area()) : std::abs(double(softbody::signed_area(to_core(hull_))));
}

double SoftBody2D::get_kinetic_energy() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? softbody::measure_energy(*found, {}).kinetic : 0.0;
}

double SoftBody2D::get_penetration() const {
	const softbody::SoftBodyData *found = followed_body();
	return found && space_ ? double(softbody::measure_penetration(space_->world(), *found)) : 0.0;
}

Dictionary SoftBody2D::get_substep_plan() const {
	const auto shape = make_shape(body() ? built_scale_ : get_transform());
	Dictionary result;
	if (!shape) {
		return result;
	}
	const double delta = 1.0 / Engine::get_singleton()->get_physics_ticks_per_second();
	const softbody::SubstepPlan plan =
			softbody::plan_substeps(*shape.value(), make_settings(), softbody::Real(delta), collision_mask_ != 0);
	result["frequency"] = plan.frequency;
	result["damping_rate"] = plan.damping_rate;
	result["integrator"] = int(plan.integrator);
	result["substeps"] = plan.substeps;
	result["stability_margin"] = plan.stability_margin;
	result["safe"] = plan.safe;
	result["reason"] = reason_text(plan.reason);
	result["cost"] = plan.cost;
	return result;
}

void SoftBody2D::bind_motion() {
	ClassDB::bind_method(D_METHOD("apply_central_force", "force"), &SoftBody2D::apply_central_force);
	ClassDB::bind_method(D_METHOD("apply_central_impulse", "impulse"), &SoftBody2D::apply_central_impulse);
	ClassDB::bind_method(D_METHOD("get_center_of_mass_position"), &SoftBody2D::get_center_of_mass_position);
	ClassDB::bind_method(D_METHOD("get_linear_velocity"), &SoftBody2D::get_linear_velocity);
	ClassDB::bind_method(D_METHOD("get_angular_velocity"), &SoftBody2D::get_angular_velocity);
	ClassDB::bind_method(D_METHOD("get_kinetic_energy"), &SoftBody2D::get_kinetic_energy);
}

void SoftBody2D::bind_points() {
	ClassDB::bind_method(D_METHOD("get_point_count"), &SoftBody2D::get_point_count);
	ClassDB::bind_method(D_METHOD("get_point_positions"), &SoftBody2D::get_point_positions);
	ClassDB::bind_method(D_METHOD("get_point_velocities"), &SoftBody2D::get_point_velocities);
	ClassDB::bind_method(D_METHOD("get_nearest_point", "global_position"), &SoftBody2D::get_nearest_point);
	ClassDB::bind_method(D_METHOD("has_point", "global_position"), &SoftBody2D::has_point);
	ClassDB::bind_method(D_METHOD("apply_point_force", "index", "force"), &SoftBody2D::apply_point_force);
	ClassDB::bind_method(D_METHOD("apply_point_impulse", "index", "impulse"), &SoftBody2D::apply_point_impulse);
	ClassDB::bind_method(D_METHOD("get_area"), &SoftBody2D::get_area);
	ClassDB::bind_method(D_METHOD("get_rest_area"), &SoftBody2D::get_rest_area);
	ClassDB::bind_method(D_METHOD("get_penetration"), &SoftBody2D::get_penetration);
	ClassDB::bind_method(D_METHOD("reset"), &SoftBody2D::reset);
}

} // namespace godot
