// SPDX-License-Identifier: MIT
// Grids over static, kinematic and dynamic colliders.
#include "core/collision/collider_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softbody {

namespace {

// Box of the whole path of the collider while its body moves for `dt`. Between two poses a vertex at distance r from
// the center of mass that turns by the angle a leaves the chord by r (1 - cos(a/2)) <= r a² / 8. Beyond a straight
// angle the whole circle counts.
Aabb swept_bounds(const Collider &collider, const RigidBody &body, Real dt) {
	const Pose to = body.pose_after(dt);
	Aabb box;
	Real farthest = 0;
	for (const Vec2 vertex : collider.vertices) {
		box.include(body.pose.apply(vertex));
		box.include(to.apply(vertex));
		farthest = std::max(farthest, length(vertex - body.center_of_mass));
	}
	Real margin = collider.radius;
	const Real angle = std::abs(body.angular_velocity) * dt;
	if (angle > std::numbers::pi_v<Real>) {
		box.include(body.center());
		box.include(to.apply(body.center_of_mass));
		margin += farthest;
	} else {
		margin += farthest * angle * angle / 8;
	}
	if (body.is_dynamic()) {
		margin += length(body.acceleration) * dt * dt;
	}
	return box.grown(margin);
}

} // namespace

void ColliderIndex::update(const WorldData &world, Real dt) {
	if (world_ != &world || version_ != world.environment_version()) {
		world_ = &world;
		version_ = world.environment_version();
		update_still();
	}
	update_moving(dt);
}

void ColliderIndex::update_still() {
	bounds_.clear();
	boxes_.clear();
	names_.clear();
	moving_.clear();
	bounces_ = std::ranges::any_of(world_->colliders(), [](const Collider &each) { return each.surface.restitution != 0; });
	for (const Collider &collider : world_->colliders()) {
		const std::uint32_t name = std::uint32_t(bounds_.size());
		bounds_.push_back(collider.bounds());
		if (collider.rigid_body == NO_RIGID_BODY) {
			boxes_.push_back(bounds_.back());
			names_.push_back(name);
		} else {
			moving_.push_back(name);
		}
	}
	still_.assign(boxes_, names_);
	kinematic_.assign({}, {});
	dynamic_.assign({}, {});
}

void ColliderIndex::update_moving(Real dt) {
	if (moving_.empty()) {
		return;
	}
	for (const bool is_dynamic : { false, true }) {
		boxes_.clear();
		names_.clear();
		for (const std::uint32_t name : moving_) {
			const Collider &collider = world_->colliders()[name];
			const RigidBody &body = world_->rigid_bodies()[collider.rigid_body];
			if (body.is_dynamic() == is_dynamic) {
				bounds_[name] = swept_bounds(collider, body, dt);
				boxes_.push_back(bounds_[name]);
				names_.push_back(name);
			}
		}
		(is_dynamic ? dynamic_ : kinematic_).assign(boxes_, names_);
	}
}

// Contacts are solved in the order of the world's list.
void ColliderIndex::collect(const Aabb &box, std::vector<std::uint32_t> &colliders) const {
	colliders.clear();
	still_.collect(box, colliders);
	kinematic_.collect(box, colliders);
	std::ranges::sort(colliders);
}

void ColliderIndex::collect_dynamic(const Aabb &box, std::vector<std::uint32_t> &colliders) const {
	colliders.clear();
	dynamic_.collect(box, colliders);
	std::ranges::sort(colliders);
}

} // namespace softbody
