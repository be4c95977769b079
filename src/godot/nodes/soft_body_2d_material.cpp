// SPDX-License-Identifier: MIT
// What the node is made of: its own material, or one that it shares with others, and a PhysicsMaterial over either.
#include "godot/nodes/soft_rope_2d.h"

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

// A piece of a cut does without modes until they are found.
SoftBody2D::ModelChoice SoftBody2D::modes_or_stand_in(ElasticModel p_model, const char *p_reason) const {
	const bool waits = awaited_modes_ != 0 && p_model == ELASTIC_MODEL_MODES;
	return { waits ? ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA : p_model, p_reason };
}

// By the properties alone, so that the order in which they were set does not count.
SoftBody2D::ModelChoice SoftBody2D::choose_model() const {
	if (rope() != nullptr) {
		return { ELASTIC_MODEL_NETWORK, REASON_CHOSEN };
	}
	if (values_.elastic_model != ELASTIC_MODEL_AUTOMATIC) {
		return modes_or_stand_in(values_.elastic_model, REASON_CHOSEN);
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
	if (structure_.holes() != nullptr) { // springs do not know of holes
		return modes_or_stand_in(ELASTIC_MODEL_MODES, REASON_MATERIAL);
	}
	return modes_or_stand_in(ElasticModel(ELASTIC_MODEL_SPRINGS + int(softbody::choose_elastic_model(std::size_t(structure_.hull_count())))), REASON_MATERIAL);
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
}

// The mass follows from the area of the body, or is the one that was set. Without a material's density a body like the
// default one, which has `DEFAULT_MASS` exactly, is as dense as that.
double SoftBody2D::mass_of_area(double p_area) const {
	if (values_.mass_mode == MASS_MODE_CUSTOM) {
		return values_.mass;
	}
	const double density = material_.values().density;
	// A density is one of real things: per square meter, not per square pixel.
	constexpr double PIXELS = double(softbody::PIXELS_PER_METER) * softbody::PIXELS_PER_METER;
	return density > 0 ? density * p_area / PIXELS : DEFAULT_MASS * (p_area / default_area());
}

double SoftBody2D::get_mass() const {
	if (body() != nullptr && design_) {
		return design_->mass;
	}
	return mass_of_area(sized_hull(design_transform()).area);
}

bool SoftBody2D::take_over_mass(const StringName &p_property, MassMode p_mode, double p_mass) {
	const MassMode old_mode = std::exchange(values_.mass_mode, p_mode);
	const double old_mass = std::exchange(values_.mass, p_mass);
	if (!accept_values(p_property)) {
		values_.mass_mode = old_mode;
		values_.mass = old_mass;
		return false;
	}
	apply_shape();
	if (p_mode != old_mode) { // Only then: the inspector forgets a slider that is being dragged.
		notify_property_list_changed();
	}
	return true;
}

void SoftBody2D::set_mass(double p_mass) {
	if (accept("mass", softbody::check_above("mass", p_mass, 0, "kg")) && take_over_mass("mass", MASS_MODE_CUSTOM, p_mass)) {
		has_own_mass_ = true;
	}
}

// A body of the scene tree keeps the mass that it has until another is set; a scene stores its mass unless it is the default.
void SoftBody2D::set_mass_mode(MassMode p_mode) {
	if (!accept("mass_mode", softbody::check_between("mass_mode", p_mode, MASS_MODE_AUTO, MASS_MODE_CUSTOM, "")) || p_mode == values_.mass_mode) {
		return;
	}
	const bool is_kept = p_mode == MASS_MODE_CUSTOM && !has_own_mass_ && is_inside_tree();
	has_own_mass_ = has_own_mass_ || (p_mode == MASS_MODE_CUSTOM && !is_inside_tree());
	take_over_mass("mass_mode", p_mode, is_kept ? get_mass() : values_.mass);
}

softbody::Firmness SoftBody2D::firmness_of(const Design &p_design) const {
	if (!values_.firm_for_weight || p_design.used.model == ELASTIC_MODEL_NETWORK) {
		return {};
	}
	const double gravity = double(length(project_gravity())) * values_.gravity_scale;
	const double load = softbody::load_of(p_design.mass, gravity, p_design.area);
	return softbody::firmness_for(p_design.has_holes ? load * softbody::softness_by_holes(*p_design.shape) : load, material_.values().youngs_modulus);
}

double SoftBody2D::get_youngs_modulus_in_use() const {
	const Design *found = design();
	if (found == nullptr || found->used.model == ELASTIC_MODEL_NETWORK) {
		return 0;
	}
	return material_.values().youngs_modulus * firmness_of(*found).factor;
}

// Of a shared material the values are shown, and neither edited nor saved with the node. Nor is a mass that follows from others.
void SoftBody2D::_validate_property(PropertyInfo &p_property) const {
	const auto is_named = [&](const char *p_name) { return p_property.name == StringName(p_name); };
	if (is_named("mass")) {
		if (values_.mass_mode == MASS_MODE_AUTO) {
			p_property.usage |= PROPERTY_USAGE_READ_ONLY;
			p_property.usage &= ~uint32_t(PROPERTY_USAGE_STORAGE);
		}
		return;
	}
	const DetailMode detail = structure_.detail().mode;
	if ((is_named("detail_tolerance") && detail != DETAIL_MODE_AUTOMATIC) || (is_named("detail_point_count") && detail != DETAIL_MODE_POINT_COUNT)) {
		p_property.usage &= ~uint32_t(PROPERTY_USAGE_EDITOR); // it does nothing, and is kept
		return;
	}
	if (!material_.is_shared()) {
		return;
	}
	if (is_named("preset") || is_named("network_values_set") || std::ranges::any_of(softbody::material_fields(), is_named, &softbody::MaterialField::name)) {
		p_property.usage |= PROPERTY_USAGE_READ_ONLY;
		p_property.usage &= ~uint32_t(PROPERTY_USAGE_STORAGE);
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
	const StringName &known = rope() != nullptr ? SoftRope2D::get_class_static() : get_class_static(); // a rope has properties of its own
	return unfit_.set_former(*this, known, p_name, p_value) || unfit_.set(*this, known, p_name, p_value);
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
