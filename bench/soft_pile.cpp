// SPDX-License-Identifier: MIT
// A pile of thesis bodies in our own simulator.
#include "soft_pile.h"

#include "bodies.h"
#include "task_clock.h"

#include "core/dynamics/substep_plan.h"
#include "thesis/separation_force.h"
#include "thesis/damping_ratio.h"
#include "scenes/circle.h"
#include "scenes/integrator_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace bench {

namespace {

using softbody::Border;
using softbody::Real;
using softbody::Vec2;

Border border(double x, double y, Vec2 normal) {
	Border result;
	result.plane = { { Real(x), Real(y) }, normal };
	return result;
}

Shape body_shape(const PileScene &scene, const SoftPileSettings &settings, double mass) {
	softbody::StructureOptions options;
	options.mass = Real(mass);
	options.stiffness = Real(settings.stiffness);
	options.damping = Real(settings.damping);
	return take(softbody::testing::circle_shape(Real(scene.radius), scene.hull_points, options));
}

} // namespace

SoftPileSettings default_settings(double stiffness) {
	constexpr double POINT_MASS = 1.0 / 9;
	SoftPileSettings settings;
	settings.stiffness = stiffness;
	settings.damping = softbody::DEFAULT_DAMPING_RATIO * std::sqrt(stiffness * POINT_MASS);
	settings.shape_stiffness = softbody::DEFAULT_SHAPE_MATCHING * stiffness;
	settings.shape_damping = 2 * 0.25 * std::sqrt(settings.shape_stiffness * POINT_MASS);
	return settings;
}

SoftPileSettings explicit_euler_settings(double stiffness, double h) {
	SoftPileSettings settings = default_settings(stiffness);
	settings.integrator = softbody::Integrator::EXPLICIT_EULER;
	settings.substeps = settings.contact_substeps; // one force substep in each, and as many for bodies without contacts
	settings.damping = 2 * h * stiffness;
	settings.shape_damping = 2 * h * settings.shape_stiffness;
	return settings;
}

double carrying_stiffness(const PileScene &scene, double mean_mass) {
	return 10 * scene.load() * mean_mass / scene.radius;
}

PileScene centered(PileScene scene) {
	const double shift = -scene.width / 2 - scene.left;
	scene.left += shift;
	for (PileScene::Place &place : scene.bodies) {
		place.center.x = Real(double(place.center.x) + shift);
	}
	return scene;
}

Stopwatch::Stopwatch() : wall_(std::chrono::steady_clock::now()), cpu_(thread_seconds()) {}

Duration Stopwatch::elapsed() const {
	const double cpu = thread_seconds() - cpu_;
	return { std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(), cpu };
}

Statistics statistics_of(std::vector<double> values) {
	Statistics statistics;
	std::sort(values.begin(), values.end());
	statistics.median = values[values.size() / 2];
	statistics.least = values.front();
	statistics.worst = values.back();
	for (const double value : values) {
		statistics.mean += value / double(values.size());
	}
	return statistics;
}

StepTimes times_of(std::span<const Duration> steps) {
	std::vector<double> wall;
	std::vector<double> cpu;
	for (const Duration &step : steps) {
		wall.push_back(step.wall);
		cpu.push_back(step.cpu);
	}
	return { statistics_of(std::move(wall)), statistics_of(std::move(cpu)) };
}

