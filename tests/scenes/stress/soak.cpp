// SPDX-License-Identifier: MIT
// A scene that goes on for hours.
#include "scenes/stress/soak.h"

#include "scenes/stress/bodies.h"
#include "support/compare.h"

#include <algorithm>
#include <vector>

namespace softbody::testing {

namespace {

constexpr double SETTLED = 60; ///< [s]
constexpr Real BIN = 130; ///< half the width of a bin, of which there are three

// A pile that may sleep in the first bin, a paddle among four bodies in the second, who comes and goes in the third, and left
// of them all two bodies apart from each other that are kept awake.
struct Soak {
	WorldData world = pixel_world();
	std::vector<BodyId> awake;
	std::vector<BodyId> sleepers;
	BodyId guest;
	StressSetup setup;

	Soak() {
		world.add_border(floor_at(0));
		for (const Real x : { Real(-3), Real(-1), Real(1), Real(3) }) {
			world.add_collider(box_collider({ x * BIN, -400 }, { 10, 420 }));
		}
		RigidBody paddle;
		paddle.pose.position = { 0, -60 };
		Collider blade = box_collider({ 0, 0 }, { 20, 8 });
		blade.rigid_body = world.add_rigid_body(paddle).value();
		world.add_collider(blade);
		for (int i = 0; i < 4; ++i) {
			SoftBodyData body = stress_ball({ -2 * BIN + Real(i < 2 ? -58 : 58), Real(-52 - 103 * (i % 2)) }, setup, { 1, 200 });
			sleepers.push_back(world.add_soft_body(std::move(body)));
			world.add_soft_body(stress_ball({ Real(i % 2 == 0 ? -60 : 60), Real(-160 - 103 * (i / 2)) }, setup, { 1, 300 }));
		}
		const std::vector<Vec2> square = box_collider({ 0, 0 }, { JELLY_RADIUS, JELLY_RADIUS }).vertices;
		for (const bool is_round : { false, true }) {
			SoftBodyData body = stress_body(is_round ? circle_hull(JELLY_RADIUS, JELLY_HULL_POINTS).value() : square,
					{ (is_round ? -4 : -5) * BIN, -52 }, setup, { 1, 200 });
			BodySettings settings = body.settings();
			settings.can_sleep = false;
			body.set_settings(settings);
			awake.push_back(world.add_soft_body(std::move(body)));
		}
		guest = world.add_soft_body(stress_ball({ 2 * BIN, -300 }, setup));
	}

	void drive(double time, int tick) {
		RigidBody paddle = world.rigid_bodies()[0];
		paddle.linear_velocity = { std::fmod(time, 2) < 1 ? Real(80) : Real(-80), 0 };
		paddle.pose.position.y = -60;
		world.set_rigid_body(0, paddle);
		if (tick % 300 == 299) { // and whoever was there is gone
			world.remove_soft_body(guest);
			guest = world.add_soft_body(stress_ball({ 2 * BIN, -300 }, setup));
		}
	}

	std::size_t lost() const {
		std::size_t count = 0;
		for (const SoftBodyData &body : world.soft_bodies()) {
			const Vec2 center = measure_frame(body).center;
			count += !(std::abs(center.x) < 6 * BIN && center.y < 0 && center.y > -2000) || !all_finite(body.positions());
		}
		return count;
	}
};

} // namespace

SoakResult soak(double seconds, const std::function<std::size_t()> &allocated) {
	Soak scene;
	Simulator simulator(scene.world);
	SoakResult result;
	std::vector<BodyId> resting = scene.awake;
	resting.insert(resting.end(), scene.sleepers.begin(), scene.sleepers.end());
	std::vector<std::vector<Vec2>> settled;
	std::size_t memory = 0;
	const int ticks = int(seconds * 60);
	for (int tick = 0; tick < ticks; ++tick) {
		scene.drive(tick / 60.0, tick);
		result.resets += simulator.simulate(FRAME).reset_bodies.size();
		if (tick % 60 == 0) {
			result.lost += scene.lost();
		}
		if (tick == int(SETTLED * 60)) {
			for (const BodyId id : resting) {
				settled.push_back(copy_of(scene.world.find(id)->positions()));
			}
			memory = allocated();
		}
	}
	for (std::size_t i = 0; i < settled.size(); ++i) {
		double &drift = i == 0 ? result.drift : i < scene.awake.size() ? result.round_drift : result.sleeping_drift;
		drift = std::max(drift, largest_distance(scene.world.find(resting[i])->positions(), settled[i]));
	}
	result.growth = std::ptrdiff_t(allocated()) - std::ptrdiff_t(memory);
	result.hours = seconds / 3600;
	return result;
}

} // namespace softbody::testing
