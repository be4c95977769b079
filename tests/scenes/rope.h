// SPDX-License-Identifier: MIT
// Ropes and what hangs from them.
#pragma once

#include "core/creator/rope_creator.h"
#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"

#include <cmath>
#include <vector>

namespace softbody::testing {

inline constexpr Real ROPE_GRAVITY = 10;

/// Points along a line, at equal distances.
inline std::vector<Vec2> line(Vec2 from, Vec2 to, int count) {
	return divide_path(std::vector<Vec2>{ from, to }, count).value();
}

inline SoftBodyData rope_along(const std::vector<Vec2> &path, Real width, Real mass, const BodySettings &settings = {}) {
	const std::vector<Real> widths(path.size(), width);
	return SoftBodyData::create(create_rope(path, widths, mass).value(), settings).value();
}

/// The point on the centerline of section i.
inline std::uint32_t center_of(const SoftBodyData &rope, std::size_t i) {
	return rope.shape().chain()->sections()[i].center;
}
inline Vec2 center_place(const SoftBodyData &rope, std::size_t i) {
	return rope.positions()[center_of(rope, i)];
}

/// Present length of the centerline over that at rest.
inline double stretch_of(const SoftBodyData &rope) {
	double length = 0;
	for (std::size_t i = 1; i < rope.shape().chain()->count(); ++i) {
		const Vec2 way = center_place(rope, i) - center_place(rope, i - 1);
		length += std::hypot(double(way.x), double(way.y));
	}
	return length / double(rope.shape().chain()->total_length());
}

/// How far `found` is from `theory`, as a share of that.
inline double off(double found, double theory) {
	return std::abs(found - theory) / std::abs(theory);
}

struct RopeWorld {
	WorldData world;
	Simulator simulator;
	BodyId rope;

	explicit RopeWorld(SoftBodyData body, const ParallelFor &threads = {}) : simulator(world, threads) {
		(void)world.set_gravity({ 0, -ROPE_GRAVITY });
		rope = world.add_soft_body(std::move(body));
	}
	SoftBodyData &body() { return *world.find(rope); }
	void pin(std::size_t section) { (void)body().set_pinned(center_of(body(), section), true); }
	/// A disk or block of that mass, with the tag 100 + its index, that no collider shows.
	std::uint32_t add_weight(Vec2 place, Real mass, Real radius = Real(0.2)) {
		RigidBody weight;
		weight.pose.position = place;
		weight.inverse_mass = 1 / mass;
		weight.inverse_inertia = 2 / (mass * radius * radius);
		weight.acceleration = world.gravity();
		weight.tag = 100 + world.rigid_bodies().size();
		return world.add_rigid_body(weight).value();
	}
	JointId tie(std::size_t section, std::uint32_t weight, Vec2 at = {}, Real break_force = std::numeric_limits<Real>::infinity()) {
		Joint joint;
		joint.first = JointAnchor::on_point(rope, center_of(body(), section));
		joint.second = JointAnchor::on_rigid_body(world.rigid_bodies()[weight].tag, at);
		joint.break_force = break_force;
		return world.add_joint(joint).value();
	}
	JointId hang(std::size_t section, Vec2 place) {
		Joint joint;
		joint.first = JointAnchor::on_point(rope, center_of(body(), section));
		joint.second = JointAnchor::at_place(place);
		return world.add_joint(joint).value();
	}
	void run(double seconds) {
		for (int tick = 0; tick < int(std::lround(seconds * 60)); ++tick) {
			simulator.simulate(Real(1) / 60);
		}
	}
};

} // namespace softbody::testing
