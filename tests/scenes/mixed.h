// SPDX-License-Identifier: MIT
// A world in which most of what the core can do happens at once, to compare runs to the last bit.
#pragma once

#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"
#include "scenes/chain.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody::testing {

/// An octagon whose corners are written down, not computed.
inline std::shared_ptr<const SoftBodyShape> octagon(Real radius, Real stiffness, Real damping) {
	constexpr Real HALF = Real(0.70710678);
	constexpr std::array<Vec2, 8> CORNERS = { Vec2{ 1, 0 }, { HALF, HALF }, { 0, 1 }, { -HALF, HALF }, { -1, 0 },
		{ -HALF, -HALF }, { 0, -1 }, { HALF, -HALF } };
	std::array<Vec2, 8> hull;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		hull[i] = CORNERS[i] * radius;
	}
	return SoftBodyCreator::create_polygon(hull, { 1, stiffness, damping, true }).value();
}

enum MixedTag : std::uint64_t {
	NO_TAG,
	GROUND,
	WALL,
	BOX,
	CHAIN,
	PISTON,
	CRATE,
};

/// In meters, y up: two piles of like bodies, one of every integrator, balloons, a body on a pin, bouncing ones, borders, a
/// box, a chain, a piston, a crate that is pushed. `spin` [rad/s] turns a paddle, and lets the crate
/// turn. With `monitors` every second body monitors its contacts.
inline WorldData mixed_world(Real spin = 0, bool monitors = true) {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	const auto tagged = [](MixedTag tag) {
		Surface surface;
		surface.tag = tag;
		return surface;
	};
	world.add_border({ { { 0, 0 }, { 0, 1 } }, tagged(GROUND) });
	world.add_border({ { { -8, 0 }, { 1, 0 } }, tagged(WALL) });
	world.add_border({ { { 20, 0 }, { -1, 0 } }, tagged(WALL) });
	world.add_collider({ { { -6, 0 }, { -4, 0 }, { -4, Real(0.5) }, { -6, 1 } }, Real(0.1), tagged(BOX) });
	const std::array<Vec2, 4> slope = { Vec2{ 6, 2 }, { 8, Real(0.8) }, { 10, Real(0.4) }, { 12, Real(0.3) } };
	Collider link;
	link.surface = tagged(CHAIN);
	add_chain(world, slope, false, link);

	const auto add_moving = [&](RigidBody body, MixedTag tag, Vec2 half) {
		Collider box{ { { -half.x, -half.y }, { half.x, -half.y }, half, { -half.x, half.y } }, 0, tagged(tag) };
		box.rigid_body = world.add_rigid_body(body).value();
		world.add_collider(box);
	};
	RigidBody piston;
	piston.pose.position = { -8, Real(1.6) };
	piston.linear_velocity = { Real(0.6), 0 };
	add_moving(piston, PISTON, { 1, Real(0.3) });
	RigidBody paddle;
	paddle.pose.position = { 15, Real(1.2) };
	paddle.angular_velocity = spin;
	add_moving(paddle, PISTON, { Real(0.8), Real(0.1) });
	RigidBody crate; // held up by nothing but soft bodies
	crate.pose.position = { 2, 4 };
	crate.acceleration = world.gravity();
	crate.inverse_mass = 2;
	crate.inverse_inertia = spin != 0 ? Real(8) : Real(0);
	add_moving(crate, CRATE, { Real(0.6), Real(0.3) });

	int count = 0;
	const auto add = [&](const std::shared_ptr<const SoftBodyShape> &shape, BodySettings settings, Vec2 place) {
		settings.contact_monitor = monitors && ++count % 2 == 0;
		return world.add_soft_body(SoftBodyData::create(shape, settings, { place, {} }).value());
	};
	BodySettings jelly;
	jelly.shape_stiffness = 400;
	jelly.shape_damping = 4;
	jelly.rolling_resistance = Real(0.05);
	const auto like = octagon(Real(0.4), 1000, 2);
	for (int i = 0; i < 12; ++i) { // the first pile, under the crate
		add(like, jelly, { Real(0.9) * Real(i % 4), Real(0.5) + Real(0.85) * Real(i / 4) });
	}
	BodySettings springs;
	springs.rolling_resistance = Real(0.05);
	const auto soft = octagon(Real(0.3), 300, 1);
	for (int i = 0; i < 8; ++i) { // the second, on the box and beside it
		add(soft, springs, { Real(-5.5) + Real(0.65) * Real(i % 4), Real(1.5) + Real(0.65) * Real(i / 4) });
	}
	for (int i = 0; i < INTEGRATOR_COUNT; ++i) { // down the slope, onto the paddle and one another
		BodySettings each = springs;
		each.integrator = Integrator(i);
		each.friction = Real(0.1) * Real(i);
		add(octagon(Real(0.3), 400, 2), each, { Real(6.3) + Real(1.3) * Real(i), Real(2.6) + Real(0.1) * Real(i % 3) });
	}
	BodySettings balloon;
	balloon.pressure_stiffness = 300;
	balloon.inflation = Real(1.1);
	for (int i = 0; i < 3; ++i) {
		add(octagon(Real(0.35), 150, 2), balloon, { Real(-3) + Real(0.8) * Real(i), Real(4.5) });
	}
	BodySettings stiff = springs;
	stiff.integrator = Integrator::XPBD;
	for (int i = 0; i < 2; ++i) {
		add(octagon(Real(0.4), Real(2e5), 0), stiff, { Real(4.4), Real(0.5) + Real(0.9) * Real(i) });
	}
	BodySettings bouncing = springs;
	bouncing.restitution = Real(0.7);
	add(soft, bouncing, { 13, 3 });
	const BodyId pinned = add(like, jelly, { Real(1.5), Real(4.8) });
	world.find(pinned)->set_pinned(2, true);
	return world;
}

