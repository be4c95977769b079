// SPDX-License-Identifier: MIT
// The node that carries eyes, a hat or a camera along with the surface of a SoftBody2D.
#pragma once

#include "core/model/attachment.h"
#include "godot/resources/unfit_values.h"

#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>

#include <cstdint>
#include <optional>

namespace godot {

class SoftBody2D;

/// A child of a SoftBody2D. Where it stands on the undeformed body when it enters the tree is where it stays on the deformed
/// one; its transform is set in step with the drawing of the body. See doc_classes/SoftBodyAttachment2D.xml.
class SoftBodyAttachment2D : public Node2D {
	GDCLASS(SoftBodyAttachment2D, Node2D)

public:
	void set_follow_rotation(bool p_follow) { follow_rotation_ = p_follow; }
	bool is_following_rotation() const { return follow_rotation_; }
	/// The place on the undeformed body, in the body's coordinates.
	void attach_at(const Vector2 &p_position, double p_rotation);
	void set_rest_position(const Vector2 &p_position);
	Vector2 get_rest_position() const;
	void set_rest_rotation(double p_rotation);
	double get_rest_rotation() const;

	/// Goes at once where the body is drawn in this frame, after the body or the parent has become another one.
	void follow_now();

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
	void follow(double p_fraction);

	softbody::UnfitValues unfit_;
	bool follow_rotation_ = true;
	bool has_place_ = false; ///< from when it first has entered the tree of a running game
	Vector2 rest_position_;
	double rest_rotation_ = 0;
	std::optional<softbody::Attachment> attachment_;
	uint64_t rest_version_ = 0; ///< of the body's rest shape that `attachment_` was made for
};

} // namespace godot
