// SPDX-License-Identifier: MIT
// The node: a rope, strap or tentacle.
#pragma once

#include "godot/nodes/rope_part.h"
#include "godot/nodes/soft_body_2d.h"

namespace godot {

/// See doc_classes/SoftRope2D.xml. A SoftBody2D whose polygon is the outline of its path, whose inner points are the path's own
/// points, and whose shape is a chain: everything else of that node, such as contacts, joints and states, is the same.
class SoftRope2D : public SoftBody2D {
	GDCLASS(SoftRope2D, SoftBody2D)

public:
	/// Sets of values to begin with.
	enum Kind {
		KIND_CUSTOM,
		KIND_ROPE,
		KIND_STRAP,
		KIND_TENTACLE,
		KIND_RUBBER_BAND,
	};

	SoftRope2D();
	~SoftRope2D();

	void set_path(const PackedVector2Array &p_path);
	PackedVector2Array get_path_points() const { return rope_.path; }
	/// Why that could not be the path of this rope, with its width and links; empty if it could.
	String get_path_problem(const PackedVector2Array &p_path) const;
	void set_link_count(int p_count);
	int get_link_count() const { return rope_.link_count; }
	void set_width(double p_width);
	double get_width() const { return rope_.width; }
	void set_width_curve(const Ref<Curve> &p_curve);
	Ref<Curve> get_width_curve() const { return rope_.width_curve; }
	template <double softbody::RopePart::*VALUE>
	void set_rope_value(double p_value);
	template <double softbody::RopePart::*VALUE>
	double get_rope_value() const { return rope_.*VALUE; }
	void set_kind(Kind p_kind);
	Kind get_kind() const;
	void set_pin_start(bool p_pinned);
	bool is_pin_start() const { return pin_start_; }
	void set_pin_end(bool p_pinned);
	bool is_pin_end() const { return pin_end_; }

	int get_center_count() const { return int(get_structure<&softbody::BodyStructure::Values::inner_points>().size()); }
	/// Index among all points of the one on the centerline; -1 with an error for an index out of range.
	int get_center_point(int p_index) const;
	PackedVector2Array get_center_positions() const;
	double get_rest_length() const;
	double get_length() const;

	String describe() const override;

protected:
	static void _bind_methods();
	void _validate_property(PropertyInfo &p_property) const;
	const softbody::RopePart *rope() const override { return &rope_; }

private:
	/// Takes over the structure of the present values. False, with the values of `p_before` again, where they make none.
	bool remake(const StringName &p_property, const softbody::RopePart &p_before);
	void remake_for_curve();
	void pin_ends();

	softbody::RopePart rope_;
	bool pin_start_ = false;
	bool pin_end_ = false;
};

} // namespace godot

VARIANT_ENUM_CAST(SoftRope2D::Kind);
