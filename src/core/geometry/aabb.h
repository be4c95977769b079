// SPDX-License-Identifier: MIT
// Boxes along the axes.
#pragma once

#include "core/base/vec2.h"

#include <algorithm>
#include <span>

namespace softbody {

/// Axis-aligned bounding box. Empty (min > max) when default constructed.
struct Aabb {
	Vec2 min{ Real(1e30), Real(1e30) };
	Vec2 max{ Real(-1e30), Real(-1e30) };

	/// The box around two points.
	static Aabb between(Vec2 a, Vec2 b) {
		Aabb box;
		box.include(a);
		box.include(b);
		return box;
	}
	/// A coordinate that is NaN changes nothing.
	void include(Vec2 p) {
		min = { std::min(min.x, p.x), std::min(min.y, p.y) };
		max = { std::max(max.x, p.x), std::max(max.y, p.y) };
	}
	/// The other box must not be empty.
	void include(const Aabb &other) {
		include(other.min);
		include(other.max);
	}
	Aabb grown(Real margin) const {
		return { { min.x - margin, min.y - margin }, { max.x + margin, max.y + margin } };
	}
	/// The longer side [length].
	Real extent() const { return std::max(max.x - min.x, max.y - min.y); }
	Vec2 center() const { return (min + max) * Real(0.5); }
	/// From the center to the corner `max`.
	Vec2 half_size() const { return (max - min) * Real(0.5); }
	bool overlaps(const Aabb &other) const {
		return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y;
	}
	bool contains(const Aabb &other) const {
		return min.x <= other.min.x && other.max.x <= max.x && min.y <= other.min.y && other.max.y <= max.y;
	}
};

/// Several boxes that grow side by side, for points that come PACK_WIDTH at a time.
class PackedAabb {
public:
	void include(const BasicVec2<RealPack> &p) {
		min_ = { lesser(p.x, min_.x), lesser(p.y, min_.y) };
		max_ = { greater(p.x, max_.x), greater(p.y, max_.y) };
	}
	/// The box around all lanes.
	Aabb joined() const {
		return { { least_lane(min_.x), least_lane(min_.y) }, { greatest_lane(max_.x), greatest_lane(max_.y) } };
	}

private:
	BasicVec2<RealPack> min_ = in_all_lanes<RealPack>(Aabb{}.min);
	BasicVec2<RealPack> max_ = in_all_lanes<RealPack>(Aabb{}.max);
};

/// The box around all points; empty without any. O(n).
inline Aabb bounding_box(std::span<const Vec2> points) {
	PackedAabb box;
	for (std::size_t i = 0; i < packs_for(points.size()); ++i) {
		box.include(pack_of(points, i));
	}
	return box.joined();
}

} // namespace softbody
