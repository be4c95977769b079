// SPDX-License-Identifier: MIT
// Small random worlds, most of them absurd: whatever overlaps whatever, however fast and stiff, the outcome is finite, has no
// more energy than went in, and keeps momentum where nothing holds it.
#include "core/base/constants.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "support/compare.h"
#include "support/random.h"
#include "thesis/damping_ratio.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr int WORLDS = 10000;
constexpr int STEPS = 3;
constexpr Real TICK = Real(1) / 60;

/// 10 to a power in [least, most).
Real decades(Random &random, double least, double most) {
	return Real(std::pow(10, double(random.real(least, most))));
}

// Star-shaped, so that it is simple: corners in order of their angles, at any distance.
std::vector<Vec2> random_hull(Random &random, Real radius) {
	const int count = random.integer(3, 16);
	std::vector<Vec2> hull;
	for (int i = 0; i < count; ++i) {
		const Real angle = Real(6.2831853) * (Real(i) + random.real(0, 0.7)) / Real(count);
		hull.push_back(Rotation::from_angle(angle).apply({ radius * random.real(0.5, 1), 0 }));
	}
	return hull;
}

constexpr double LARGEST_COLLIDER = 1.9; ///< half of its longest way through

Collider random_collider(Random &random) {
	Collider collider;
	switch (random.integer(0, 3)) {
		case 0: collider.vertices = { { 0, 0 } }; break;
		case 1: collider.vertices = { { -1, 0 }, { 1, random.real(-0.5, 0.5) } }; break;
		case 2: collider.vertices = { { -1, Real(-0.2) }, { 1, Real(-0.2) }, { 1, Real(0.2) }, { -1, Real(0.2) } }; break;
		case 3: collider.vertices = { { -1, -1 }, { 1, Real(-0.6) }, { 0, random.real(-0.4, 1) } }; break;
	}
	collider.radius = collider.vertices.size() == 1 || random.chance(0.3) ? random.real(0.05, 0.5) : Real(0);
	collider.surface.friction = random.real(0, 1);
	return collider;
}

struct RandomWorld {
	WorldData world;
	bool is_free = false; ///< nothing acts from outside
	bool is_tame = false; ///< no body's method gains energy by itself
	Real fastest_mover = 0; ///< of the bodies that nothing can stop [m/s]
	/// What bounces between a piston and a wall gains with every bounce, so there is none beside one.
	Real largest_restitution = 0;
	double energy = 0; ///< that motion and all overlaps together can bring
};

Real random_restitution(const RandomWorld &scene, Random &random) {
	return random.chance(0.3) ? random.real(0, 1) * scene.largest_restitution : Real(0);
}

void add_environment(RandomWorld &scene, Random &random) {
	WorldData &world = scene.world;
	for (int i = random.integer(0, 2); i > 0; --i) {
		Border border{ { random.vector(2), Rotation::from_angle(random.real(0, 6.28)).apply({ 1, 0 }) }, {} };
		border.surface.friction = random.real(0, 1);
		border.surface.restitution = random_restitution(scene, random);
		REQUIRE_FALSE(world.add_border(border));
	}
	for (int i = random.integer(0, 3); i > 0; --i) {
		Collider collider = random_collider(random);
		collider.surface.restitution = random_restitution(scene, random);
		const Pose pose{ random.vector(2), Rotation::from_angle(random.real(0, 6.28)) };
		const int kind = random.integer(scene.largest_restitution > 0 ? 1 : 0, 2);
		if (kind == 1) {
			for (Vec2 &vertex : collider.vertices) {
				vertex = pose.apply(vertex);
			}
			REQUIRE_FALSE(world.add_collider(collider));
			continue;
		}
		RigidBody body;
		body.pose = pose;
		body.linear_velocity = random.vector(20);
		body.angular_velocity = random.real(-5, 5);
		const Real speed = length(body.linear_velocity) + 2 * std::abs(body.angular_velocity);
		if (kind == 2) {
			const Real mass = decades(random, -1.5, 1.5);
			body.inverse_mass = 1 / mass;
			body.inverse_inertia = 2 / mass;
			body.acceleration = world.gravity();
			scene.energy += 0.5 * mass * std::pow(double(speed) + double(length(world.gravity())) * STEPS * TICK, 2);
		} else {
			scene.fastest_mover = std::max(scene.fastest_mover, speed);
		}
		collider.rigid_body = world.add_rigid_body(body).value();
		REQUIRE_FALSE(world.add_collider(collider));
	}
}

// Strain of a body squeezed flat, or turned inside out, when the hull was moved out of something and the middle was left
// behind: every spring has changed by a diameter and that way at most.
double largest_strain_energy(const SoftBodyShape &shape, const BodySettings &settings, double way) {
	const double most = std::pow(2 * double(shape.radius()) + way, 2);
	double energy = 0;
	for (const Spring2D &spring : shape.springs()) {
		energy += 0.5 * spring.stiffness * most;
	}
	energy += 0.5 * settings.shape_stiffness * double(shape.point_count()) * most;
	const double area = 3.15 * double(shape.radius()) * shape.radius();
	return energy + settings.pressure_stiffness * (1 + settings.inflation) * 2 * area; // pressure times what it pushed away
}

// How far a hull may have to move out of where it starts.
double deepest_start(const WorldData &world, const SoftBodyData &body) {
	double deepest = world.colliders().empty() ? 0 : LARGEST_COLLIDER;
	for (const Border &border : world.borders()) {
		for (const Vec2 p : body.hull()) {
			deepest = std::max(deepest, double(-signed_distance(border.plane, p)));
		}
	}
	return deepest;
}

