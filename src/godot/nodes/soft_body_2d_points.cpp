// SPDX-License-Identifier: MIT
// What scripts can ask of the points of the body and do to them: places, forces, pins, the state as bytes.
#include "godot/nodes/soft_body_2d.h"

#include "core/geometry/polygon.h"
#include "core/model/body_state.h"
#include "godot/convert.h"
#include "godot/nodes/body_cuts.h"
#include "godot/nodes/cut_history.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>

#include <cmath>
#include <string>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

// Points.

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
	return structure_.point_count();
}

// Of the points in the user's order.
PackedVector2Array SoftBody2D::in_user_order(std::span<const softbody::Vec2> p_values) const {
	PackedVector2Array values;
	values.resize(get_point_count());
	Vector2 *write = values.ptrw();
	for (int i = 0; i < int(values.size()); i++) {
		write[i] = to_godot(p_values[core_index(i)]);
	}
	return values;
}

PackedVector2Array SoftBody2D::get_point_positions() const {
	const softbody::SoftBodyData *found = followed_body();
	return found != nullptr ? in_user_order(found->positions()) : PackedVector2Array();
}

PackedVector2Array SoftBody2D::get_point_velocities() const {
	const softbody::SoftBodyData *found = followed_body();
	return found != nullptr ? in_user_order(found->velocities()) : PackedVector2Array();
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
			const int index = order().mirror(int(each.point));
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
	return accept(p_what, softbody::check_all_finite(name, p_values));
}

// Places and velocities of points. A point keeps the one of the two that is not given.

softbody::Status SoftBody2D::set_point(int p_index, const Vector2 *p_position, const Vector2 *p_velocity) {
	softbody::SoftBodyData &target = *followed_body();
	const std::size_t index = core_index(p_index);
	return target.set_point(uint32_t(index), p_position != nullptr ? to_core(*p_position) : target.positions()[index], p_velocity != nullptr ? to_core(*p_velocity) : target.velocities()[index]);
}

void SoftBody2D::set_point_positions(const PackedVector2Array &p_positions) {
	if (check_points("positions", p_positions)) {
		for (int i = 0; i < get_point_count(); i++) {
			set_point(i, &p_positions[i], nullptr);
		}
		follow_body();
	}
}

void SoftBody2D::set_point_velocities(const PackedVector2Array &p_velocities) {
	if (check_points("velocities", p_velocities)) {
		for (int i = 0; i < get_point_count(); i++) {
			set_point(i, nullptr, &p_velocities[i]);
		}
	}
}

void SoftBody2D::set_point_position(int p_index, const Vector2 &p_position) {
	if (check_index(p_index) && accept("position", set_point(p_index, &p_position, nullptr))) {
		follow_body();
	}
}

void SoftBody2D::set_point_velocity(int p_index, const Vector2 &p_velocity) {
	if (check_index(p_index)) {
		accept("velocity", set_point(p_index, nullptr, &p_velocity));
	}
}

void SoftBody2D::apply_point_forces(const PackedVector2Array &p_forces) {
	if (check_points("forces", p_forces)) {
		for (int i = 0; i < get_point_count(); i++) {
			followed_body()->add_external_force(uint32_t(core_index(i)), to_core(p_forces[i]));
		}
	}
}

void SoftBody2D::push_by_fluid(const PackedVector2Array &p_forces, bool p_flows) {
	softbody::SoftBodyData *target = followed_body();
	if (p_flows) {
		target->wake();
	}
	for (int i = 0; i < get_point_count(); i++) {
		accept("force", target->add_fluid_force(uint32_t(core_index(i)), to_core(p_forces[i])));
	}
}

// Measures.

double SoftBody2D::get_penetration() const {
	const softbody::SoftBodyData *found = followed_body();
	return found && space_ ? double(softbody::measure_penetration(space_->world(), *found)) : 0.0;
}

// Points that are held in place, or at another node: `BodyPins` for scripts.

void SoftBody2D::set_pinned_points(const PackedInt32Array &p_points) {
	if (accept("pinned_points", softbody::BodyPins::check(p_points))) {
		pins_.set_points(p_points);
		apply_pins();
		update_configuration_warnings();
	}
}

void SoftBody2D::set_pin_targets(const TypedArray<NodePath> &p_targets) {
	pins_.set_targets(p_targets);
	note_change();
	update_configuration_warnings();
}

void SoftBody2D::set_point_pinned(int p_index, bool p_pinned, const NodePath &p_target) {
	ERR_FAIL_COND_MSG(p_index < 0 || p_index >= get_point_count(), describe() + ": point index " + itos(p_index) + " must be between 0 and " + itos(get_point_count() - 1) + ".");
	if (!p_pinned) {
		pins_.unpin(p_index);
	} else if (!pins_.pin(p_index, p_target)) {
		return;
	}
	apply_pins();
	update_configuration_warnings();
}

void SoftBody2D::apply_pins() {
	softbody::SoftBodyData *found = body();
	note_change();
	if (const softbody::Status refused = found != nullptr ? pins_.apply(*found, order()) : softbody::Status()) {
		accept("pinned_points", refused);
	}
}

void SoftBody2D::follow_pin_targets() {
	softbody::SoftBodyData *found = body();
	if (found == nullptr || pins_.points().is_empty()) {
		return;
	}
	if (const softbody::Status refused = pins_.follow(*this, *found, order())) {
		accept("pin_targets", refused);
	}
}

// The state of the body as bytes, for rollback, replays and saved games.

PackedByteArray SoftBody2D::get_state() const {
	const softbody::SoftBodyData *found = followed_body();
	ERR_FAIL_NULL_V_MSG(found, {}, describe() + ": has no body yet; add the node to the scene tree first.");
	if (cuts_.is_empty()) {
		return softbody::to_bytes(found->save_state(), nullptr);
	}
	const softbody::CutStructure structure = softbody::BodyCuts::structure_of(*this);
	return softbody::to_bytes(found->save_state(), &structure);
}

Error SoftBody2D::set_state(const PackedByteArray &p_state) {
	softbody::SoftBodyData *found = followed_body();
	ERR_FAIL_NULL_V_MSG(found, ERR_UNCONFIGURED, describe() + ": has no body yet; add the node to the scene tree first.");
	const auto state = softbody::node_state_from_bytes(p_state);
	softbody::Status status = state ? softbody::BodyCuts(*this).become(state.value()) : softbody::Status(state.error());
	if (!status) {
		found = body();
		status = found->restore_state(state.value().body);
	}
	ERR_FAIL_COND_V_MSG(status, ERR_INVALID_DATA, describe() + ": state refused: " + softbody::to_godot(*status) + ". The body goes on as it was.");
	follow_body();
	found->set_rotation_memory(state.value().body.rotation_memory); // which the node's following measured anew
	if (!is_held_static()) {
		freeze_ = found->is_frozen();
	}
	apply_freeze();
	sleeping_ = found->is_asleep();
	pins_.take_over(*found, order());
	return OK;
}

} // namespace godot
