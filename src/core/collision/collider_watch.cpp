// SPDX-License-Identifier: MIT
// Finds changes of the environment of sleeping bodies.
#include "core/collision/collider_watch.h"

#include "core/base/hash.h"

#include <algorithm>
#include <iterator>

namespace softbody {

namespace {

void add(Hash &hash, const Surface &surface) {
	hash.add(surface.friction);
	hash.add(std::uint64_t(surface.rough) | std::uint64_t(surface.absorbent) << 1);
	hash.add(surface.restitution);
	hash.add(surface.linear_velocity);
	hash.add(surface.angular_velocity);
	hash.add(surface.velocity_origin);
	hash.add(std::uint64_t(surface.layer));
	hash.add(surface.tag); // a body resting on it is notified of the new tag
}

std::uint64_t hash_of(const Collider &collider) {
	Hash hash;
	for (const Vec2 vertex : collider.vertices) {
		hash.add(vertex);
	}
	hash.add(collider.radius);
	add(hash, collider.surface);
	hash.add(std::uint64_t(collider.concave));
	hash.add(collider.one_way);
	hash.add(collider.one_way_margin);
	return hash.value();
}

bool moves(const RigidBody &body) {
	return body.linear_velocity != Vec2{} || body.angular_velocity != 0;
}

// Hash of a collider including its pose.
std::uint64_t hash_in_place(const WorldData &world, const Collider &collider) {
	Hash hash;
	hash.add(hash_of(collider));
	if (collider.rigid_body != NO_RIGID_BODY) {
		const Pose &pose = world.rigid_bodies()[collider.rigid_body].pose;
		hash.add(pose.position);
		hash.add(pose.rotation.c);
		hash.add(pose.rotation.s);
	}
	return hash.value();
}

std::uint64_t hash_of_borders(const WorldData &world) {
	Hash hash;
	for (const Border &border : world.borders()) {
		hash.add(border.plane.position);
		hash.add(border.plane.normal);
		add(hash, border.surface);
	}
	return hash.value();
}

} // namespace

void ColliderWatch::update(const ColliderIndex &index) {
	const WorldData &world = index.world();
	const bool has_rigid_bodies = !world.rigid_bodies().empty();
	changed_.clear();
	moving_ = 0;
	border_changed_ = false;
	if (version_ == world.environment_version() && !has_rigid_bodies && !had_rigid_bodies_) {
		return;
	}
	version_ = world.environment_version();
	had_rigid_bodies_ = has_rigid_bodies;

	const std::uint64_t borders = hash_of_borders(world);
	border_changed_ = borders != border_hash_;
	border_hash_ = borders;

	std::swap(seen_, last_);
	seen_.clear();
	for (std::uint32_t i = 0; i < world.colliders().size(); ++i) {
		const Collider &collider = world.colliders()[i];
		if (collider.rigid_body != NO_RIGID_BODY && moves(world.rigid_bodies()[collider.rigid_body])) {
			changed_.push_back(index.bounds(i));
		}
		seen_.push_back({ hash_in_place(world, collider), index.bounds(i) });
	}
	moving_ = changed_.size();
	std::ranges::sort(seen_, {}, &Seen::hash);
	// A collider in only one of both lists has changed.
	differing_.clear();
	std::ranges::set_symmetric_difference(last_, seen_, std::back_inserter(differing_), {}, &Seen::hash, &Seen::hash);
	std::ranges::transform(differing_, std::back_inserter(changed_), &Seen::box);
}

// A sum, so that the order of the world's list does not matter.
std::uint64_t ColliderWatch::describe(const ColliderIndex &index, const Aabb &box) {
	std::uint64_t sum = hash_of_borders(index.world());
	const WorldData &world = index.world();
	index.collect(box, near_);
	for (const std::uint32_t i : near_) {
		sum += hash_in_place(world, world.colliders()[i]);
	}
	index.collect_dynamic(box, near_);
	for (const std::uint32_t i : near_) {
		if (world.rigid_bodies()[world.colliders()[i].rigid_body].asleep) {
			sum += hash_in_place(world, world.colliders()[i]);
		}
	}
	return sum;
}

} // namespace softbody
