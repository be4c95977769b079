// SPDX-License-Identifier: MIT
// What scripts can ask of the body and do to it: points, forces, measures.
#include "godot/nodes/soft_body_2d.h"

#include "core/geometry/polygon.h"
#include "godot/convert.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <cmath>
#include <string>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

// Points.

std::size_t SoftBody2D::core_index(int p_index) const {
	return std::size_t(public_index(std::size_t(p_index), polygon_reversed_)); // a reversal undoes itself
}

int SoftBody2D::public_index(std::size_t p_core_index, bool p_reversed) const {
	const int index = int(p_core_index);
	const int polygon_count = int(polygon_.size());
	return p_reversed && index < polygon_count ? (polygon_count - index) % polygon_count : index;
}

bool SoftBody2D::check_index(int p_index) const {
	ERR_FAIL_COND_V_MSG(body() == nullptr, false, describe() + ": has no body yet; add the node to the scene tree first.");
	ERR_FAIL_COND_V_MSG(p_index < 0 || p_index >= get_point_count(), false, describe() + ": point index " + itos(p_index) + " must be between 0 and " + itos(get_point_count() - 1) + ".");
	return true;
}

int SoftBody2D::get_point_count() const {
	if (choose_model().model == ELASTIC_MODEL_TRIANGLES) { // it has points of its own inside
		if (const Design *found = design()) {
			return int(found->shape->point_count());
		}
	}
	return int(polygon_.size() + inner_points_.size()) + (center_point_ ? 1 : 0);
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

PackedVector2Array SoftBody2D::get_point_forces() const {
	PackedVector2Array forces;
	if (const softbody::SoftBodyData *found = followed_body()) {
		forces.resize(get_point_count());
		forces.fill(Vector2());
		for (const softbody::ExternalForce &each : found->external_forces()) {
			const int index = public_index(each.point, polygon_reversed_);
			forces.set(index, forces[index] + to_godot(each.force));
		}
	}
	return forces;
}

bool SoftBody2D::check_points(const char *p_what, const PackedVector2Array &p_values) {
	if (!check_index(0)) {
		return false;
	}
	const std::string name = p_what;
	if (p_values.size() != get_point_count()) {
		return accept(p_what, softbody::Error{ name, std::to_string(p_values.size()) + " entries", "must have " + std::to_string(get_point_count()) + " entries, one a point", "give as many as get_point_count()" });
	}
	for (int64_t i = 0; i < p_values.size(); i++) {
		if (!p_values[i].is_finite()) {
			return accept(p_what, softbody::Error{ name + "[" + std::to_string(i) + "]", "non-finite", "must be finite", "check the computation that produced this value" });
		}
	}
	return accept(p_what, {});
}

void SoftBody2D::set_point_positions(const PackedVector2Array &p_positions) {
	if (check_points("positions", p_positions)) {
		softbody::SoftBodyData &target = *followed_body();
		for (int i = 0; i < get_point_count(); i++) {
			const std::size_t index = core_index(i);
			target.set_point(uint32_t(index), to_core(p_positions[i]), target.velocities()[index]);
		}
		follow_body();
	}
}

void SoftBody2D::set_point_velocities(const PackedVector2Array &p_velocities) {
	if (check_points("velocities", p_velocities)) {
		softbody::SoftBodyData &target = *followed_body();
		for (int i = 0; i < get_point_count(); i++) {
			const std::size_t index = core_index(i);
			target.set_point(uint32_t(index), target.positions()[index], to_core(p_velocities[i]));
		}
	}
}

void SoftBody2D::set_point_position(int p_index, const Vector2 &p_position) {
	if (check_index(p_index)) {
		softbody::SoftBodyData &target = *followed_body();
		const std::size_t index = core_index(p_index);
		if (accept("position", target.set_point(uint32_t(index), to_core(p_position), target.velocities()[index]))) {
			follow_body();
		}
	}
}

void SoftBody2D::set_point_velocity(int p_index, const Vector2 &p_velocity) {
	if (check_index(p_index)) {
		softbody::SoftBodyData &target = *followed_body();
		const std::size_t index = core_index(p_index);
		accept("velocity", target.set_point(uint32_t(index), target.positions()[index], to_core(p_velocity)));
	}
}

void SoftBody2D::apply_point_forces(const PackedVector2Array &p_forces) {
	if (check_points("forces", p_forces)) {
		for (int i = 0; i < get_point_count(); i++) {
			followed_body()->add_external_force(uint32_t(core_index(i)), to_core(p_forces[i]));
		}
	}
}

// Measures.

double SoftBody2D::get_area() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(softbody::signed_area(found->hull())) : get_rest_area();
}

double SoftBody2D::get_rest_area() const {
	const softbody::SoftBodyData *found = followed_body();
	return found ? double(found->shape().rest_area()) : std::abs(double(softbody::signed_area(to_core(polygon_))));
}

double SoftBody2D::get_penetration() const {
	const softbody::SoftBodyData *found = followed_body();
	return found && space_ ? double(softbody::measure_penetration(space_->world(), *found)) : 0.0;
}

void SoftBody2D::bind_points() {
	ClassDB::bind_method(D_METHOD("get_point_count"), &SoftBody2D::get_point_count);
	ClassDB::bind_method(D_METHOD("get_point_positions"), &SoftBody2D::get_point_positions);
	ClassDB::bind_method(D_METHOD("get_point_velocities"), &SoftBody2D::get_point_velocities);
	ClassDB::bind_method(D_METHOD("get_point_forces"), &SoftBody2D::get_point_forces);
	ClassDB::bind_method(D_METHOD("set_point_positions", "positions"), &SoftBody2D::set_point_positions);
	ClassDB::bind_method(D_METHOD("set_point_velocities", "velocities"), &SoftBody2D::set_point_velocities);
	ClassDB::bind_method(D_METHOD("set_point_position", "index", "position"), &SoftBody2D::set_point_position);
	ClassDB::bind_method(D_METHOD("set_point_velocity", "index", "velocity"), &SoftBody2D::set_point_velocity);
	ClassDB::bind_method(D_METHOD("apply_point_forces", "forces"), &SoftBody2D::apply_point_forces);
	ClassDB::bind_method(D_METHOD("get_nearest_point", "global_position"), &SoftBody2D::get_nearest_point);
	ClassDB::bind_method(D_METHOD("has_point", "global_position"), &SoftBody2D::has_point);
	ClassDB::bind_method(D_METHOD("apply_point_force", "index", "force"), &SoftBody2D::apply_point_force);
	ClassDB::bind_method(D_METHOD("apply_point_impulse", "index", "impulse"), &SoftBody2D::apply_point_impulse);
	ClassDB::bind_method(D_METHOD("get_area"), &SoftBody2D::get_area);
	ClassDB::bind_method(D_METHOD("get_rest_area"), &SoftBody2D::get_rest_area);
	ClassDB::bind_method(D_METHOD("get_penetration"), &SoftBody2D::get_penetration);
}

} // namespace godot