/// FNV-1a, over all bits of numbers.
class BitHash {
public:
	template <class Number>
	void add(Number number) {
		const auto bits = std::bit_cast<std::array<unsigned char, sizeof(Number)>>(number);
		for (const unsigned char byte : bits) {
			state_ = (state_ ^ byte) * 0x100000001b3u;
		}
	}
	void add(Vec2 value) {
		add(value.x);
		add(value.y);
	}
	std::uint64_t value() const { return state_; }

private:
	std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// All that the next step could depend on.
inline std::uint64_t hash_of_state(const WorldData &world) {
	BitHash hash;
	for (const SoftBodyData &body : world.soft_bodies()) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			hash.add(body.positions()[i]);
			hash.add(body.velocities()[i]);
		}
		hash.add(body.rest_time());
		hash.add(std::uint8_t(body.is_asleep()));
		for (std::size_t i = 0; body.is_dented() && i < body.point_count(); ++i) {
			hash.add(body.shape().rest_positions()[i]);
		}
	}
	for (const RigidBody &body : world.rigid_bodies()) {
		hash.add(body.pose.position);
		hash.add(body.pose.rotation.c);
		hash.add(body.pose.rotation.s);
		hash.add(body.linear_velocity);
		hash.add(body.angular_velocity);
	}
	return hash.value();
}

/// Everything that a step tells about contacts.
inline std::uint64_t hash_of_contacts(const Simulator &simulator) {
	BitHash hash;
	const auto add_sides = [&](BodyId body, const ContactOther &other) {
		for (const BodyId id : { body, other.body }) {
			hash.add(id.index);
			hash.add(id.generation);
		}
		hash.add(std::uint8_t(other.kind));
		hash.add(other.index);
		hash.add(other.rigid_body);
		hash.add(other.tag);
	};
	for (const Contact &contact : simulator.contacts()) {
		add_sides(contact.body, contact.other);
		hash.add(contact.hull_point);
		hash.add(contact.point);
		hash.add(contact.normal);
		hash.add(contact.normal_impulse);
		hash.add(contact.depth);
	}
	for (const ContactEvent &event : simulator.contact_events()) {
		hash.add(std::uint8_t(event.kind));
		add_sides(event.body, event.other);
	}
	return hash.value();
}

} // namespace softbody::testing
