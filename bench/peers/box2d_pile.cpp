// SPDX-License-Identifier: MIT
// The pile in Box2D 2.4: circles that do not rotate, joined by soft distance joints.
//
// What was tried, on 1000 bodies for 400 to 600 steps:
// - Springs of 20 Hz and half critical damping: in the pile the bodies keep 0.96 of their area. At 15 Hz a tenth of them
//   fold, at 10 Hz the pile lies flat; 25 and 30 Hz hold as well at the same cost, and the time step allows no more than
//   30. Less damping makes no difference to quality or cost.
// - Iterations: 8/3 are the manual's. The fastest that hold the pile are 5/1 for 1000 bodies and 6/1 for 5000, of which
//   5/1 leave one folded or a few inside each other; with 2/1 dozens are.
// - Continuous collision costs a twentieth and is not needed here: nothing is fast.
// - Its margins are made for bodies of 0.1 to 10 m; that around a moving circle is as wide as the circle. At 2 units a
//   meter fewer pairs are looked at, a tenth is saved; at 4 and 10 the pile gets worse.
// - Joints with a least and a greatest length, particles of one body that collide: dearer, not better.
// - The Debian package is built with assertions; a build of the same version without was as fast to 1 %.
#include "peers.h"

#include <box2d/box2d.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace bench {

namespace {

using softbody::Real;
using softbody::Vec2;

constexpr float FREQUENCY = 20; // of the springs [Hz]
constexpr float DAMPING_RATIO = 0.5f;

class Box2DPile : public PileEngine {
public:
	Box2DPile(const PileScene &scene, const PeerSettings &settings) :
			world_({ 0, -float(scene.gravity * settings.scale) }),
			settings_(settings),
			scale_(float(settings.scale)),
			ring_(particle_ring(scene)),
			time_step_(float(scene.time_step)),
			hull_points_(std::size_t(scene.hull_points)) {
		world_.SetAllowSleeping(false);
		world_.SetContinuousPhysics(settings.continuous);
		add_environment(scene);
		for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
			add_body(scene, scene.bodies[i], i);
		}
	}

	void step() override {
		world_.Step(time_step_, settings_.iterations, settings_.position_iterations);
	}

	std::vector<Hull> hulls() const override {
		std::vector<Hull> hulls;
		for (std::size_t i = 0; i < particles_.size(); i += hull_points_) {
			std::vector<Vec2> centers;
			for (std::size_t k = 0; k < hull_points_; ++k) {
				const b2Vec2 p = particles_[i + k]->GetPosition();
				centers.push_back({ Real(p.x / scale_), Real(p.y / scale_) });
			}
			hulls.push_back(ring_.outline(centers));
		}
		return hulls;
	}

private:
	void add_environment(const PileScene &scene) {
		const b2BodyDef definition;
		b2Body *ground = world_.CreateBody(&definition);
		const float width = float(scene.width) * scale_;
		const float height = 100 * scale_;
		for (const auto &[from, to] : { std::pair<b2Vec2, b2Vec2>{ { 0, 0 }, { width, 0 } }, { { 0, 0 }, { 0, height } },
					 { { width, 0 }, { width, height } } }) {
			b2EdgeShape edge;
			edge.SetTwoSided(from, to);
			b2FixtureDef fixture;
			fixture.shape = &edge;
			fixture.friction = float(scene.friction); // mixed with a body's as the root of the product
			ground->CreateFixture(&fixture);
		}
	}

	b2Body *add_particle(const PileScene &scene, b2Vec2 position, bool of_hull, std::size_t owner) {
		b2BodyDef definition;
		definition.type = b2_dynamicBody;
		definition.position = scale_ * position;
		definition.fixedRotation = true; // free to turn they would be the balls of a bearing, and friction nothing
		b2Body *particle = world_.CreateBody(&definition);
		const float mass = float(scene.mass) / float(scene.hull_points + 1);
		if (of_hull) {
			b2CircleShape circle;
			circle.m_radius = float(ring_.particle_radius) * scale_;
			b2FixtureDef fixture;
			fixture.shape = &circle;
			fixture.friction = float(scene.friction);
			fixture.filter.groupIndex = -int16(owner + 1); // those of one body never collide
			particle->CreateFixture(&fixture);
		}
		const b2MassData mass_data{ mass, { 0, 0 }, 0 };
		particle->SetMassData(&mass_data);
		return particle;
	}

	void join(b2Body *a, b2Body *b) {
		b2DistanceJointDef joint;
		joint.Initialize(a, b, a->GetPosition(), b->GetPosition());
		b2LinearStiffness(joint.stiffness, joint.damping, FREQUENCY, DAMPING_RATIO, a, b);
		joint.minLength = 0; // Initialize makes it a rod
		joint.maxLength = b2_maxFloat;
		world_.CreateJoint(&joint);
	}

	void add_body(const PileScene &scene, const PileScene::Place &place, std::size_t index) {
		const b2Vec2 center{ float(place.center.x), float(place.center.y) };
		const std::size_t first = particles_.size();
		for (std::size_t k = 0; k < hull_points_; ++k) {
			const double angle = place.angle + 2 * std::numbers::pi * double(k) / double(hull_points_);
			const b2Vec2 arm{ float(ring_.ring_radius * std::cos(angle)), float(ring_.ring_radius * std::sin(angle)) };
			particles_.push_back(add_particle(scene, center + arm, true, index));
		}
		b2Body *middle = add_particle(scene, center, false, index);
		for (std::size_t k = 0; k < hull_points_; ++k) {
			join(particles_[first + k], particles_[first + (k + 1) % hull_points_]);
			join(particles_[first + k], middle);
		}
	}

	b2World world_;
	PeerSettings settings_;
	float scale_;
	ParticleRing ring_;
	float time_step_;
	std::size_t hull_points_;
	std::vector<b2Body *> particles_; // of the hulls, body by body
};

} // namespace

// Of the library as it says itself. 2.4.1 still says 2.4.0.
std::string box2d_version() {
	return std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
			std::to_string(b2_version.revision);
}

std::vector<PeerSettings> box2d_settings() {
	PeerSettings recommended;
	recommended.name = "recommended: 8/3 iterations";
	recommended.iterations = 8;
	recommended.position_iterations = 3;
	PeerSettings fast;
	fast.name = "fast: 6/1 iterations, 2 units a meter, not continuous";
	fast.iterations = 6;
	fast.position_iterations = 1;
	fast.scale = 2;
	fast.continuous = false;
	PeerSettings faster = fast;
	faster.name = "faster: 5/1 iterations, 2 units a meter, not continuous";
	faster.iterations = 5;
	return { recommended, fast, faster };
}

std::unique_ptr<PileEngine> make_box2d_pile(const PileScene &scene, const PeerSettings &settings) {
	return std::make_unique<Box2DPile>(scene, settings);
}

} // namespace bench