// At every step without damping, or when crumpled (see SubstepPlan::safe).
bool gains_energy(Integrator method) {
	return method == Integrator::EXPLICIT_EULER || method == Integrator::MIDPOINT || method == Integrator::HEUN;
}

void add_body(RandomWorld &scene, Random &random) {
	const Real radius = random.real(0.3, 1);
	const Real mass = decades(random, -1.5, 1.5);
	const Real stiffness = decades(random, 0, 4);
	const std::vector<Vec2> hull = random_hull(random, radius);
	const Real damping = damping_for_ratio(random.real(0, 0.3), stiffness, mass, hull.size() + 1);
	const auto shape = SoftBodyCreator::create_polygon(hull, { mass, stiffness, damping, random.chance(0.8) });
	if (!shape) {
		return; // its middle lies on a corner
	}
	BodySettings settings;
	settings.integrator = Integrator(random.integer(0, INTEGRATOR_COUNT - 1));
	if (scene.is_tame && gains_energy(settings.integrator)) {
		settings.integrator = Integrator::AUTOMATIC;
	}
	settings.friction = random.real(0, 1);
	settings.restitution = random_restitution(scene, random);
	settings.rolling_resistance = random.chance(0.5) ? Real(0.05) : Real(0);
	settings.shape_stiffness = random.chance(0.5) ? Real(0.4) * stiffness : Real(0);
	settings.pressure_stiffness = random.chance(0.2) ? Real(0.3) * stiffness : Real(0);
	settings.contact_monitor = random.chance(0.5);
	const Pose pose{ random.vector(2), Rotation::from_angle(random.real(0, 6.28)) };
	for (const Border &border : scene.world.borders()) {
		// A body whose middle is far behind a border is torn apart: its hull is moved out at once, its inner points are not.
		if (signed_distance(border.plane, pose.position) < -radius / 2) {
			return;
		}
	}
	SoftBodyData body = SoftBodyData::create(shape.value(), settings, pose).value();
	if (scene.is_tame && !plan_substeps(body, TICK, scene.world.has_environment()).safe) {
		settings.integrator = Integrator::AUTOMATIC;
		body.set_settings(settings);
	}
	const Vec2 velocity = Rotation::from_angle(random.real(0, 6.28)).apply({ random.chance(0.5) ? random.real(0, 50 * double(radius)) : Real(0), 0 });
	double speed = 0;
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], velocity + random.vector(0.1) * radius);
		speed = std::max(speed, double(length(body.velocities()[i])));
	}
	const double reach = speed + 2 * double(scene.fastest_mover) + double(length(scene.world.gravity())) * STEPS * TICK;
	scene.energy += 0.5 * mass * reach * reach + largest_strain_energy(body.shape(), settings, deepest_start(scene.world, body));
	scene.world.add_soft_body(std::move(body));
}

RandomWorld random_world(Random &random) {
	RandomWorld scene;
	scene.is_free = random.chance(0.3);
	scene.is_tame = random.chance(0.8);
	scene.largest_restitution = random.chance(0.5) ? Real(1) : Real(0);
	if (!scene.is_free) {
		scene.world.set_gravity(random.vector(20));
		add_environment(scene, random);
	}
	for (int i = random.integer(2, 5); i > 0; --i) {
		add_body(scene, random);
	}
	// A bounce gives the body as a whole back what wobble has taken from its flight, and leaves it the wobble.
	scene.energy *= scene.largest_restitution > 0 ? 2 : 1;
	return scene;
}

struct Motion {
	double x = 0;
	double y = 0;
	double size = 0; ///< sum of mass times speed
	double energy = 0; ///< kinetic
	bool is_finite = true;
};

Motion motion_of(const WorldData &world) {
	Motion motion;
	for (const SoftBodyData &body : world.soft_bodies()) {
		motion.is_finite &= all_finite(body.positions()) && all_finite(body.velocities());
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			const double mass = body.shape().masses()[i];
			const Vec2 v = body.velocities()[i];
			motion.x += mass * v.x;
			motion.y += mass * v.y;
			motion.size += mass * double(length(v));
			motion.energy += 0.5 * mass * double(length_squared(v));
		}
	}
	return motion;
}

} // namespace

// Methods that gain energy by themselves may ruin a body, which is then reset: of worlds with them, only the first is claimed.
TEST_CASE("in ten thousand random worlds all stays finite, nobody has more energy than there was, momentum is kept") {
	Random random(20);
	for (int number = 0; number < WORLDS; ++number) {
		CAPTURE(number);
		RandomWorld scene = random_world(random);
		Simulator simulator(scene.world);
		const Motion before = motion_of(scene.world);
		double size = before.size;
		for (int step = 0; step < STEPS; ++step) {
			const StepReport report = simulator.simulate(TICK);
			const Motion now = motion_of(scene.world);
			REQUIRE(now.is_finite);
			REQUIRE((report.reset_bodies.empty() || !scene.is_tame));
			REQUIRE((now.energy <= scene.energy || !scene.is_tame));
			size = std::max(size, now.size);
			if (scene.is_free && scene.is_tame) {
				// Dozens of substeps, each of which rounds every velocity a few times, to either side.
				REQUIRE(std::hypot(now.x - before.x, now.y - before.y) <= 30 * EPSILON * size);
			}
			for (const Contact &contact : simulator.contacts()) {
				REQUIRE((is_finite(contact.point) && std::isfinite(contact.normal_impulse) && contact.normal_impulse >= 0));
				REQUIRE(std::abs(length(contact.normal) - 1) < 1e-3);
				REQUIRE(contact.depth >= 0);
			}
		}
	}
}
