// SPDX-License-Identifier: MIT
// What the node meets: layers, its proxy in the engine, exceptions, and what it tells of its contacts.
#include "godot/nodes/soft_body_2d_setters.h"

#include "godot/convert.h"
#include "godot/server/soft_body_space_2d.h"
#include "godot/server/step_signals.h"

#include <godot_cpp/classes/collision_object2d.hpp>
#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/object.hpp>

namespace godot {

namespace {

// The automatic margin, in parts of the radius of a disk of the body's area: deep enough to be seen, and to give a walking
// character the force to push, without changing where a body seems to end.
constexpr double AUTOMATIC_MARGIN = 0.06;

bool is_layer_number(int p_number, const char *p_what) {
	ERR_FAIL_COND_V_MSG(p_number < 1 || p_number > 32, false, vformat("Collision %s number must be between 1 and 32 inclusive.", p_what));
	return true;
}

uint32_t with_bit(uint32_t p_bits, int p_number, bool p_value) {
	const uint32_t bit = 1u << (p_number - 1);
	return p_value ? p_bits | bit : p_bits & ~bit;
}

} // namespace

void SoftBody2D::apply_collision_layer() {
	proxy_.set_layer(values_.collision_layer);
	apply_settings();
}

void SoftBody2D::set_collision_layer_value(int p_layer_number, bool p_value) {
	if (is_layer_number(p_layer_number, "layer")) {
		set_value<&Values::collision_layer>(with_bit(values_.collision_layer, p_layer_number, p_value));
	}
}

bool SoftBody2D::get_collision_layer_value(int p_layer_number) const {
	return is_layer_number(p_layer_number, "layer") && (values_.collision_layer & (1u << (p_layer_number - 1))) != 0;
}

void SoftBody2D::set_collision_mask_value(int p_layer_number, bool p_value) {
	if (is_layer_number(p_layer_number, "mask")) {
		set_value<&Values::collision_mask>(with_bit(values_.collision_mask, p_layer_number, p_value));
	}
}

bool SoftBody2D::get_collision_mask_value(int p_layer_number) const {
	return is_layer_number(p_layer_number, "mask") && (values_.collision_mask & (1u << (p_layer_number - 1))) != 0;
}

bool SoftBody2D::uses_self_collision(const Design &p_design) const {
	// A rope that lies folded across itself has no inside: contacts with others would push it either way.
	const bool may_cross_itself = p_design.has_deep_dents || rope() != nullptr;
	return values_.self_collision == SELF_COLLISION_ON || (values_.self_collision == SELF_COLLISION_AUTOMATIC && may_cross_itself);
}

bool SoftBody2D::has_self_collision() const {
	const Design *found = design();
	return found != nullptr ? uses_self_collision(*found) : values_.self_collision == SELF_COLLISION_ON;
}

softbody::Real SoftBody2D::proxy_inset() const {
	if (values_.collision_proxy_margin >= 0) {
		return softbody::Real(values_.collision_proxy_margin);
	}
	return softbody::Real(AUTOMATIC_MARGIN * Math::sqrt(double(body()->shape().rest_area()) / Math_PI));
}

// The proxy is in the space while the body is, unless it is switched off or the node is.
void SoftBody2D::update_proxy_presence() {
	const bool wanted = values_.collision_proxy_enabled && space_ != nullptr && body() != nullptr && is_inside_tree() && (enabled_ || values_.disable_mode != DISABLE_MODE_REMOVE);
	if (wanted && !proxy_.is_in_space()) {
		proxy_.set_collider(get_instance_id());
		proxy_.set_layer(values_.collision_layer);
		proxy_.enter(get_world_2d()->get_space(), *body(), proxy_inset());
		engine_steps_ = 0;
	} else if (!wanted) {
		proxy_.leave();
	}
	note_change();
}

void SoftBody2D::update_picker() {
	const bool wanted = values_.input_pickable && !Engine::get_singleton()->is_editor_hint();
	if (wanted && picker_ == nullptr) {
		picker_ = memnew(SoftBodyPicker);
		add_child(picker_, false, INTERNAL_MODE_BACK);
	} else if (!wanted && picker_ != nullptr) {
		SoftBodyPicker *picker = std::exchange(picker_, nullptr); // whose signal may have switched it off
		picker->forget_mouse();
		picker->set_process_mode(PROCESS_MODE_DISABLED);
		picker->queue_free();
	}
}

bool SoftBody2D::follow_with_proxy(bool p_may_detail) {
	return proxy_.is_in_space() && body() != nullptr && proxy_.follow(*body(), proxy_inset(), p_may_detail);
}

// Bodies that are left alone: by the engine's side through the proxy, by the core through tags (of Godot's bodies) and ids (of
// soft ones). The core forgets the latter with a body that leaves its world, so either of the two brings them again.

void SoftBody2D::add_collision_exception_with(Node *p_body) {
	ERR_FAIL_NULL(p_body);
	SoftBody2D *soft = Object::cast_to<SoftBody2D>(p_body);
	const CollisionObject2D *collision_object = Object::cast_to<CollisionObject2D>(p_body);
	ERR_FAIL_COND_MSG(soft == nullptr && collision_object == nullptr,
			describe() + ": no collision exception with '" + p_body->get_name() + "', which is neither a SoftBody2D nor a CollisionObject2D.");
	ERR_FAIL_COND_MSG(soft == this, describe() + ": no collision exception with itself. Switch self_collision off instead.");
	if (!exceptions_.choose(p_body->get_instance_id())) {
		return;
	}
	if (soft != nullptr) {
		soft->exceptions_.take(get_instance_id());
	} else {
		proxy_.add_exception(collision_object->get_rid());
	}
	apply_exceptions();
}

void SoftBody2D::remove_collision_exception_with(Node *p_body) {
	ERR_FAIL_NULL(p_body);
	if (!exceptions_.drop(p_body->get_instance_id())) {
		return;
	}
	if (SoftBody2D *soft = Object::cast_to<SoftBody2D>(p_body)) {
		soft->exceptions_.give_back(get_instance_id());
		if (space_ != nullptr && !exceptions_.is_taken(soft->get_instance_id())) {
			space_->world().remove_collision_exception(body_id_, soft->body_id_);
		}
	} else if (const CollisionObject2D *collision_object = Object::cast_to<CollisionObject2D>(p_body)) {
		proxy_.remove_exception(collision_object->get_rid());
	}
	apply_exceptions();
}

TypedArray<Node2D> SoftBody2D::get_collision_exceptions() const {
	TypedArray<Node2D> found;
	for (const uint64_t id : exceptions_.chosen()) {
		if (Node2D *node = Object::cast_to<Node2D>(ObjectDB::get_instance(id))) {
			found.push_back(node);
		}
	}
	return found;
}

void SoftBody2D::add_joined(uint64_t p_id) {
	exceptions_.join(p_id);
	apply_exceptions();
}

void SoftBody2D::remove_joined(uint64_t p_id) {
	if (exceptions_.part(p_id)) {
		apply_exceptions();
	}
}

// Brings the core's exceptions of this body up to date.
void SoftBody2D::apply_exceptions() {
	softbody::SoftBodyData *found = body();
	if (found == nullptr || (exceptions_.is_empty() && found->ignored_tags().empty())) {
		return;
	}
	std::vector<uint64_t> tags;
	exceptions_.for_each([&](uint64_t p_id) {
		const SoftBody2D *soft = Object::cast_to<SoftBody2D>(ObjectDB::get_instance(p_id));
		if (soft == nullptr) {
			tags.push_back(p_id);
		} else if (space_ != nullptr && soft->space_ == space_ && soft->body() != nullptr) {
			accept("collision_exceptions", space_->world().add_collision_exception(body_id_, soft->body_id_));
		}
	});
	found->set_ignored_tags(tags);
}

// Contacts: `ContactReports` for scripts, and which colliders the node listens to.

void SoftBody2D::set_contact_monitor(bool p_enabled) {
	if (values_.contact_monitor == p_enabled) {
		return;
	}
	values_.contact_monitor = p_enabled;
	if (!p_enabled) {
		forget_contacts();
	}
	apply_settings();
	notify_property_list_changed();
}

void SoftBody2D::take_contacts(std::span<const softbody::Contact> p_contacts, std::span<const uint64_t> p_colliders,
		std::vector<uint64_t> p_touched, softbody::StepSignals &r_signals) {
	if (r_signals.is_quiet()) {
		contacts_.take_quietly(p_contacts, p_colliders, std::move(p_touched), values_.max_contacts_reported);
		return;
	}
	const softbody::ContactReports::Changes changes = contacts_.take(p_contacts, p_colliders, std::move(p_touched), values_.max_contacts_reported);
	for (const uint64_t collider : changes.ended) {
		r_signals.add(get_instance_id(), [this, collider] { emit_exited(collider); });
	}
	for (const softbody::ContactReports::Beginning &begun : changes.begun) {
		r_signals.add(get_instance_id(), [this, begun] { emit_entered(begun.collider, begun.impact); });
	}
}

// A listener of a signal may have switched the monitor off, freed the other, or freed this node.
void SoftBody2D::emit_entered(uint64_t p_collider, const softbody::ContactReports::Impact &p_impact) {
	Node *collider = Object::cast_to<Node>(ObjectDB::get_instance(p_collider));
	if (collider == nullptr || !values_.contact_monitor) {
		return;
	}
	const uint64_t id = get_instance_id();
	const softbody::ContactReports::Impact impact = p_impact;
	watch_collider(collider, true);
	emit_signal("body_entered", collider);
	collider = Object::cast_to<Node>(ObjectDB::get_instance(p_collider));
	if (collider != nullptr && ObjectDB::get_instance(id) != nullptr) {
		emit_signal("contact_started", collider, impact.point, impact.normal, impact.impulse);
	}
}

void SoftBody2D::emit_exited(uint64_t p_collider) {
	Node *collider = Object::cast_to<Node>(ObjectDB::get_instance(p_collider));
	if (collider != nullptr && values_.contact_monitor) {
		watch_collider(collider, false);
		emit_signal("body_exited", collider);
	}
}

// A collider that is freed, or leaves the tree, is told while it can still be looked at, as by RigidBody2D.
void SoftBody2D::watch_collider(Node *p_collider, bool p_watch) {
	const Callable listener = own_callable("_on_collider_exiting").bind(p_collider->get_instance_id());
	if (p_watch != p_collider->is_connected("tree_exiting", listener)) {
		if (p_watch) {
			p_collider->connect("tree_exiting", listener);
		} else {
			p_collider->disconnect("tree_exiting", listener);
		}
	}
}

void SoftBody2D::on_collider_exiting(uint64_t p_collider) {
	Node *collider = Object::cast_to<Node>(ObjectDB::get_instance(p_collider));
	if (collider != nullptr && contacts_.forget(p_collider)) {
		watch_collider(collider, false);
		emit_signal("body_exited", collider);
	}
}

void SoftBody2D::forget_contacts() {
	for (const uint64_t id : contacts_.forget_all()) {
		if (Node *collider = Object::cast_to<Node>(ObjectDB::get_instance(id))) {
			watch_collider(collider, false);
		}
	}
}

const softbody::ContactReports::Record *SoftBody2D::find_contact(int p_index) const {
	ERR_FAIL_COND_V_MSG(p_index < 0 || p_index >= get_contact_count(), nullptr, describe() + ": contact index " + itos(p_index) + " must be at least 0 and below " + itos(get_contact_count()) + ".");
	return &contacts_.records()[std::size_t(p_index)];
}

int SoftBody2D::get_contact_point(int p_index) const {
	const softbody::ContactReports::Record *contact = find_contact(p_index);
	return contact != nullptr ? order().mirror(int(contact->core_point)) : -1;
}

Object *SoftBody2D::get_contact_collider(int p_index) const {
	const softbody::ContactReports::Record *contact = find_contact(p_index);
	return contact != nullptr && contact->collider != 0 ? ObjectDB::get_instance(contact->collider) : nullptr;
}

TypedArray<Node2D> SoftBody2D::get_colliding_bodies() const {
	TypedArray<Node2D> bodies;
	ERR_FAIL_COND_V_MSG(!values_.contact_monitor, bodies, describe() + ": get_colliding_bodies() needs contact_monitor; switch it on.");
	for (const uint64_t id : contacts_.touched()) {
		if (Node2D *node = Object::cast_to<Node2D>(ObjectDB::get_instance(id))) {
			bodies.push_back(node);
		}
	}
	return bodies;
}

} // namespace godot
