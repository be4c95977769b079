// SPDX-License-Identifier: MIT
// Lists of the dynamic colliders near soft bodies.
#include "core/collision/rigid_contact_search.h"

#include "core/base/pack.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

constexpr Real ROOM = Real(0.125); // share of a box's extent

} // namespace

void RigidContactSearch::begin_step(const WorldData &world, const ColliderIndex &index) {
	world_ = &world;
	index_ = &index;
	count_ = 0;
	before_.clear();
	from_.resize(world.rigid_bodies().size());
}

void RigidContactSearch::add_body(SoftBodyData &body, const RigidSurroundings &surroundings) {
	if (count_ == bodies_.size()) {
		bodies_.emplace_back();
	}
	NearBody &near = bodies_[count_++];
	near.body = &body;
	near.positions = body.mutable_positions();
	near.velocities = body.mutable_velocities();
	near.inverse_masses = body.inverse_masses();
	near.hull_count = body.hull().size();
	near.first_before = before_.size();
	near.surroundings = surroundings;
	before_.resize(before_.size() + near.hull_count);
}

void RigidContactSearch::begin_substep() {
	for (std::size_t i = 0; i < from_.size(); ++i) {
		from_[i] = world_->rigid_bodies()[i].pose;
	}
	for (const NearBody &near : std::span(bodies_).first(count_)) {
		std::ranges::copy(near.positions.first(near.hull_count), before_.begin() + std::ptrdiff_t(near.first_before));
	}
}

void RigidContactSearch::list_colliders(NearBody &body, const Aabb &swept) const {
	const Aabb box = with_room(swept);
	index_->collect_dynamic(box, body.relisted);
	body.surroundings = { box, body.relisted };
}

Aabb with_room(const Aabb &box) {
	return box.grown(ROOM * box.extent());
}

Aabb box_on_way(const Collider &collider, const ColliderMotion &motion, Real slop) {
	Real reach = 0;
	for (const Vec2 vertex : collider.vertices) {
		reach = std::max(reach, length_squared(vertex));
	}
	return Aabb::between(motion.from.position, motion.to.position).grown(std::sqrt(reach) + collider.radius + slop);
}

std::uint32_t points_on_way_into(const Aabb &box, const HullMotion &hull, std::size_t first) {
	const std::size_t count = hull.to.size();
	if (first + PACK_WIDTH > count) {
		std::uint32_t inside = 0;
		for (std::size_t i = first; i < count; ++i) {
			inside |= std::uint32_t(Aabb::between(hull.from[i], hull.to[i]).overlaps(box)) << (i - first);
		}
		return inside;
	}
	const BasicVec2<RealPack> from = consecutive(&hull.from[first]);
	const BasicVec2<RealPack> to = consecutive(&hull.to[first]);
	const PackMask in_x = both(!(lesser(from.x, to.x) > RealPack(box.max.x)), !(greater(from.x, to.x) < RealPack(box.min.x)));
	const PackMask in_y = both(!(lesser(from.y, to.y) > RealPack(box.max.y)), !(greater(from.y, to.y) < RealPack(box.min.y)));
	return bits(both(in_x, in_y));
}

} // namespace softbody
