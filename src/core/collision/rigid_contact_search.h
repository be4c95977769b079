// SPDX-License-Identifier: MIT
// Finds where soft bodies touch dynamic rigid bodies in a substep.
#pragma once

#include "core/collision/collider_contact.h"
#include "core/collision/collider_index.h"
#include "core/collision/contact_log.h"
#include "core/geometry/aabb.h"
#include "core/model/world_data.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// The dynamic colliders that overlap a box during a step, in the order of the world's list.
struct RigidSurroundings {
	Aabb box; ///< empty: nothing is known
	std::span<const std::uint32_t> colliders;
};

/// A place of a soft body that a collider of a dynamic rigid body has met in a substep.
struct RigidTouch {
	std::uint32_t near = 0; ///< index of the soft body in the search
	std::uint32_t collider = 0;
	std::uint32_t feature = 0; ///< see ContactPoint
	SurfaceContact at;
};

/// Searches the soft bodies that may meet a dynamic rigid body in a step. The colliders near each are listed again only when the
/// body has left the box of its list.
class RigidContactSearch {
public:
	/// A soft body, and what every substep reads of it. Spans stay valid during the step.
	struct NearBody {
		SoftBodyData *body = nullptr;
		std::span<Vec2> positions;
		std::span<Vec2> velocities;
		std::span<const Real> inverse_masses;
		std::size_t hull_count = 0;
		std::size_t first_before = 0; ///< first of the body's hull points in `before_`
		RigidSurroundings surroundings;
		std::vector<std::uint32_t> relisted; ///< colliders, once the body has left the first list's box
	};

	/// Forgets the bodies of the last step. `world` and `index` must outlive the step.
	void begin_step(const WorldData &world, const ColliderIndex &index);
	/// Adds a soft body, which gets the next index. The list of its surroundings must outlive the step.
	void add_body(SoftBodyData &body, const RigidSurroundings &surroundings);
	std::size_t body_count() const { return count_; }
	const NearBody &body(std::size_t near) const { return bodies_[near]; }

	/// Remembers where bodies are at the start of a substep.
	void begin_substep();
	/// Calls `visit(touch)` for each touch of the body `near` since then: those of a collider in a row, colliders in the order of the
	/// world's list. Different bodies may be searched on different threads. O(hull points × colliders near).
	template <class Visit>
	void find(std::size_t near, const Visit &visit);

private:
	void list_colliders(NearBody &body, const Aabb &swept) const;
	/// Where a collider's rigid body was at the start of the substep, and where it is now.
	ColliderMotion motion_of(const Collider &collider) const {
		return { from_[collider.rigid_body], world_->rigid_bodies()[collider.rigid_body].pose, false };
	}

	const WorldData *world_ = nullptr;
	const ColliderIndex *index_ = nullptr;
	std::vector<NearBody> bodies_; ///< the first `count_` are of this step; the others keep their memory
	std::size_t count_ = 0;
	std::vector<Vec2> before_; ///< hull points at the start of the substep
	std::vector<Pose> from_; ///< of every rigid body, at the start of the substep
};

/// A box with room around it, for a list of surroundings that is to hold for some substeps.
Aabb with_room(const Aabb &box);

/// Box around a collider on its way, however it turns.
Aabb box_on_way(const Collider &collider, const ColliderMotion &motion, Real slop);

/// Bit mask of up to PACK_WIDTH hull points from `first` on whose way comes into the box; of points that are not finite, any.
std::uint32_t points_on_way_into(const Aabb &box, const HullMotion &hull, std::size_t first);

template <class Visit>
void RigidContactSearch::find(std::size_t near, const Visit &visit) {
	NearBody &body = bodies_[near];
	const HullMotion hull{ std::span<const Vec2>(before_).subspan(body.first_before, body.hull_count), body.positions.first(body.hull_count) };
	const Aabb swept = hull.box();
	if (!body.surroundings.box.contains(swept)) {
		list_colliders(body, swept);
	}
	const Real slop = LINEAR_SLOP * world_->length_unit();
	for (const std::uint32_t i : body.surroundings.colliders) {
		if (!index_->bounds(i).overlaps(swept)) {
			continue;
		}
		const Collider &collider = world_->colliders()[i];
		const ColliderMotion motion = motion_of(collider);
		const Aabb box = box_on_way(collider, motion, slop);
		if (!box.overlaps(swept) || !notices(*body.body, collider.surface)) {
			continue;
		}
		const Aabb bounds = collider.bounds().grown(slop);
		for (std::size_t first = 0; first < hull.to.size(); first += PACK_WIDTH) {
			for (std::uint32_t left = points_on_way_into(box, hull, first); left != 0; left &= left - 1) {
				const std::uint32_t point = std::uint32_t(first) + std::uint32_t(std::countr_zero(left));
				if (const auto at = find_contact_of_point(hull, point, collider, motion, bounds, slop)) {
					visit(RigidTouch{ std::uint32_t(near), i, point, *at });
				}
			}
		}
		for (std::uint32_t corner = 0; corner < collider.vertices.size(); ++corner) {
			if (const auto at = find_contact_of_corner(hull, swept, collider, corner, motion, slop)) {
				visit(RigidTouch{ std::uint32_t(near), i, ContactPoint::CORNER | corner, *at });
			}
		}
	}
}

} // namespace softbody
