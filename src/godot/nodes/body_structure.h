// SPDX-License-Identifier: MIT
// Points and springs of a node as its user gave them.
#pragma once

#include "core/base/error.h"
#include "core/creator/soft_body_creator.h"
#include "core/geometry/holed_polygon.h"
#include "godot/convert.h"
#include "godot/drawing/drawn_holes.h"
#include "godot/drawing/drawn_outline.h"
#include "godot/nodes/body_properties.h"

#include <godot_cpp/variant/packed_float32_array.hpp>
#include <godot_cpp/variant/packed_int32_array.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/transform2d.hpp>

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace softbody {

/// A polygon at one scale of its node: points of size 1, and what enlarges them.
struct SizedHull {
	SizedScale scale;
	std::vector<Vec2> points;
	double area = 0; ///< at that scale [px²]
	bool is_reversed = false; ///< whether the core holds the points in reverse
};

/// Polygon, inner points, which points springs join, and how strong these are; and which points stand for the polygon.
///
/// The hull is what is simulated: the polygon itself, or fewer points that stand for it. Springs and pins count the points of
/// the hull, then the inner points, then the center point.
///
/// A scene file sets these values one after the other, so whether they fit each other can be judged only by them all. `check`
/// refuses a value that can never be right. A value that does not fit the others is kept, and `make_shape` leaves it out.
class BodyStructure {
public:
	struct Values {
		godot::PackedVector2Array polygon;
		Holes holes; ///< that may not fit a polygon set later
		godot::PackedVector2Array inner_points;
		godot::PackedInt32Array springs; ///< pairs of points; empty: the automatic springs
		godot::PackedFloat32Array stiffness_scales; ///< one a spring, like the next two; empty: all 1
		godot::PackedFloat32Array damping_scales;
		godot::PackedFloat32Array length_scales;
		bool center_point = true;
	};

	struct DetailValues {
		BodyProperties::DetailMode mode = BodyProperties::DETAIL_MODE_AS_DRAWN;
		double tolerance = 0.03; ///< see SimplifyOptions
		int point_count = 24; ///< in DETAIL_MODE_POINT_COUNT
		godot::PackedFloat32Array weights; ///< one for each point of the polygon; of another number: not used
	};

	/// Least width of a body that has been scaled down [px].
	static constexpr real_t LEAST_WIDTH = 4;

	const Values &values() const { return values_; }
	const DetailValues &detail() const { return detail_; }
	void exchange_all(const Values &p_values) {
		values_ = p_values;
		is_outline_known_ = false;
	}
	/// Sets one of the values, of any kind, and returns its old one.
	template <auto VALUE, class Value>
	Value exchange(const Value &p_value) {
		is_outline_known_ = false;
		return std::exchange(values_.*VALUE, p_value);
	}
	template <auto VALUE, class Value>
	Value exchange_detail(const Value &p_value) {
		is_outline_known_ = false;
		return std::exchange(detail_.*VALUE, p_value);
	}

	// What can never be right, by the name and type of the property.
	static Status check(const std::string &p_name, const godot::PackedVector2Array &p_points);
	static Status check(const std::string &p_name, const godot::PackedInt32Array &p_springs) {
		return check_spring_pairs(p_name, { p_springs.ptr(), std::size_t(p_springs.size()) });
	}
	static Status check(const std::string &p_name, const godot::PackedFloat32Array &p_scales);
	static Status check(const std::string &, bool) { return {}; }

	/// Points that are drawn.
	int polygon_count() const { return int(values_.polygon.size()); }
	/// How the polygon follows the hull; null where the polygon is the hull.
	const DrawnOutline *outline() const;
	/// How the holes follow the hull; null where there are none that fit the polygon.
	const DrawnHoles *holes() const;
	/// The holes, or none where they do not fit the polygon.
	const Holes &holes_in_use() const;
	/// The outline that DETAIL_MODE_AUTOMATIC would have; null where it would simulate the polygon as drawn.
	std::shared_ptr<const DrawnOutline> outline_at_tolerance() const;
	/// Refuses a hull that is not the polygon itself, and holes.
	Status check_as_drawn() const;
	/// What is simulated, in the user's order.
	const godot::PackedVector2Array &hull() const { return outline() != nullptr ? outline_->hull() : values_.polygon; }
	int hull_count() const { return int(hull().size()); }
	/// Points of a body that gets none besides these.
	int point_count() const { return hull_count() + int(values_.inner_points.size()) + (values_.center_point ? 1 : 0); }
	PointOrder order(bool p_reversed) const { return { hull_count(), p_reversed }; }
	/// All points in the core's order: hull, inner points, middle.
	std::vector<Vec2> rest_points(bool p_reversed) const;
	bool has_springs() const { return !values_.springs.is_empty(); }
	/// Whether single springs have factors.
	bool is_painted() const;

	/// What the creator takes, at that scale of the node.
	StructureOptions options(const godot::Transform2D &p_scale) const;
	/// The scale at which a body is simulated for a node of scale `p_scale`: at least LEAST_WIDTH wide, as long as the polygon
	/// is. So a node may shrink to nothing.
	godot::Transform2D simulated_scale(const godot::Transform2D &p_scale) const;
	/// The shape of these options, enlarged by a factor. Parts that do not fit the rest are removed from the options, and told
	/// in `r_problems`.
	static Result<std::shared_ptr<const SoftBodyShape>> make_shape(std::span<const Vec2> p_hull, Real p_size, StructureOptions &r_options,
			godot::PackedStringArray &r_problems);
	/// One for each inner point outside of the polygon.
	void append_warnings(godot::PackedStringArray &r_warnings) const;

private:
	std::shared_ptr<const DrawnOutline> make_outline(BodyProperties::DetailMode p_mode) const;

	Values values_;
	DetailValues detail_;
	mutable std::shared_ptr<const DrawnOutline> outline_;
	mutable std::shared_ptr<const DrawnHoles> holes_;
	mutable bool is_outline_known_ = true; ///< whether `outline_` and `holes_` are those of the present values; the empty polygon has none
};

} // namespace softbody
