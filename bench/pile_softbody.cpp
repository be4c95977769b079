// SPDX-License-Identifier: MIT
// The pile in our own simulator.
#include "pile_scene.h"

#include "bodies.h"

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/dynamics/simulator.h"
#include "thesis/damping_ratio.h"
#include "scenes/integrator_facts.h"

#include <cmath>
#include <stdexcept>

namespace bench {

namespace {

using softbody::Real;
using softbody::Vec2;

double stiffness(const PileScene &scene, const SoftBodySettings &settings) {
	return settings.load_factor * scene.load() / scene.radius;
}

softbody::Border border(Vec2 position, Vec2 normal) {
	softbody::Border result;
	result.plane = { position, normal };
	return result;
}

class SoftBodyPile : public PileEngine {
public:
	SoftBodyPile(const PileScene &scene, const SoftBodySettings &asked) :
			simulator_(world_), time_step_(Real(scene.time_step)) {
		world_.set_gravity({ 0, -Real(scene.gravity) });
		world_.set_sleeping(false); // so that every counted body is simulated
		world_.add_border(border({ 0, 0 }, { 0, 1 }));
		world_.add_border(border({ 0, 0 }, { 1, 0 }));
		world_.add_border(border({ Real(scene.width), 0 }, { -1, 0 }));
		const double k = stiffness(scene, asked);
		const Shape shape = circle_shape(scene.hull_points, true, k, softbody::DEFAULT_DAMPING_RATIO);
		softbody::BodySettings settings;
		settings.integrator = asked.integrator;
		settings.substeps = asked.substeps;
		if (const softbody::Status refused = world_.set_contact_substeps(asked.contact_substeps)) {
			throw std::runtime_error(refused->message());
		}
		settings.friction = Real(scene.friction);
		set_shape_matching(settings, *shape, softbody::DEFAULT_SHAPE_MATCHING * k);
		for (const PileScene::Place &place : scene.bodies) {
			const softbody::Pose pose{ place.center, softbody::Rotation::from_angle(Real(place.angle)) };
			world_.add_soft_body(take(softbody::SoftBodyData::create(shape, settings, pose)));
		}
	}

	void step() override { simulator_.simulate(time_step_); }

	std::vector<Hull> hulls() const override {
		std::vector<Hull> hulls;
		for (const softbody::SoftBodyData &body : world_.soft_bodies()) {
			const auto points = body.positions();
			hulls.emplace_back(points.begin(), points.begin() + std::ptrdiff_t(body.shape().hull_count()));
		}
		return hulls;
	}

private:
	softbody::WorldData world_;
	softbody::Simulator simulator_;
	Real time_step_;
};

} // namespace

std::vector<SoftBodySettings> softbody_settings() {
	// With k >= 8 to 10 load / R the lowest body loses no more than a tenth of its area. Half of that still leaves the
	// bodies rounder than those of the others are, and carries the pile in two substeps.
	return { { "automatic" }, { "fast", 4, softbody::Integrator::SEMI_IMPLICIT_EULER, 2, 1 } };
}

std::unique_ptr<PileEngine> make_softbody_pile(const PileScene &scene, const SoftBodySettings &settings) {
	return std::make_unique<SoftBodyPile>(scene, settings);
}

std::string softbody_pile_settings(const PileScene &scene, const SoftBodySettings &settings) {
	const bool is_automatic = settings.integrator == softbody::Integrator::AUTOMATIC;
	return settings.name + ": k " + softbody::number_text(stiffness(scene, settings)) + " N/m, shape matching 0.4 k, " +
			(is_automatic ? "automatic method and substeps" : std::string(softbody::integrator_facts(settings.integrator).name) +
									" with " + std::to_string(settings.substeps) + " substeps");
}

} // namespace bench
