// SPDX-License-Identifier: MIT
// The node's surface: friction and bounce of a PhysicsMaterial, or those of what the body is made of.
#include "godot/nodes/soft_body_2d.h"

#include <godot_cpp/core/class_db.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace godot {

namespace {

// PhysicsMaterial keeps single precision.
bool is_same(double p_a, double p_b) {
	return float(p_a) == float(p_b);
}

} // namespace

bool SoftBody2D::Surface::is_plain(double p_friction, double p_bounce) const {
	return !rough && !absorbent && is_same(friction, p_friction) && is_same(bounce, p_bounce);
}

SoftBody2D::Surface SoftBody2D::surface() const {
	const softbody::MaterialValues &material = material_values();
	return surface_override_ ? *surface_override_ : Surface{ material.friction, material.bounce };
}

void SoftBody2D::set_physics_material_override(const Ref<PhysicsMaterial> &p_material) {
	if (p_material == physics_material_override_) {
		return;
	}
	const Callable listener = own_callable("_take_over_physics_material");
	if (physics_material_override_.is_valid()) {
		physics_material_override_->disconnect("changed", listener);
	}
	physics_material_override_ = p_material;
	if (physics_material_override_.is_valid() && !physics_material_override_->is_connected("changed", listener)) {
		physics_material_override_->connect("changed", listener);
	}
	surface_override_.reset();
	take_over_physics_material();
}

// The engine hands "rough" and "absorbent" on as a negative sign, so a negative value means the same there, and here.
void SoftBody2D::take_over_physics_material() {
	const StringName property = "physics_material_override";
	if (physics_material_override_.is_null()) {
		accept(property, {});
		surface_override_.reset();
		apply_settings();
		return;
	}
	const PhysicsMaterial &material = **physics_material_override_;
	const double friction = softbody::signed_friction(softbody::Real(material.get_friction()), material.is_rough());
	const double bounce = softbody::signed_restitution(softbody::Real(material.get_bounce()), material.is_absorbent());
	softbody::Status status = softbody::check_finite("friction", friction, "");
	if (!status) {
		status = softbody::check_finite("bounce", bounce, "");
	}
	if (accept(property, status)) {
		surface_override_ = Surface{ std::abs(friction), std::min(std::abs(bounce), 1.0), friction < 0, bounce < 0 };
		apply_settings();
	}
}

SoftBodyMaterial2D::Preset SoftBody2D::get_preset() const {
	const Surface surface = surface_override_.value_or(Surface{ own_material_.friction, own_material_.bounce });
	for (int preset = 1; preset < softbody::MATERIAL_PRESET_COUNT; preset++) {
		softbody::MaterialValues like = own_material_;
		softbody::apply_preset(softbody::MaterialPreset(preset), like);
		const bool has_surface = surface.is_plain(like.friction, like.bounce);
		like.friction = own_material_.friction;
		like.bounce = own_material_.bounce;
		if (has_surface && like == own_material_) {
			return SoftBodyMaterial2D::Preset(preset);
		}
	}
	return SoftBodyMaterial2D::PRESET_CUSTOM;
}

// A PhysicsMaterial that other nodes may share is replaced, never changed.
void SoftBody2D::set_preset(SoftBodyMaterial2D::Preset p_preset) {
	if (!accept("preset", softbody::check_between("preset", p_preset, 0, softbody::MATERIAL_PRESET_COUNT - 1, "")) || p_preset == SoftBodyMaterial2D::PRESET_CUSTOM) {
		return;
	}
	softbody::MaterialValues changed = own_material_;
	softbody::apply_preset(softbody::MaterialPreset(p_preset), changed);
	const double friction = std::exchange(changed.friction, own_material_.friction);
	const double bounce = std::exchange(changed.bounce, own_material_.bounce);
	if (!take_over_own_values("preset", changed)) {
		return;
	}
	if (surface_override_.value_or(Surface{ own_material_.friction, own_material_.bounce }).is_plain(friction, bounce)) {
		return;
	}
	if (Surface{ own_material_.friction, own_material_.bounce }.is_plain(friction, bounce)) {
		set_physics_material_override({});
	} else {
		set_physics_material_override(make_physics_material({ friction, bounce }));
	}
}

Ref<PhysicsMaterial> SoftBody2D::make_physics_material(const Surface &p_surface) {
	Ref<PhysicsMaterial> material;
	material.instantiate();
	material->set_friction(p_surface.friction);
	material->set_rough(p_surface.rough);
	material->set_bounce(p_surface.bounce);
	material->set_absorbent(p_surface.absorbent);
	return material;
}

void SoftBody2D::bind_surface() {
	ClassDB::bind_method(D_METHOD("set_physics_material_override", "physics_material_override"), &SoftBody2D::set_physics_material_override);
	ClassDB::bind_method(D_METHOD("get_physics_material_override"), &SoftBody2D::get_physics_material_override);
	ClassDB::bind_method(D_METHOD("_take_over_physics_material"), &SoftBody2D::take_over_physics_material);
}

} // namespace godot
