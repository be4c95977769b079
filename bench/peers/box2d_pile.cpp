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
			scene_(scene),
			settings_(settings),
			scale_(float(settings.scale)),
			ring_(particle_ring(scene)),
			hull_points_(std::size_t(scene.hull_points)) {
		world_.SetAllowSleeping(false);
		world_.SetContinuousPhysics(settings.continuous);
		add_environment();
		for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
			starts_.push_back(particles_.size());
			if (scene.bodies[i].is_rigid) {
				add_disk(scene.bodies[i]);
			} else {
				add_body(scene.bodies[i], i);
			}
		}
	}

	void step() override {
		world_.Step(float(scene_.time_step), settings_.iterations, settings_.position_iterations);
	}

	std::vector<Hull> hulls() const override {
		std::vector<Hull> hulls;
		for (std::size_t i = 0; i < starts_.size(); ++i) {
			if (scene_.bodies[i].is_rigid) {
				hulls.push_back(disk_outline(scene_, position(starts_[i])));
				continue;
			}
			std::vector<Vec2> centers;
			for (std::size_t k = 0; k < hull_points_; ++k) {
				centers.push_back(position(starts_[i] + k));
			}
			hulls.push_back(ring_.outline(centers));
		}
		return hulls;
	}

private:
	Vec2 position(std::size_t particle) const {
		const b2Vec2 p = particles_[particle]->GetPosition();
		return { Real(p.x / scale_), Real(p.y / scale_) };
	}

	void add_environment() {
		const b2BodyDef definition;
		b2Body *ground = world_.CreateBody(&definition);
		const float width = float(scene_.width) * scale_;
		const float height = 100 * scale_;
		for (const auto &[from, to] : { std::pair<b2Vec2, b2Vec2>{ { 0, 0 }, { width, 0 } }, { { 0, 0 }, { 0, height } },
					 { { width, 0 }, { width, height } } }) {
			b2EdgeShape edge;
			edge.SetTwoSided(from, to);
			b2FixtureDef fixture;
			fixture.shape = &edge;
			fixture.friction = float(scene_.friction); // mixed with a body's as the root of the product
			fixture.restitution = float(scene_.restitution); // the larger of the two counts
			ground->CreateFixture(&fixture);
		}
	}

	b2Body *add_circle(b2Vec2 position, double radius, double mass, bool turns, int16 group) {
		b2BodyDef definition;
		definition.type = b2_dynamicBody;
		definition.position = scale_ * position;
		definition.fixedRotation = !turns;
		b2Body *body = world_.CreateBody(&definition);
		if (radius > 0) {
			b2CircleShape circle;
			circle.m_radius = float(radius) * scale_;
			b2FixtureDef fixture;
			fixture.shape = &circle;
			fixture.friction = float(scene_.friction);
			fixture.restitution = float(scene_.restitution);
			fixture.filter.groupIndex = group;
			body->CreateFixture(&fixture);
		}
		const float size = float(radius) * scale_;
		const b2MassData mass_data{ float(mass), { 0, 0 }, turns ? float(mass) * size * size / 2 : 0 };
		body->SetMassData(&mass_data);
		return body;
	}

	b2Body *add_particle(b2Vec2 position, bool of_hull, std::size_t owner) {
		const bool has_center = settings_.body == RingBody::CENTER;
		const double mass = scene_.mass / (scene_.hull_points + (has_center ? 1 : 0));
		// Free to turn they would be the balls of a bearing, and friction nothing. Those of one body never collide.
		return add_circle(position, of_hull ? ring_.particle_radius : 0, mass, false, -int16(owner + 1));
	}

	void add_disk(const PileScene::Place &place) {
		const b2Vec2 center{ float(place.center.x), float(place.center.y) };
		particles_.push_back(add_circle(center, scene_.radius, scene_.mass, true, 0));
	}

	void join(b2Body *a, b2Body *b, double firmness) {
		b2DistanceJointDef joint;
		joint.Initialize(a, b, a->GetPosition(), b->GetPosition());
		b2LinearStiffness(joint.stiffness, joint.damping, FREQUENCY * std::sqrt(float(firmness)), DAMPING_RATIO, a, b);
		joint.minLength = 0; // Initialize makes it a rod
		joint.maxLength = b2_maxFloat;
		world_.CreateJoint(&joint);
	}

	void add_body(const PileScene::Place &place, std::size_t index) {
		const b2Vec2 center{ float(place.center.x), float(place.center.y) };
		const std::size_t first = particles_.size();
		for (std::size_t k = 0; k < hull_points_; ++k) {
			const double angle = place.angle + 2 * std::numbers::pi * double(k) / double(hull_points_);
			const b2Vec2 arm{ float(ring_.ring_radius * std::cos(angle)), float(ring_.ring_radius * std::sin(angle)) };
			particles_.push_back(add_particle(center + arm, true, index));
		}
		b2Body *middle = settings_.body == RingBody::CENTER ? add_particle(center, false, index) : nullptr;
		for (std::size_t k = 0; k < hull_points_; ++k) {
			join(particles_[first + k], particles_[first + (k + 1) % hull_points_], place.firmness);
			if (middle != nullptr) {
				join(particles_[first + k], middle, place.firmness);
			} else if (k < hull_points_ / 2) {
				join(particles_[first + k], particles_[first + k + hull_points_ / 2], place.firmness);
			}
		}
	}

	b2World world_;
	PileScene scene_;
	PeerSettings settings_;
	float scale_;
	ParticleRing ring_;
	std::size_t hull_points_;
	std::vector<b2Body *> particles_; // of the hulls, body by body; disks
	std::vector<std::size_t> starts_; // of each body among them
};

// Of the library as it says itself. 2.4.1 still says 2.4.0.
std::string version() {
	return std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
			std::to_string(b2_version.revision);
}

std::vector<PeerSettings> settings() {
	PeerSettings fast;
	fast.name = "6/1 iterations, 2 units a meter, not continuous";
	fast.iterations = 6;
	fast.position_iterations = 1;
	fast.scale = 2;
	fast.continuous = false;
	return with_both_bodies(fast);
}

std::unique_ptr<PileEngine> make(const PileScene &scene, const PeerSettings &settings, int) {
	return std::make_unique<Box2DPile>(scene, settings);
}

} // namespace

} // namespace bench

const bench::Peer &bench_peer() {
	static const bench::Peer peer{ "Box2D", bench::version(), bench::settings(), false, bench::make };
	return peer;
}
