// SPDX-License-Identifier: MIT
// The node that shows a Polygon2D's picture as a SoftBody2D bends.
#include "godot/nodes/soft_body_skin_2d.h"

#include "godot/convert.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/resources/property_binding.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>

#include <utility>
#include <vector>

using softbody::to_core;
using softbody::to_godot;
using softbody::Vec2;

namespace godot {

SoftBody2D *SoftBodySkin2D::soft_body() const {
	return Object::cast_to<SoftBody2D>(get_parent());
}

PackedStringArray SoftBodySkin2D::get_warnings() const {
	PackedStringArray warnings;
	if (soft_body() == nullptr) {
		warnings.push_back("SoftBodySkin2D only works as a child of a SoftBody2D. Move it below the body that it shall follow.");
	}
	if (get_rest_polygon().is_empty()) {
		warnings.push_back("SoftBodySkin2D has no 'polygon'. Draw one over the body.");
	}
	if (get_transform().determinant() == 0) {
		warnings.push_back("SoftBodySkin2D has a 'scale' or 'skew' that leaves no area. Give it another one.");
	}
	if (!get_skeleton().is_empty()) {
		warnings.push_back("SoftBodySkin2D follows its body, and 'skeleton' moves its points once more. Clear it, or make this node a Polygon2D.");
	}
	unfit_.append_warnings(warnings);
	return warnings;
}

PackedVector2Array SoftBodySkin2D::get_rest_polygon() const {
	return is_carried_ ? rest_ : get_polygon();
}

void SoftBodySkin2D::set_rest_polygon(const PackedVector2Array &p_polygon) {
	is_carried_ = false;
	set_polygon(p_polygon); // taken as a new design when the body is followed next
}

void SoftBodySkin2D::let_go() {
	if (is_carried_) {
		is_carried_ = false;
		set_polygon(rest_);
	}
}

// What is stored of a carried node, by duplicate() and in scenes, is what it was designed as, not how the body has bent it.
void SoftBodySkin2D::_validate_property(PropertyInfo &p_property) const {
	static const StringName POLYGON = "polygon", REST_POLYGON = "rest_polygon";
	if (!is_carried_) {
		return;
	}
	if (p_property.name == POLYGON) {
		p_property.usage &= ~uint32_t(PROPERTY_USAGE_STORAGE);
	} else if (p_property.name == REST_POLYGON) {
		p_property.usage |= PROPERTY_USAGE_STORAGE;
	}
}

void SoftBodySkin2D::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE: {
			unfit_.tell(*this);
			set_process_internal(soft_body() != nullptr && !Engine::get_singleton()->is_editor_hint());
			update_configuration_warnings();
		} break;
		case NOTIFICATION_EXIT_TREE: {
			let_go(); // and is bound anew where it enters next
		} break;
		case NOTIFICATION_INTERNAL_PROCESS: {
			follow();
		} break;
		default:
			break;
	}
}

// The body's polygon as it was designed is the cage, and not its simulated points: so this follows what is drawn of the body.
void SoftBodySkin2D::bind(const SoftBody2D &p_body) {
	cage_ = p_body.get_polygon();
	place_ = get_transform();
	offset_ = get_offset();
	std::vector<Vec2> places;
	for (const Vector2 &point : rest_) {
		places.push_back(to_core(place_.xform(point + offset_)));
	}
	binding_ = softbody::CageBinding(to_core(cage_), places);
	outline_.clear();
}

void SoftBodySkin2D::follow() {
	const SoftBody2D *body = soft_body();
	if (body == nullptr || !is_visible_in_tree() || get_transform().determinant() == 0) {
		return;
	}
	const PackedVector2Array now = body->get_interpolated_polygon(-1);
	if (now.is_empty()) {
		let_go();
		return;
	}
	const bool is_new = !is_carried_ || get_polygon() != shown_;
	if (is_new) {
		rest_ = get_polygon();
	}
	if (is_new || cage_ != body->get_polygon() || place_ != get_transform() || offset_ != get_offset()) {
		bind(*body);
	}
	if (rest_.is_empty()) {
		return;
	}
	std::vector<Vec2> outline = to_core(body->get_interpolated_transform(-1).affine_inverse().xform(now));
	if (outline == outline_) {
		return; // the body rests
	}
	outline_ = std::move(outline);
	std::vector<Vec2> places(binding_.point_count());
	binding_.place(outline_, places);
	const Transform2D to_node = place_.affine_inverse();
	PackedVector2Array polygon;
	polygon.resize(rest_.size());
	Vector2 *write = polygon.ptrw();
	for (std::size_t i = 0; i < places.size(); i++) {
		write[i] = to_node.xform(to_godot(places[i])) - offset_;
	}
	is_carried_ = true;
	set_polygon(polygon);
	shown_ = get_polygon();
}

void SoftBodySkin2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBodySkin2D::get_warnings);
	softbody::bind_property("rest_polygon", &SoftBodySkin2D::set_rest_polygon, &SoftBodySkin2D::get_rest_polygon, PROPERTY_HINT_NONE, "suffix:px", "get_rest_polygon", nullptr, PROPERTY_USAGE_NONE);
}

} // namespace godot
