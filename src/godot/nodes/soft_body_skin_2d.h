// SPDX-License-Identifier: MIT
// The node that shows a Polygon2D's picture as a SoftBody2D bends.
#pragma once

#include "core/skin/cage_binding.h"
#include "godot/resources/unfit_values.h"

#include <godot_cpp/classes/polygon2d.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>

#include <vector>

namespace godot {

class SoftBody2D;

/// A Polygon2D that is a child of a SoftBody2D. Where its points lie on the undeformed body when it enters the tree is where they stay on the
/// deformed one. See doc_classes/SoftBodySkin2D.xml.
class SoftBodySkin2D : public Polygon2D {
	GDCLASS(SoftBodySkin2D, Polygon2D)

public:
	/// The polygon on the undeformed body, in this node's coordinates.
	void set_rest_polygon(const PackedVector2Array &p_polygon);
	PackedVector2Array get_rest_polygon() const;

	PackedStringArray get_warnings() const;
	PackedStringArray _get_configuration_warnings() const override { return get_warnings(); }

protected:
	static void _bind_methods();
	void _notification(int p_what);
	void _validate_property(PropertyInfo &p_property) const;
	bool _set(const StringName &p_name, const Variant &p_value) {
		return unfit_.set(*this, get_class_static(), p_name, p_value);
	}
	bool _get(const StringName &p_name, Variant &r_value) const { return unfit_.get(p_name, r_value); }
	void _get_property_list(List<PropertyInfo> *r_list) const { unfit_.append_to(r_list); }

private:
	SoftBody2D *soft_body() const;
	void follow();
	void bind(const SoftBody2D &p_body);
	/// Lies as it was designed again.
	void let_go();

	softbody::UnfitValues unfit_;
	bool is_carried_ = false; ///< while the polygon that is shown is not the designed one
	PackedVector2Array rest_; ///< as designed
	PackedVector2Array shown_; ///< what this node has set last; another one comes from a script
	PackedVector2Array cage_; ///< the body's polygon at rest that `binding_` was made for
	Transform2D place_; ///< of this node on the body then
	Vector2 offset_; ///< of the polygon then
	softbody::CageBinding binding_;
	std::vector<softbody::Vec2> outline_; ///< of the body as it was followed last, in the body's coordinates
};

} // namespace godot
