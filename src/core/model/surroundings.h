// SPDX-License-Identifier: MIT
// The environment of bodies: borders (half-planes) and rounded colliders.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/geometry/plane.h"
#include "core/geometry/polygon.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace softbody {

/// The environment's side of a contact. Values combine with the body's by the rule of Godot's PhysicsMaterial. The
/// velocity is that of a surface which itself stays in place, like a belt's; colliders that move belong to a
/// `RigidBody`.
struct Surface {
	Real friction = 1; ///< Coulomb coefficient [1], >= 0; the smaller of body and surface counts
	bool rough = false; ///< this friction counts even where it is the larger
	Real restitution = 0; ///< [1], 0..1; added to the body's, at most 1
	bool absorbent = false; ///< subtracted from the body's instead, at least 0
	Vec2 linear_velocity; ///< of the surface at `velocity_origin` [length/s]
	Real angular_velocity = 0; ///< [rad/s]
	Vec2 velocity_origin; ///< center of that rotation [length]
	std::uint32_t layer = 1; ///< compared with BodySettings::collision_mask
	/// Identifies the owner of the surface for readers of contacts: surfaces with one tag are one thing to touch, also
	/// when the environment is made anew. 0: no owner.
	std::uint64_t tag = 0;

	/// Whether it moves anywhere, as a belt does.
	bool is_moving() const { return linear_velocity != Vec2{} || angular_velocity != 0; }
	/// Velocity at one place, or at several side by side.
	template <class T = Real>
	BasicVec2<T> velocity_at(BasicVec2<T> p) const {
		const BasicVec2<T> arm = p - in_all_lanes<T>(velocity_origin);
		return in_all_lanes<T>(linear_velocity) + perpendicular(arm) * T(angular_velocity);
	}

	friend bool operator==(const Surface &, const Surface &) = default;
};

/// A border of the world: everything behind the plane is solid (thesis 4.4.2, "borders").
struct Border {
	Plane plane;
	Surface surface;
};

/// `Collider::rigid_body` of a static collider.
inline constexpr std::uint32_t NO_RIGID_BODY = UINT32_MAX;

/// An obstacle, convex unless `concave`: the points within `radius` of the convex hull of `vertices`. One vertex is a
/// circle (radius > 0), two are a segment or capsule, three and more a polygon (rounded if radius > 0). Vertices wind
/// with positive signed area.
struct Collider {
	std::vector<Vec2> vertices; ///< in the frame of the rigid body, or of the world without one [length]
	Real radius = 0; ///< [length], >= 0
	Surface surface; ///< in the same frame; its velocity is added to that of the rigid body (conveyor)
	std::uint32_t rigid_body = NO_RIGID_BODY; ///< its owner: index in `WorldData::rigid_bodies()`
	/// The vertices are the outline of a simple polygon that may have dents; `radius` is 0. Each point is tested
	/// against every edge: a chain or several polygons are better for terrain of hundreds of corners.
	bool concave = false;
	/// For a segment in a chain: the far ends of the segments that go on from its first and second vertex. Places
	/// beside a neighbor are left to it, so that nothing stumbles over the round end at the joint.
	std::optional<Vec2> ghost_at_first = {};
	std::optional<Vec2> ghost_at_second = {};
	/// For a convex polygon without rounding: bit i is set where the edge from vertex i lies against that of a
	/// neighbor, as between tiles or the pieces of a larger polygon. No point passes through it, so none is pushed from
	/// one piece into the next. Edges from vertex 32 on cannot be marked. See `mark_internal_edges`.
	std::uint32_t internal_edges = 0;

	/// For a one-way collider: the direction out of the side that holds, a unit vector in the frame of the vertices;
	/// else zero. It holds bodies that come from the front. A body that comes from behind or from the side, or overlaps
	/// it deeper than the margin without having been held, passes until it is clear. Only the collider's own extent
	/// counts. Two like colliders on different rigid bodies need different tags. Colliders of dynamic rigid bodies hold
	/// from all sides.
	Vec2 one_way = {};
	Real one_way_margin = -1; ///< [length]; negative: ONE_WAY_MARGIN times the length unit

	bool is_one_way() const { return !(one_way == Vec2{}); }
	/// Box in the frame of the vertices.
	Aabb bounds() const { return bounding_box(vertices).grown(radius); }
};

/// Refuses a plane that is not finite or whose normal is not of unit length (to 1e-3), and bad surface values.
Status check_border(const Border &border);

/// Refuses an empty list of vertices, non-finite ones, a negative radius, a single point without radius, coincident
/// vertices, a polygon that is not convex (or, if `concave`, crosses itself) or winds negatively, rounded concave ones,
/// and bad surface values. O(vertices), O(vertices²) if concave.
Status check_collider(const Collider &collider);

} // namespace softbody
