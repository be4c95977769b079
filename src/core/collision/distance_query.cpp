// SPDX-License-Identifier: MIT
// Whether a body is close to a body or surface that it has touched.
#include "core/collision/distance_query.h"

#include "core/base/constants.h"
#include "core/collision/convex_query.h"
#include "core/collision/surface_constraint.h"
#include "core/geometry/polygon.h"

#include <algorithm>

namespace softbody {

namespace {

bool is_point_near(Vec2 p, std::span<const Vec2> hull, Real gap) {
	return nearest_place(hull, p).distance_squared < gap * gap;
}

// For polygons that do not overlap, the closest points include a corner of one of them.
bool has_point_near(std::span<const Vec2> points, std::span<const Vec2> hull, Real gap) {
	const Aabb box = bounding_box(hull).grown(gap);
	return std::ranges::any_of(points, [&](Vec2 p) { return box.contains({ p, p }) && is_point_near(p, hull, gap); });
}

bool is_near_collider(const WorldData &world, const Collider &collider, std::span<const Vec2> hull, Real gap) {
	const Pose pose = collider.rigid_body == NO_RIGID_BODY ? Pose{} : world.rigid_bodies()[collider.rigid_body].pose;
	const Real slop = LINEAR_SLOP * world.length_unit();
	const auto has_near = [&](Vec2 p) { return surface_distance(collider, pose.apply_inverse(p), slop).distance < gap; };
	if (std::ranges::any_of(hull, has_near)) {
		return true;
	}
	const Aabb box = bounding_box(hull).grown(gap + collider.radius);
	return std::ranges::any_of(collider.vertices, [&](Vec2 corner) {
		const Vec2 place = pose.apply(corner);
		return box.contains({ place, place }) && is_point_near(place, hull, gap + collider.radius);
	});
}

} // namespace

bool are_near(const SoftBodyData &a, const SoftBodyData &b, Real gap) {
	const BodySettings &one = a.settings();
	const BodySettings &other = b.settings();
	const bool notice = (one.collision_mask & other.collision_layer) != 0 || (other.collision_mask & one.collision_layer) != 0;
	return notice && (has_point_near(a.hull(), b.hull(), gap) || has_point_near(b.hull(), a.hull(), gap));
}

bool is_near_tag(const ColliderIndex &surroundings, const SoftBodyData &body, std::uint64_t tag, Real gap,
		std::vector<std::uint32_t> &scratch) {
	const WorldData &world = surroundings.world();
	const auto matters = [&](const Surface &surface) {
		return surface.tag == tag && notices(body, surface);
	};
	for (const Border &border : world.borders()) {
		if (matters(border.surface) && std::ranges::any_of(body.hull(), [&](Vec2 p) { return signed_distance(border.plane, p) < gap; })) {
			return true;
		}
	}
	const Aabb box = bounding_box(body.hull()).grown(gap);
	const auto is_near = [&](std::uint32_t i) {
		const Collider &collider = world.colliders()[i];
		return matters(collider.surface) && is_near_collider(world, collider, body.hull(), gap);
	};
	surroundings.collect(box, scratch);
	if (std::ranges::any_of(scratch, is_near)) {
		return true;
	}
	surroundings.collect_dynamic(box, scratch);
	return std::ranges::any_of(scratch, is_near);
}

} // namespace softbody