SoftPile::SoftPile(PileScene scene, const SoftPileSettings &settings, softbody::ParallelFor parallel_for) :
		scene_(std::move(scene)), simulator_(world_, std::move(parallel_for), thread_seconds) {
	world_.set_gravity({ 0, -Real(scene_.gravity) });
	check(world_.set_contact_substeps(settings.contact_substeps));
	world_.set_sleeping(settings.may_sleep);
	world_.add_border(border(0, 0, { 0, 1 }));
	if (scene_.has_walls) {
		world_.add_border(border(scene_.left, 0, { 1, 0 }));
		world_.add_border(border(scene_.left + scene_.width, 0, { -1, 0 }));
	}
	softbody::BodySettings body;
	body.integrator = settings.integrator;
	body.substeps = settings.substeps;
	body.friction = Real(scene_.friction);
	body.rolling_resistance = Real(settings.rolling_resistance);
	body.shape_stiffness = Real(settings.shape_stiffness);
	body.shape_damping = Real(settings.shape_damping);
	body.collision_layer = settings.bodies_collide && !settings.has_separation_force ? 1 : 0;
	std::map<double, Shape> shapes; // of each mass
	for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
		double factor = i % 2 == 1 ? settings.heavy : 1;
		if (settings.top > 0 && i + 1 == scene_.bodies.size()) {
			factor = settings.top;
		}
		Shape &shape = shapes[factor];
		if (!shape) {
			shape = body_shape(scene_, settings, scene_.mass * factor);
		}
		const PileScene::Place &place = scene_.bodies[i];
		const softbody::Pose pose{ place.center, softbody::Rotation::from_angle(Real(place.angle)) };
		world_.add_soft_body(take(softbody::SoftBodyData::create(shape, body, pose)));
	}
	if (settings.has_separation_force) {
		separation_steps_ = contact_substeps();
		body.substeps = 1;
		for (softbody::SoftBodyData &each : world_.soft_bodies()) {
			if (each.set_settings(body)) {
				throw std::runtime_error("a single substep is refused");
			}
		}
	}
}

Duration SoftPile::step() {
	const Stopwatch watch;
	for (int i = 0; i < std::max(separation_steps_, 1); ++i) {
		if (separation_steps_ > 0) {
			take(softbody::add_separation_forces(world_));
		}
		report_ = simulator_.simulate(Real(scene_.time_step / std::max(separation_steps_, 1)));
		resets_ += report_.reset_bodies.size();
	}
	return watch.elapsed();
}

StepTimes SoftPile::run(int steps) {
	std::vector<Duration> times;
	for (int i = 0; i < steps; ++i) {
		times.push_back(step());
	}
	return times_of(times);
}

PileQuality SoftPile::quality() const {
	std::vector<Hull> hulls;
	for (const softbody::SoftBodyData &body : world_.soft_bodies()) {
		hulls.emplace_back(body.hull().begin(), body.hull().end());
	}
	return judge_pile(scene_, hulls);
}

double SoftPile::kinetic_energy() const {
	double sum = 0;
	for (const softbody::SoftBodyData &body : world_.soft_bodies()) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			sum += 0.5 * double(length_squared(body.velocities()[i])) / double(body.inverse_masses()[i]);
		}
	}
	return sum / double(size());
}

double SoftPile::share_slower(double speed) const {
	std::size_t slower = 0;
	for (const softbody::SoftBodyData &body : world_.soft_bodies()) {
		Vec2 sum; // all points of a body weigh the same
		for (const Vec2 v : body.velocities()) {
			sum += v;
		}
		slower += double(length(sum)) < speed * double(body.point_count()) ? 1 : 0;
	}
	return double(slower) / double(size());
}

int SoftPile::contact_substeps() const {
	int substeps = world_.contact_substeps();
	for (const softbody::SoftBodyData &body : world_.soft_bodies()) {
		const int own = simulator_.plan(body, Real(scene_.time_step)).substeps;
		substeps = std::max(substeps, std::min(own, softbody::MAX_CONTACT_SUBSTEPS));
	}
	return substeps;
}

nlohmann::json SoftPile::picture() const {
	nlohmann::json hulls = nlohmann::json::array();
	for (const softbody::SoftBodyData &body : world_.soft_bodies()) {
		nlohmann::json points = nlohmann::json::array();
		for (const Vec2 p : body.hull()) {
			points.push_back({ p.x, p.y });
		}
		hulls.push_back(points);
	}
	return hulls;
}

nlohmann::json to_json(const PileQuality &quality) {
	return { { "folded", quality.folded }, { "overlapping", quality.overlapping }, { "escaped", quality.escaped },
		{ "mean_penetration", quality.mean_penetration }, { "worst_penetration", quality.worst_penetration },
		{ "mean_area", quality.mean_area }, { "height", quality.height } };
}

nlohmann::json to_json(const SoftPileSettings &settings) {
	return { { "integrator", softbody::integrator_facts(settings.integrator).name }, { "substeps", settings.substeps },
		{ "contact_substeps", settings.contact_substeps }, { "k", settings.stiffness }, { "c", settings.damping },
		{ "shape_k", settings.shape_stiffness }, { "shape_c", settings.shape_damping } };
}

} // namespace bench
