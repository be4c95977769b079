// SPDX-License-Identifier: MIT
// The node that makes an area of water or wind.
#include "godot/nodes/soft_body_fluid_2d.h"

#include "core/base/constants.h"
#include "core/base/hash.h"
#include "core/base/value_range.h"
#include "core/geometry/aabb.h"
#include "godot/convert.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/resources/property_binding.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/surroundings/fluid_region.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/object.hpp>

#include <algorithm>
#include <bit>
#include <vector>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

// Change of a point's speed in a tick below which the fluid leaves a body alone [px/s]. Larger: a light breeze is not felt.
constexpr softbody::Real LEAST_PUSH = softbody::Real(0.01);

} // namespace

String SoftBodyFluid2D::describe() const {
	return "SoftBodyFluid2D '" + String(get_name()) + "'" + (is_inside_tree() ? " (" + String(get_path()) + ")" : String());
}

void SoftBodyFluid2D::set_checked(const char *p_name, double &r_value, double p_value, const char *p_unit) {
	if (const softbody::Status status = softbody::ValueRange::at_least(0, p_unit).check(p_name, p_value)) {
		ERR_FAIL_MSG(describe() + ": " + p_name + " refused: " + to_godot(status->message()) + ". The old value stays.");
	}
	r_value = p_value;
}

void SoftBodyFluid2D::set_flow(const Vector2 &p_flow) {
	ERR_FAIL_COND_MSG(!p_flow.is_finite(), describe() + ": flow refused: " + String(p_flow) + " must be finite px/s. The old value stays.");
	flow_ = p_flow;
}

PackedStringArray SoftBodyFluid2D::get_warnings() const {
	PackedStringArray warnings;
	unfit_.append_warnings(warnings);
	if (!is_monitoring()) {
		warnings.push_back("'monitoring' is off, so the fluid finds no body. Switch it on.");
	}
	return warnings;
}

SoftBodyFluid2D::~SoftBodyFluid2D() {
	leave_space();
}

void SoftBodyFluid2D::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE: {
			unfit_.tell(*this);
			enter_space();
		} break;
		case NOTIFICATION_EXIT_TREE: {
			leave_space();
		} break;
		case NOTIFICATION_WORLD_2D_CHANGED: {
			if (space_ != nullptr) {
				leave_space();
				enter_space();
			}
		} break;
		default:
			break;
	}
}

void SoftBodyFluid2D::enter_space() {
	if (!Engine::get_singleton()->is_editor_hint()) {
		space_ = &SoftBodySimulation2D::get_singleton()->space_of(this);
		space_->add_fluid(*this);
	}
}

void SoftBodyFluid2D::leave_space() {
	if (space_ != nullptr) {
		space_->remove_fluid(*this);
		space_ = nullptr;
		SoftBodySimulation2D::get_singleton()->drop_empty_spaces();
	}
}

bool SoftBodyFluid2D::look() {
	region_.clear();
	number_ = 0;
	if (!is_monitoring() || density_ == 0 || get_collision_mask() == 0 || !can_process()) {
		return false;
	}
	region_ = softbody::read_fluid_region(*this);
	global_flow_ = to_core(get_global_transform().basis_xform(flow_));
	reach_ = {};
	softbody::Hash hash;
	for (const std::vector<softbody::Vec2> &part : region_) {
		reach_.include(softbody::bounding_box(part));
		hash.add(uint64_t(part.size()));
		for (const softbody::Vec2 corner : part) {
			hash.add(corner);
		}
	}
	for (const double value : { density_, drag_, viscosity_ }) {
		hash.add(std::bit_cast<uint64_t>(value));
	}
	hash.add(global_flow_);
	if (buoyancy_enabled_) {
		number_ = std::max(hash.value(), uint64_t(1));
	}
	return !region_.empty();
}

