// SPDX-License-Identifier: MIT
// A polygon that is drawn, and the hull of fewer points that is simulated in its place.
#pragma once

#include "core/creator/simplify_outline.h"
#include "core/skin/outline_binding.h"
#include "godot/convert.h"

#include <godot_cpp/variant/packed_vector2_array.hpp>

#include <memory>
#include <span>
#include <vector>

namespace softbody {

/// Where the points of a body are drawn, and how fast they move, in global coordinates: for a body of another hull.
struct DrawnMotion {
	std::vector<Vec2> outline; ///< in the user's order, as long as the polygon; empty without a body
	std::vector<Vec2> outline_velocities;
	std::vector<Vec2> inner; ///< inner points and the center point
	std::vector<Vec2> inner_velocities;
	Vec2 velocity; ///< of the center of mass
	Real angular_velocity = 0;
};

/// Made once for like polygons, and never changed. All in the node's coordinates and the user's order of points.
class DrawnOutline {
public:
	/// The outline of a polygon that `check_hull` accepts; null where its own points are simulated. O(points²) for a new
	/// polygon; the last few are kept. May be called from any thread.
	static std::shared_ptr<const DrawnOutline> find_or_make(const godot::PackedVector2Array &p_polygon, const SimplifyOptions &p_options);

	const godot::PackedVector2Array &hull() const { return hull_; }
	/// See `SimplifiedOutline::error`.
	double error() const { return error_; }
	std::size_t drawn_count() const { return drawn_.size(); }
	/// Points to draw for a body whose points at rest, the hull first, are these.
	std::vector<Vec2> drawn_rest(std::span<const Vec2> p_rest) const;
	/// The outline for a body whose points, in the core's order, are now at `p_points`, and then its inner points.
	/// Valid until the next call for any body. O(drawn · hull).
	std::span<const Vec2> follow(std::span<const Vec2> p_points, PointOrder p_order) const;
	/// The hull whose outline is nearest to these values of the drawn points. O(drawn · hull²).
	std::vector<Vec2> fit(std::span<const Vec2> p_drawn) const;

private:
	std::vector<Vec2> drawn_;
	godot::PackedVector2Array hull_;
	double error_ = 0;
	OutlineBinding binding_;
};

} // namespace softbody
