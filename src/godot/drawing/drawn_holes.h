// SPDX-License-Identifier: MIT
// The holes of a body as they are drawn.
#pragma once

#include "core/geometry/holed_polygon.h"
#include "core/skin/hole_binding.h"
#include "godot/convert.h"

#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace softbody {

Holes to_core(const godot::TypedArray<godot::PackedVector2Array> &p_holes);
godot::TypedArray<godot::PackedVector2Array> to_godot(const Holes &p_holes);

/// Made for one polygon and one hull, and never changed. All in the node's coordinates. The weights of like holes are found once, on first
/// use, which may take a fraction of a second for many points.
class DrawnHoles {
public:
	/// `p_hull` is what is simulated for the polygon, in the user's order of points.
	DrawnHoles(const Holes &p_holes, const godot::PackedVector2Array &p_polygon, const godot::PackedVector2Array &p_hull);

	/// Number of points of each hole.
	std::span<const std::size_t> counts() const { return binding().counts(); }
	/// The holes of a body whose points, in the core's order, are now at `p_points`, as the user wound them.
	Holes follow(std::span<const Vec2> p_points, PointOrder p_order) const;
	/// Appends their points, wound against the polygon as the user gave it, or against its reverse.
	/// O(points of the holes · hull).
	void append(std::span<const Vec2> p_points, PointOrder p_order, bool p_against_reverse, std::vector<Vec2> &r_points) const;
	/// Sum of their areas for such a body, in the square of the unit of `p_points`.
	double area(std::span<const Vec2> p_points, PointOrder p_order) const;

private:
	/// Places of all points. Valid until the next call for any body.
	std::span<const Vec2> place(std::span<const Vec2> p_points, PointOrder p_order) const;

	const HoleBinding &binding() const;

	Holes holes_;
	std::vector<Vec2> hull_;
	std::vector<bool> winds_as_polygon_; ///< of each hole
	mutable std::shared_ptr<const HoleBinding> binding_;
};

} // namespace softbody
