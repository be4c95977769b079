// SPDX-License-Identifier: MIT
// The pile in our own simulator.
#include "pile_scene.h"

#include "bodies.h"
#include "thread_pool.h"

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/dynamics/simulator.h"
#include "thesis/damping_ratio.h"
#include "scenes/integrator_facts.h"

#include <cmath>
#include <utility>

namespace bench {

namespace {

using softbody::Real;
using softbody::Vec2;

double stiffness(const PileScene &scene, const SoftBodySettings &settings) {
	return settings.load_factor * scene.load() / scene.radius;
}

// Where a body of the scene is in our world.
struct Handle {
	bool is_rigid = false;
	std::uint32_t index = 0; // of the rigid body
	softbody::BodyId id = {}; // of the soft body
};

class SoftBodyPile : public PileEngine {
public:
	SoftBodyPile(const PileScene &scene, const SoftBodySettings &asked, int threads) :
			scene_(scene),
			pool_(std::size_t(threads - 1)),
			simulator_(world_, threads > 1 ? pool_.parallel_for() : softbody::ParallelFor{}),
			stiffness_(stiffness(scene, asked)) {
		world_.set_gravity({ 0, -Real(scene.gravity) });
		world_.set_sleeping(false); // so that every counted body is simulated
		check(world_.set_contact_substeps(asked.contact_substeps));
		// Restitutions of two sides add up.
		const Real own_restitution = Real(scene.restitution / 2);
		for (const auto &[position, normal] : { std::pair<Vec2, Vec2>{ { 0, 0 }, { 0, 1 } }, { { 0, 0 }, { 1, 0 } },
					 { { Real(scene.width), 0 }, { -1, 0 } } }) {
			softbody::Border border;
			border.plane = { position, normal };
			border.surface.restitution = own_restitution;
			check(world_.add_border(border));
		}
		settings_.integrator = asked.integrator;
		settings_.substeps = asked.substeps;
		settings_.friction = Real(scene.friction);
		settings_.restitution = own_restitution;
		for (const PileScene::Place &place : scene.bodies) {
			handles_.push_back(place.is_rigid ? add_rigid(place) : add_soft(place));
		}
	}

	void step() override { simulator_.simulate(Real(scene_.time_step)); }

	std::vector<Hull> hulls() const override {
		std::vector<Hull> hulls;
		for (const Handle &handle : handles_) {
			if (handle.is_rigid) {
				hulls.push_back(disk_outline(scene_, world_.rigid_bodies()[handle.index].center()));
			} else {
				const auto points = world_.find(handle.id)->hull();
				hulls.emplace_back(points.begin(), points.end());
			}
		}
		return hulls;
	}

private:
	// Bodies share their shape, as nodes of one outline and mass do, whatever their stiffness.
	Handle add_soft(const PileScene::Place &place) {
		if (!shape_) {
			shape_ = circle_shape(scene_.hull_points, true, stiffness_, softbody::DEFAULT_DAMPING_RATIO);
		}
		softbody::BodySettings settings = settings_;
		settings.spring_stiffness_scale = Real(place.firmness);
		settings.spring_damping_scale = Real(std::sqrt(place.firmness)); // of one damping ratio
		set_shape_matching(settings, *shape_, softbody::DEFAULT_SHAPE_MATCHING * stiffness_ * place.firmness);
		const softbody::Pose pose{ place.center, softbody::Rotation::from_angle(Real(place.angle)) };
		return { false, 0, world_.add_soft_body(take(softbody::SoftBodyData::create(shape_, settings, pose))) };
	}

	Handle add_rigid(const PileScene::Place &place) {
		softbody::RigidBody body;
		body.pose.position = place.center;
		body.acceleration = world_.gravity();
		body.inverse_mass = Real(1 / scene_.mass);
		body.inverse_inertia = Real(2 / (scene_.mass * scene_.radius * scene_.radius));
		const std::uint32_t index = take(world_.add_rigid_body(body));
		softbody::Collider disk;
		disk.vertices = { {} };
		disk.radius = Real(scene_.radius);
		disk.surface.friction = Real(scene_.friction);
		disk.surface.restitution = settings_.restitution;
		disk.rigid_body = index;
		check(world_.add_collider(disk));
		return { true, index };
	}

	PileScene scene_;
	softbody::WorldData world_;
	ThreadPool pool_;
	softbody::Simulator simulator_;
	softbody::BodySettings settings_;
	double stiffness_;
	Shape shape_;
	std::vector<Handle> handles_;
};

} // namespace

std::vector<SoftBodySettings> softbody_settings() {
	// With k >= 8 to 10 load / R the lowest body loses no more than a tenth of its area. Half of that still leaves the
	// bodies rounder than those of the others are, and carries the pile in two substeps.
	return { { "automatic" }, { "tuned", 4, softbody::Integrator::SEMI_IMPLICIT_EULER, 2, 1 } };
}

std::unique_ptr<PileEngine> make_softbody_pile(const PileScene &scene, const SoftBodySettings &settings, int threads) {
	return std::make_unique<SoftBodyPile>(scene, settings, threads);
}

std::string softbody_pile_settings(const PileScene &scene, const SoftBodySettings &settings) {
	const bool is_automatic = settings.integrator == softbody::Integrator::AUTOMATIC;
	return settings.name + ": k " + softbody::number_text(stiffness(scene, settings)) + " N/m, shape matching 0.4 k, " +
			(is_automatic ? "automatic method and substeps" : std::string(softbody::integrator_facts(settings.integrator).name) +
									" with " + std::to_string(settings.substeps) + " substeps");
}

} // namespace bench
