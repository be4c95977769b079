// SPDX-License-Identifier: MIT
// What a node is made of, and how its surface grips.
#include "godot/nodes/body_material.h"

#include "core/model/contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

const MaterialValues DEFAULT_VALUES;

// PhysicsMaterial keeps single precision.
bool is_same(double p_a, double p_b) {
	return float(p_a) == float(p_b);
}

} // namespace

bool BodyMaterial::Surface::is_plain(double p_friction, double p_bounce) const {
	return !rough && !absorbent && is_same(friction, p_friction) && is_same(bounce, p_bounce);
}

const MaterialValues &BodyMaterial::values() const {
	if (shared_.is_valid()) {
		return shared_->values();
	}
	return own_.is_valid() ? own_->values() : DEFAULT_VALUES;
}

void BodyMaterial::share(const Ref<SoftBodyMaterial2D> &p_material, const Callable &p_changed) {
	if (p_material.is_valid() && p_material == own_) {
		own_.unref();
	}
	replace_resource(shared_, p_material, p_changed);
}

Ref<SoftBodyMaterial2D> BodyMaterial::in_use(const Callable &p_changed) {
	if (shared_.is_valid()) {
		return shared_;
	}
	exchange_own(values());
	replace_resource(own_, own_, p_changed);
	return own_;
}

MaterialValues BodyMaterial::exchange_own(const MaterialValues &p_values) {
	if (own_.is_null()) {
		own_.instantiate();
	}
	return own_->exchange_values(p_values);
}

void BodyMaterial::set_surface_override(const Ref<PhysicsMaterial> &p_material, const Callable &p_changed) {
	replace_resource(surface_material_, p_material, p_changed);
	surface_.reset();
}

// The engine hands "rough" and "absorbent" on as a negative sign, so a negative value means the same there, and here.
Status BodyMaterial::read_surface_override() {
	if (surface_material_.is_null()) {
		surface_.reset();
		return {};
	}
	const double friction = signed_friction(Real(surface_material_->get_friction()), surface_material_->is_rough());
	const double bounce = signed_restitution(Real(surface_material_->get_bounce()), surface_material_->is_absorbent());
	Status status = check_finite("friction", friction, "");
	if (!status) {
		status = check_finite("bounce", bounce, "");
	}
	if (!status) {
		surface_ = Surface{ std::abs(friction), std::min(std::abs(bounce), 1.0), friction < 0, bounce < 0 };
	}
	return status;
}

BodyMaterial::Surface BodyMaterial::surface() const {
	return surface_.value_or(Surface{ values().friction, values().bounce });
}

Ref<PhysicsMaterial> BodyMaterial::make_physics_material(const Surface &p_surface) {
	Ref<PhysicsMaterial> material;
	material.instantiate();
	material->set_friction(p_surface.friction);
	material->set_rough(p_surface.rough);
	material->set_bounce(p_surface.bounce);
	material->set_absorbent(p_surface.absorbent);
	return material;
}

MaterialPresets::Preset BodyMaterial::preset() const {
	const Surface in_use = surface();
	MaterialValues like = values();
	like.friction = in_use.friction;
	like.bounce = in_use.bounce;
	return in_use.rough || in_use.absorbent ? MaterialPresets::PRESET_CUSTOM : preset_of(like);
}

Ref<PhysicsMaterial> BodyMaterial::override_for(double p_friction, double p_bounce) const {
	if (surface().is_plain(p_friction, p_bounce)) {
		return surface_material_;
	}
	const bool is_own = Surface{ values().friction, values().bounce }.is_plain(p_friction, p_bounce);
	return is_own ? Ref<PhysicsMaterial>() : make_physics_material({ p_friction, p_bounce });
}

} // namespace softbody
