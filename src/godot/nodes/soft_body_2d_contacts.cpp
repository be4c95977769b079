// SPDX-License-Identifier: MIT
// What the node tells of its contacts.
#include "godot/nodes/soft_body_2d.h"

#include "core/base/constants.h"
#include "godot/convert.h"
#include "godot/server/step_signals.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/object.hpp>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

using softbody::to_godot;

namespace godot {

namespace {

// As Godot's RigidBody2D.
constexpr int MOST_CONTACTS = 4096;

} // namespace

/// Place and strength of a contact when two things met.
struct SoftBody2D::Impact {
	Vector2 point; ///< in the world [px]
	Vector2 normal; ///< unit, towards this body
	double impulse = 0; ///< [kg·px/s]
};

// One place and one normal for all contacts with one collider, weighted by their impulses.
SoftBody2D::Impact SoftBody2D::impact_of(std::span<const softbody::Contact> p_contacts, std::span<const uint64_t> p_colliders, uint64_t p_collider) {
	Impact impact;
	double weights = 0;
	for (std::size_t i = 0; i < p_contacts.size(); i++) {
		if (p_colliders[i] != p_collider) {
			continue;
		}
		const softbody::Contact &contact = p_contacts[i];
		const double weight = std::max<double>(contact.normal_impulse, 1e-9); // they may already part
		impact.point += to_godot(contact.point) * real_t(weight);
		impact.normal += to_godot(contact.normal) * real_t(weight);
		impact.impulse += contact.normal_impulse;
		weights += weight;
	}
	if (weights > 0) {
		impact.point /= real_t(weights);
		impact.normal.normalize();
	}
	return impact;
}

void SoftBody2D::set_contact_monitor(bool p_enabled) {
	if (contact_monitor_ == p_enabled) {
		return;
	}
	contact_monitor_ = p_enabled;
	if (!p_enabled) {
		forget_contacts();
	}
	apply_settings();
	notify_property_list_changed();
}

void SoftBody2D::set_max_contacts_reported(int p_amount) {
	if (accept("max_contacts_reported", softbody::check_between("max_contacts_reported", p_amount, 0, MOST_CONTACTS, ""))) {
		max_contacts_reported_ = p_amount;
	}
}

// Of more contacts than are wanted, the strongest; in the order of the core, which does not depend on threads.
void SoftBody2D::take_contacts(std::span<const softbody::Contact> p_contacts, std::span<const uint64_t> p_colliders,
		std::vector<uint64_t> p_touched, softbody::StepSignals &r_signals) {
	std::vector<uint32_t> kept(p_contacts.size());
	std::iota(kept.begin(), kept.end(), 0u);
	if (kept.size() > std::size_t(max_contacts_reported_)) {
		std::ranges::stable_sort(kept, std::greater(), [&](uint32_t i) { return p_contacts[i].normal_impulse; });
		kept.resize(std::size_t(max_contacts_reported_));
		std::ranges::sort(kept);
	}
	contacts_.clear();
	for (const uint32_t i : kept) {
		const softbody::Contact &contact = p_contacts[i];
		contacts_.push_back({ to_godot(contact.point), to_godot(contact.normal), double(contact.normal_impulse), double(contact.depth), contact.hull_point, p_colliders[i] });
	}

	std::ranges::sort(p_touched);
	p_touched.erase(std::ranges::unique(p_touched).begin(), p_touched.end());
	std::erase(p_touched, 0u); // what belongs to no object
	std::vector<uint64_t> changed;
	std::ranges::set_difference(touched_, p_touched, std::back_inserter(changed));
	for (const uint64_t collider : changed) {
		r_signals.add(get_instance_id(), [this, collider] { emit_exited(collider); });
	}
	changed.clear();
	std::ranges::set_difference(p_touched, touched_, std::back_inserter(changed));
	for (const uint64_t collider : changed) {
		const Impact impact = impact_of(p_contacts, p_colliders, collider);
		r_signals.add(get_instance_id(), [this, collider, impact] { emit_entered(collider, impact); });
	}
	touched_ = std::move(p_touched);
}

// A listener of a signal may have switched the monitor off, freed the other, or freed this node.
void SoftBody2D::emit_entered(uint64_t p_collider, const Impact &p_impact) {
	Node *collider = Object::cast_to<Node>(ObjectDB::get_instance(p_collider));
	if (collider == nullptr || !contact_monitor_) {
		return;
	}
	const uint64_t id = get_instance_id();
	const Impact impact = p_impact;
	watch_collider(collider, true);
	emit_signal("body_entered", collider);
	collider = Object::cast_to<Node>(ObjectDB::get_instance(p_collider));
	if (collider != nullptr && ObjectDB::get_instance(id) != nullptr) {
		emit_signal("contact_started", collider, impact.point, impact.normal, impact.impulse);
	}
}

void SoftBody2D::emit_exited(uint64_t p_collider) {
	Node *collider = Object::cast_to<Node>(ObjectDB::get_instance(p_collider));
	if (collider != nullptr && contact_monitor_) {
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
	if (collider != nullptr && std::erase(touched_, p_collider) > 0) {
		watch_collider(collider, false);
		emit_signal("body_exited", collider);
	}
}

void SoftBody2D::forget_contacts() {
	for (const uint64_t id : std::exchange(touched_, {})) {
		if (Node *collider = Object::cast_to<Node>(ObjectDB::get_instance(id))) {
			watch_collider(collider, false);
		}
	}
	contacts_.clear();
}

const SoftBody2D::ContactRecord *SoftBody2D::find_contact(int p_index) const {
	ERR_FAIL_COND_V_MSG(p_index < 0 || p_index >= get_contact_count(), nullptr, describe() + ": contact index " + itos(p_index) + " must be at least 0 and below " + itos(get_contact_count()) + ".");
	return &contacts_[std::size_t(p_index)];
}

Vector2 SoftBody2D::get_contact_position(int p_index) const {
	const ContactRecord *contact = find_contact(p_index);
	return contact != nullptr ? contact->point : Vector2();
}

Vector2 SoftBody2D::get_contact_normal(int p_index) const {
	const ContactRecord *contact = find_contact(p_index);
	return contact != nullptr ? contact->normal : Vector2();
}

double SoftBody2D::get_contact_impulse(int p_index) const {
	const ContactRecord *contact = find_contact(p_index);
	return contact != nullptr ? contact->impulse : 0.0;
}

double SoftBody2D::get_contact_depth(int p_index) const {
	const ContactRecord *contact = find_contact(p_index);
	return contact != nullptr ? contact->depth : 0.0;
}

int SoftBody2D::get_contact_point(int p_index) const {
	const ContactRecord *contact = find_contact(p_index);
	return contact != nullptr ? public_index(contact->core_point, polygon_reversed_) : -1;
}

Object *SoftBody2D::get_contact_collider(int p_index) const {
	const ContactRecord *contact = find_contact(p_index);
	return contact != nullptr && contact->collider != 0 ? ObjectDB::get_instance(contact->collider) : nullptr;
}

TypedArray<Node2D> SoftBody2D::get_colliding_bodies() const {
	TypedArray<Node2D> bodies;
	ERR_FAIL_COND_V_MSG(!contact_monitor_, bodies, describe() + ": get_colliding_bodies() needs contact_monitor; switch it on.");
	for (const uint64_t id : touched_) {
		if (Node2D *node = Object::cast_to<Node2D>(ObjectDB::get_instance(id))) {
			bodies.push_back(node);
		}
	}
	return bodies;
}

void SoftBody2D::bind_contacts() {
	ClassDB::bind_method(D_METHOD("set_contact_monitor", "enabled"), &SoftBody2D::set_contact_monitor);
	ClassDB::bind_method(D_METHOD("is_contact_monitor_enabled"), &SoftBody2D::is_contact_monitor_enabled);
	ClassDB::bind_method(D_METHOD("set_max_contacts_reported", "amount"), &SoftBody2D::set_max_contacts_reported);
	ClassDB::bind_method(D_METHOD("get_max_contacts_reported"), &SoftBody2D::get_max_contacts_reported);
	ClassDB::bind_method(D_METHOD("get_contact_count"), &SoftBody2D::get_contact_count);
	ClassDB::bind_method(D_METHOD("get_contact_position", "index"), &SoftBody2D::get_contact_position);
	ClassDB::bind_method(D_METHOD("get_contact_normal", "index"), &SoftBody2D::get_contact_normal);
	ClassDB::bind_method(D_METHOD("get_contact_impulse", "index"), &SoftBody2D::get_contact_impulse);
	ClassDB::bind_method(D_METHOD("get_contact_depth", "index"), &SoftBody2D::get_contact_depth);
	ClassDB::bind_method(D_METHOD("get_contact_point", "index"), &SoftBody2D::get_contact_point);
	ClassDB::bind_method(D_METHOD("get_contact_collider", "index"), &SoftBody2D::get_contact_collider);
	ClassDB::bind_method(D_METHOD("get_colliding_bodies"), &SoftBody2D::get_colliding_bodies);
	ClassDB::bind_method(D_METHOD("_on_collider_exiting", "collider"), &SoftBody2D::on_collider_exiting);

	const PropertyInfo body(Variant::OBJECT, "body", PROPERTY_HINT_RESOURCE_TYPE, "Node");
	ADD_SIGNAL(MethodInfo("body_entered", body));
	ADD_SIGNAL(MethodInfo("body_exited", body));
	ADD_SIGNAL(MethodInfo("contact_started", body, PropertyInfo(Variant::VECTOR2, "point"), PropertyInfo(Variant::VECTOR2, "normal"), PropertyInfo(Variant::FLOAT, "impulse")));
}

} // namespace godot
