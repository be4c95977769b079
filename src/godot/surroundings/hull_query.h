// SPDX-License-Identifier: MIT
// Whether hulls overlap shapes of the engine, worked out from the points.
#pragma once

#include "core/geometry/aabb.h"
#include "godot/surroundings/shape_translation.h"

#include <span>

namespace softbody {

/// A shape of the engine at a place, against which hulls are tested exactly, dents included.
class HullQuery {
public:
	/// `shape` in the world, of which a world boundary is a half-plane; `margin` [px] is added around it, >= 0.
	HullQuery(TranslatedShape shape, Real margin);

	/// Whether the hull and the shape share a point, closer than the margin. O(points × vertices of the shape).
	bool overlaps(std::span<const Vec2> hull) const;

	/// Whether the shape reaches into the hull by more than `depth` [px], the margin left aside. A border does not count.
	/// O(points × vertices of the shape).
	bool reaches_in(std::span<const Vec2> hull, Real depth) const;

private:
	TranslatedShape shape_;
	Real margin_ = 0;
};

} // namespace softbody