// The bodies that an area would find, as they are now: the engine tells of overlaps a tick or two late, and not at all between steps
// that a game makes by itself.
bool SoftBodyFluid2D::reaches(const softbody::SoftBodyData &p_body, const softbody::Aabb &p_box) const {
	return (p_body.settings().collision_layer & get_collision_mask()) != 0 && reach_.overlaps(p_box);
}

void SoftBodyFluid2D::push(softbody::SteppedNode &r_node, double p_delta) {
	SoftBody2D *node = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(r_node.instance_id()));
	if (node == nullptr) {
		return;
	}
	SoftBody2D &r_body = *node;
	const PackedVector2Array places = r_body.get_point_positions();
	const PackedVector2Array velocities = r_body.get_point_velocities();
	const std::size_t hull_count = std::size_t(r_body.get_simulated_polygon().size());
	if (places.size() < int64_t(hull_count) || velocities.size() != places.size()) {
		return;
	}
	std::vector<softbody::Vec2> hull;
	std::vector<softbody::Vec2> speeds;
	for (std::size_t i = 0; i < hull_count; i++) {
		hull.push_back(to_core(places[int64_t(i)]));
		speeds.push_back(to_core(velocities[int64_t(i)]));
	}
	constexpr double PIXELS = double(softbody::PIXELS_PER_METER) * softbody::PIXELS_PER_METER;
	softbody::Fluid fluid;
	fluid.density = softbody::Real(density_ / PIXELS);
	fluid.drag = softbody::Real(drag_);
	fluid.viscosity = softbody::Real(viscosity_);
	fluid.flow = global_flow_;
	if (buoyancy_enabled_) {
		fluid.gravity = to_core(r_body.get_gravity());
	}
	if (const softbody::Status status = softbody::check_fluid(fluid)) {
		ERR_PRINT_ONCE(describe() + ": no force on " + r_body.describe() + ": " + to_godot(status->message()) + ".");
		return;
	}
	const softbody::Real point_mass = softbody::Real(r_body.get_mass() / double(places.size()));
	const softbody::Real time_step = softbody::Real(p_delta);
	std::vector<softbody::Vec2> forces(hull_count);
	for (const std::vector<softbody::Vec2> &part : region_) {
		softbody::add_fluid_forces(fluid, part, hull, speeds, point_mass, time_step, forces);
	}
	PackedVector2Array pushes;
	pushes.resize(places.size());
	pushes.fill(Vector2());
	bool is_pushed = false;
	for (std::size_t i = 0; i < hull_count; i++) {
		pushes[int64_t(i)] = to_godot(forces[i]);
		is_pushed = is_pushed || length(forces[i]) * time_step > LEAST_PUSH * point_mass;
	}
	// Without the bound a body that lies in a faint breeze could not sleep. What a fluid moves along is awake, however slowly it drifts.
	if (is_pushed) {
		r_body.push_by_fluid(pushes, flows());
	}
}

void SoftBodyFluid2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBodyFluid2D::get_warnings);

	ADD_GROUP("Fluid", "");
	softbody::bind_property("density", &SoftBodyFluid2D::set_density, &SoftBodyFluid2D::get_density, PROPERTY_HINT_RANGE, "0,20,0.001,or_greater,suffix:kg/m²");
	softbody::bind_property("buoyancy_enabled", &SoftBodyFluid2D::set_buoyancy_enabled, &SoftBodyFluid2D::is_buoyancy_enabled, PROPERTY_HINT_NONE, "", "is_buoyancy_enabled");
	softbody::bind_property("flow", &SoftBodyFluid2D::set_flow, &SoftBodyFluid2D::get_flow, PROPERTY_HINT_NONE, "suffix:px/s");
	softbody::bind_property("drag", &SoftBodyFluid2D::set_drag, &SoftBodyFluid2D::get_drag, PROPERTY_HINT_RANGE, "0,10,0.01,or_greater");
	softbody::bind_property("viscosity", &SoftBodyFluid2D::set_viscosity, &SoftBodyFluid2D::get_viscosity, PROPERTY_HINT_RANGE, "0,20,0.01,or_greater,suffix:1/s");
}

} // namespace godot
