// SPDX-License-Identifier: MIT
// Where an open chain touches the environment, or is about to.
#include "core/collision/chain_contacts.h"

#include "core/base/constants.h"
#include "core/collision/collider_contact.h"
#include "core/collision/convex_query.h"
#include "core/collision/environment_contact_solver.h"
#include "core/collision/surface_constraint.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

/// One chain against one surface.
struct Probe {
	const SoftBodyData &body;
	const Surface &surface; ///< in the world
	ContactOther::Kind kind;
	std::uint32_t index; ///< of the border or collider
	Real margin;
	std::vector<ChainContact> &contacts;

	/// `feature` as in `ContactPoint`. The place is on the way from the hull point a to b.
	void add(std::uint32_t a, std::uint32_t b, Real share, std::uint32_t feature, Vec2 place, Vec2 normal, Real gap) const {
		ChainContact contact;
		contact.section = body.shape().chain()->section_of(a);
		contact.other = body.shape().chain()->section_of(b);
		contact.share = double(share);
		contact.normal = Vec2d(normal);
		const double size = length(contact.normal);
		if (!(size > 0)) {
			return;
		}
		contact.normal = contact.normal * (1 / size);
		contact.velocity = Vec2d(surface.velocity_at(place));
		contact.gap = double(gap);
		contact.friction = double(combined_friction(body.settings(), surface));
		contact.source = { 0, kind, index, feature, share < Real(0.5) ? b : a, 0, place, Vec2(contact.normal), 0, std::max(-gap, Real(0)) };
		contacts.push_back(contact);
	}
};

void probe_points(const Probe &probe, const Collider &collider, const ColliderMotion &motion) {
	const std::span<const Vec2> hull = probe.body.hull();
	const Aabb bounds = collider.bounds().grown(probe.margin);
	const ChainShape &chain = *probe.body.shape().chain();
	for (std::uint32_t i = 0; i < hull.size(); ++i) {
		const Vec2 own = motion.own_to(hull[i]);
		if (!bounds.contains(Aabb::between(own, own))) {
			continue;
		}
		SurfaceDistance face = surface_distance(collider, own);
		if (collider.vertices.size() == 2 && !(collider.radius > 0)) {
			// A line has two sides. The section is on that of its center. Beyond the ends the corners count.
			const Vec2 edge = collider.vertices[1] - collider.vertices[0];
			const Real along = dot(own - collider.vertices[0], edge);
			if (along < 0 || along > length_squared(edge)) {
				continue;
			}
			const Vec2 center = motion.own_to(probe.body.positions()[chain.sections()[chain.section_of(i)].center]);
			const Real side = distance_to_line(collider, center) < 0 ? Real(-1) : Real(1);
			face = { distance_to_line(collider, own) * side, Vec2{ edge.y, -edge.x } * (side / length(edge)) };
		}
		if (face.distance < probe.margin && face.distance > -4 * probe.margin) {
			probe.add(i, i, 1, i, hull[i], motion.turned(face.normal), face.distance);
		}
	}
}

void probe_corners(const Probe &probe, const Collider &collider, const ColliderMotion &motion) {
	const std::span<const Vec2> hull = probe.body.hull();
	const Aabb box = bounding_box(hull).grown(probe.margin + collider.radius);
	for (std::size_t corner = 0; corner < collider.vertices.size(); ++corner) {
		if (collider.concave) {
			const std::size_t count = collider.vertices.size();
			if (signed_double_area(collider.vertices[(corner + count - 1) % count], collider.vertices[corner], collider.vertices[(corner + 1) % count]) <= 0) {
				continue; // nothing can enter it
			}
		}
		const Vec2 place = motion.is_still ? collider.vertices[corner] : motion.to.apply(collider.vertices[corner]);
		if (!box.contains(Aabb::between(place, place))) {
			continue;
		}
		const OutlinePlace nearest = nearest_place(hull, place);
		const Real distance = std::sqrt(nearest.distance_squared);
		const std::size_t next = (nearest.edge + 1) % hull.size();
		const Vec2 edge = hull[next] - hull[nearest.edge];
		const bool is_inside = distance > 0 && point_in_polygon(place, hull);
		const Real gap = (is_inside ? -distance : distance) - collider.radius;
		if (!(gap < probe.margin) || gap < -4 * probe.margin - collider.radius) {
			continue;
		}
		const bool is_on_edge = !(distance > Real(1e-4) * length(edge));
		const Vec2 away = is_on_edge ? perpendicular(edge) : (nearest.position - place) * (is_inside ? Real(-1) : Real(1));
		probe.add(std::uint32_t(nearest.edge), std::uint32_t(next), 1 - nearest.t, ContactPoint::CORNER | std::uint32_t(corner), nearest.position, away, gap);
	}
}

} // namespace

void ChainContactFinder::find(const ColliderIndex &surroundings, const SoftBodyData &body, Real elapsed, Real h,
		std::vector<ChainContact> &contacts) {
	contacts.clear();
	const WorldData &world = surroundings.world();
	const Real slop = LINEAR_SLOP * world.length_unit();
	// Twice: the solver may make places faster than they are.
	const Real margin = 2 * (fastest(body.velocities()) * h + length(body.total_acceleration(world.gravity())) * h * h + slop);
	if (!std::isfinite(margin)) {
		return;
	}
	for (std::uint32_t index = 0; index < world.borders().size(); ++index) {
		const Border &border = world.borders()[index];
		if (!notices(body, border.surface)) {
			continue;
		}
		const Probe probe{ body, border.surface, ContactOther::Kind::BORDER, index, margin, contacts };
		for (std::uint32_t i = 0; i < body.hull().size(); ++i) {
			const Real distance = signed_distance(border.plane, body.hull()[i]);
			if (distance < margin) {
				probe.add(i, i, 1, i, body.hull()[i], border.plane.normal, distance);
			}
		}
	}
	if (!surroundings.has_colliders()) {
		return;
	}
	surroundings.collect(bounding_box(body.hull()).grown(margin), colliders_);
	for (const std::uint32_t index : colliders_) {
		const Collider &collider = world.colliders()[index];
		if (!notices(body, collider.surface) || collider.is_one_way()) {
			continue;
		}
		ColliderMotion motion;
		Surface surface = collider.surface;
		if (collider.rigid_body != NO_RIGID_BODY) {
			const RigidBody &mover = world.rigid_bodies()[collider.rigid_body];
			motion = { mover.pose_after(elapsed), mover.pose_after(elapsed), false };
			surface = surface_in_motion(collider.surface, mover, motion.to);
		}
		const Probe probe{ body, surface, ContactOther::Kind::COLLIDER, index, margin, contacts };
		probe_points(probe, collider, motion);
		probe_corners(probe, collider, motion);
	}
}

} // namespace softbody
