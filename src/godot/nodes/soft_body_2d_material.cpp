// SPDX-License-Identifier: MIT
// What the node is made of: its own material, or one that it shares with others, and a PhysicsMaterial over either.
#include "godot/nodes/soft_body_2d.h"

#include "core/model/model_choice.h"
#include "godot/convert.h"

#include <godot_cpp/classes/engine.hpp>

#include <algorithm>
#include <utility>

namespace godot {

namespace {

const char *const REASON_CHOSEN = "chosen";
const char *const REASON_OWN_SPRINGS = "own_springs";
const char *const REASON_PAINTED_SPRINGS = "painted_springs";
const char *const REASON_MATERIAL = "material";

} // namespace

const char *const SoftBody2D::REASON_NETWORK_VALUES = "network_values";

// A scene and a script mean what they set; what is edited in the inspector counts while it differs from the default, so that
// it can be taken back.
void SoftBody2D::set_own_material_value(const softbody::MaterialField &p_field, double p_value) {
	const StringName property = p_field.name;
	if (leaves_to_shared_material(property) || !accept(property, p_field.check(p_value))) {
		return;
	}
	softbody::MaterialValues changed = material_.values();
	changed.*p_field.value = p_value;
	softbody::note_set(changed, p_field, !Engine::get_singleton()->is_editor_hint() || !is_inside_tree());
	take_over_own_values(property, changed);
}

// One source of values at a time: with a shared material the node's properties show that one's values, and are not set here.
bool SoftBody2D::leaves_to_shared_material(const StringName &p_property) {
	if (material_.is_shared()) {
		unfit_.note_former(*this, "soft_body_material", vformat("'%s' was not set, as the body is made of its 'soft_body_material': set the value there, or take that material away first. Scenes of earlier versions kept values of the node beside a shared material, where they had no effect; save the scene to drop them.", p_property));
	}
	return material_.is_shared();
}

bool SoftBody2D::take_over_own_values(const StringName &p_property, const softbody::MaterialValues &p_values) {
	const softbody::MaterialValues old = material_.exchange_own(p_values);
	if (!accept_values(p_property)) {
		material_.exchange_own(old);
		return false;
	}
	apply_shape();
	material_.tell_own();
	return true;
}

void SoftBody2D::set_network_values_set(bool p_set) {
	if (p_set == has_network_values() || leaves_to_shared_material("network_values_set")) {
		return;
	}
	softbody::MaterialValues changed = material_.values();
	softbody::set_network_values_set(changed, p_set);
	take_over_own_values("elastic_model", changed);
}

void SoftBody2D::set_preset(SoftBodyMaterial2D::Preset p_preset) {
	if (!accept("preset", softbody::check_between("preset", p_preset, 0, softbody::MaterialPresets::PRESET_COUNT - 1, "")) || p_preset == SoftBodyMaterial2D::PRESET_CUSTOM || leaves_to_shared_material("preset")) {
		return;
	}
	const softbody::MaterialValues own = material_.values();
	softbody::MaterialValues changed = own;
	softbody::apply_preset(p_preset, changed);
	const double friction = std::exchange(changed.friction, own.friction);
	const double bounce = std::exchange(changed.bounce, own.bounce);
	if (take_over_own_values("preset", changed)) {
		set_physics_material_override(material_.override_for(friction, bounce));
	}
}

void SoftBody2D::set_physics_material_override(const Ref<PhysicsMaterial> &p_material) {
	if (p_material != material_.surface_override()) {
		material_.set_surface_override(p_material, own_callable("_take_over_physics_material"));
		take_over_physics_material();
	}
}

void SoftBody2D::take_over_physics_material() {
	if (accept("physics_material_override", material_.read_surface_override())) {
		apply_settings();
	}
}

// By the properties alone, so that the order in which they were set does not count.
SoftBody2D::ModelChoice SoftBody2D::choose_model() const {
	if (values_.elastic_model != ELASTIC_MODEL_AUTOMATIC) {
		return { values_.elastic_model, REASON_CHOSEN };
	}
	if (structure_.has_springs()) {
		return { ELASTIC_MODEL_NETWORK, REASON_OWN_SPRINGS };
	}
	if (structure_.is_painted()) {
		return { ELASTIC_MODEL_NETWORK, REASON_PAINTED_SPRINGS };
	}
	if (material_.values().has_network_values) {
		return { ELASTIC_MODEL_NETWORK, REASON_NETWORK_VALUES };
	}
	return { ElasticModel(ELASTIC_MODEL_SPRINGS + int(softbody::choose_elastic_model(std::size_t(structure_.polygon_count())))), REASON_MATERIAL };
}

SoftBody2D::ElasticModel SoftBody2D::get_elastic_model_in_use() const {
	const ModelChoice choice = choose_model();
	if (!design_ && (choice.model == ELASTIC_MODEL_NETWORK || choice.model == ELASTIC_MODEL_MODES)) {
		return choice.model; // without the time that modes take; every outline has some
	}
	const Design *found = design();
	return found != nullptr ? found->used.model : choice.model;
}

void SoftBody2D::set_soft_body_material(const Ref<SoftBodyMaterial2D> &p_material) {
	if (p_material != material_.shared()) {
		material_.share(p_material, own_callable("_take_over_material"));
		take_over_material();
		notify_property_list_changed();
	}
}

Ref<SoftBodyMaterial2D> SoftBody2D::get_soft_body_material_in_use() {
	return material_.in_use(own_callable("_take_over_material"));
}

// Values that no body can have, like a density that overflows, are the material's fault: the body stays as it is.
void SoftBody2D::take_over_material() {
	if (accept_values("soft_body_material")) {
		apply_shape();
	}
	// Only when it matters: the inspector forgets a slider that is being dragged.
	const bool density_decides = material_.values().density > 0;
	if (density_decides != density_decides_) {
		density_decides_ = density_decides;
		notify_property_list_changed();
	}
}

double SoftBody2D::mass_of_area(double p_area) const {
	const double density = material_.values().density;
	// A density is one of real things: per square meter, not per square pixel.
	constexpr double PIXELS = double(softbody::PIXELS_PER_METER) * softbody::PIXELS_PER_METER;
	return density > 0 ? density * p_area / PIXELS : values_.mass;
}

double SoftBody2D::get_total_mass() const {
	const Design *found = design();
	return found != nullptr ? found->mass : values_.mass;
}

// Of a shared material the values are shown, and neither edited nor saved with the node.
void SoftBody2D::_validate_property(PropertyInfo &p_property) const {
	if (!material_.is_shared()) {
		return;
	}
	const auto is_named = [&](const char *p_name) { return p_property.name == StringName(p_name); };
	if (is_named("preset") || is_named("network_values_set") || std::ranges::any_of(softbody::material_fields(), is_named, &softbody::MaterialField::name)) {
		p_property.usage |= PROPERTY_USAGE_READ_ONLY;
		p_property.usage &= ~uint32_t(PROPERTY_USAGE_STORAGE);
	} else if (is_named("mass") && density_decides_) {
		p_property.usage |= PROPERTY_USAGE_READ_ONLY;
	}
}

// Friction and bounce were properties of the node in earlier versions: values of old scenes and scripts still count.

bool SoftBody2D::is_former_surface(const StringName &p_name) {
	static const StringName FRICTION = "friction", BOUNCE = "bounce";
	return p_name == FRICTION || p_name == BOUNCE;
}

bool SoftBody2D::_set(const StringName &p_name, const Variant &p_value) {
	if (is_former_surface(p_name)) {
		set_former_surface(p_name, p_value);
		return true;
	}
	return unfit_.set_former(*this, get_class_static(), p_name, p_value) || unfit_.set(*this, get_class_static(), p_name, p_value);
}

bool SoftBody2D::_get(const StringName &p_name, Variant &r_value) const {
	if (is_former_surface(p_name)) {
		const softbody::BodyMaterial::Surface surface = material_.surface();
		r_value = p_name == StringName("friction") ? surface.friction : surface.bounce;
		return true;
	}
	return softbody::UnfitValues::get_former(*this, p_name, r_value) || unfit_.get(p_name, r_value);
}

// A node had values of its own; a material that it shared with others counted instead of them.
void SoftBody2D::set_former_surface(const StringName &p_name, const Variant &p_value) {
	const bool is_number = p_value.get_type() == Variant::FLOAT || p_value.get_type() == Variant::INT;
	if (!is_number) {
		unfit_.note_former(*this, p_name, vformat("'%s' refused: a value of type %s, must be float. The old value stays.", p_name, Variant::get_type_name(p_value.get_type())));
		return;
	}
	const double value = p_value;
	const bool is_friction = p_name == StringName("friction");
	const softbody::MaterialField &field = softbody::material_fields()[softbody::index_of(is_friction ? &softbody::MaterialValues::friction : &softbody::MaterialValues::bounce)];
	if (!accept(p_name, field.check(value))) {
		return;
	}
	const String moved = "'friction' and 'bounce' are those of 'physics_material_override' now. ";
	const String advice = " Save the scene, and change scripts and animations that name the old properties.";
	if (material_.is_shared()) {
		unfit_.note_former(*this, "physics_material_override", moved + String("The old values are dropped, as 'soft_body_material' has others, which counted.") + advice);
		return;
	}
	if (former_surface_.is_null() || material_.surface_override() != former_surface_) {
		former_surface_ = softbody::BodyMaterial::make_physics_material(material_.surface());
		set_physics_material_override(former_surface_);
	}
	if (is_friction) {
		former_surface_->set_friction(value);
	} else {
		former_surface_->set_bounce(value);
	}
	unfit_.note_former(*this, "physics_material_override", moved + String("The node was given a PhysicsMaterial of its own with the old values.") + advice);
}

} // namespace godot
