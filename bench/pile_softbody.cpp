// SPDX-License-Identifier: MIT
// The pile in our own simulator.
#include "pile_scene.h"

#include "bodies.h"

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/dynamics/simulator.h"

#include <cmath>

namespace bench {

namespace {

using softbody::Real;
using softbody::Vec2;

// With k >= 8 to 10 load / R the lowest body loses no more than a tenth of its area.
double stiffness(const PileScene &scene) {
	return 10 * scene.load() / scene.radius;
}

softbody::Border border(Vec2 position, Vec2 normal) {
	softbody::Border result;
	result.plane = { position, normal };
	return result;
}

class SoftBodyPile : public PileEngine {
public:
	explicit SoftBodyPile(const PileScene &scene) :
			simulator_(world_), time_step_(Real(scene.time_step)) {
		world_.set_gravity({ 0, -Real(scene.gravity) });
		world_.set_sleeping(false); // so that every counted body is simulated
		world_.add_border(border({ 0, 0 }, { 0, 1 }));
		world_.add_border(border({ 0, 0 }, { 1, 0 }));
		world_.add_border(border({ Real(scene.width), 0 }, { -1, 0 }));
		const Shape shape = circle_shape(scene.hull_points, true, stiffness(scene), softbody::DEFAULT_DAMPING_RATIO);
		softbody::BodySettings settings;
		settings.friction = Real(scene.friction);
		set_shape_matching(settings, *shape, softbody::DEFAULT_SHAPE_MATCHING * stiffness(scene));
		for (const PileScene::Place &place : scene.bodies) {
			const softbody::Pose pose{ place.centre, softbody::Rotation::from_angle(Real(place.angle)) };
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

std::unique_ptr<PileEngine> make_softbody_pile(const PileScene &scene) {
	return std::make_unique<SoftBodyPile>(scene);
}

std::string softbody_pile_settings(const PileScene &scene) {
	return "k " + softbody::number_text(stiffness(scene)) + " N/m, shape matching 0.4 k, automatic method and substeps";
}

} // namespace bench
