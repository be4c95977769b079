// SPDX-License-Identifier: MIT
// The pile in Box2D 3: circles that do not rotate, joined by soft distance joints.
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

b2Vec2 as_b2(Vec2 p) {
	return { float(p.x), float(p.y) };
}

class Box2DV3Pile : public PileEngine {
public:
	Box2DV3Pile(const PileScene &scene, const PeerSettings &settings, int threads) :
			scene_(scene), settings_(settings), ring_(particle_ring(scene)), hull_points_(std::size_t(scene.hull_points)) {
		b2WorldDef definition = b2DefaultWorldDef();
		definition.gravity = { 0, -float(scene.gravity) };
		definition.enableSleep = false;
		definition.enableContinuous = false; // nothing is fast
		definition.workerCount = threads;
		world_ = b2CreateWorld(&definition);
		add_environment();
		for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
			starts_.push_back(particles_.size());
			if (scene.bodies[i].is_rigid) {
				particles_.push_back(add_circle(scene.bodies[i].center, scene.radius, scene.mass, true, 0));
			} else {
				add_body(scene.bodies[i], -int(i + 1));
			}
		}
	}

	~Box2DV3Pile() override { b2DestroyWorld(world_); }
	Box2DV3Pile(const Box2DV3Pile &) = delete;
	Box2DV3Pile &operator=(const Box2DV3Pile &) = delete;

	void step() override { b2World_Step(world_, float(scene_.time_step), settings_.iterations); }

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
		const b2Vec2 p = b2Body_GetPosition(particles_[particle]);
		return { Real(p.x), Real(p.y) };
	}

	b2ShapeDef shape_definition() const {
		b2ShapeDef definition = b2DefaultShapeDef();
		definition.material.friction = float(scene_.friction); // mixed as the root of the product
		definition.material.restitution = float(scene_.restitution); // the larger of the two counts
		definition.updateBodyMass = false;
		return definition;
	}

	void add_environment() {
		const b2BodyDef body = b2DefaultBodyDef();
		const b2BodyId ground = b2CreateBody(world_, &body);
		const b2ShapeDef definition = shape_definition();
		const float width = float(scene_.width);
		const float height = 100;
		for (const auto &[from, to] : { std::pair<b2Vec2, b2Vec2>{ { 0, 0 }, { width, 0 } }, { { 0, 0 }, { 0, height } },
					 { { width, 0 }, { width, height } } }) {
			const b2Segment segment{ from, to };
			b2CreateSegmentShape(ground, &definition, &segment);
		}
	}

	b2BodyId add_circle(Vec2 center, double radius, double mass, bool turns, int group) {
		b2BodyDef definition = b2DefaultBodyDef();
		definition.type = b2_dynamicBody;
		definition.position = as_b2(center);
		definition.motionLocks.angularZ = !turns;
		const b2BodyId body = b2CreateBody(world_, &definition);
		if (radius > 0) {
			b2ShapeDef shape = shape_definition();
			shape.filter.groupIndex = group;
			const b2Circle circle{ { 0, 0 }, float(radius) };
			b2CreateCircleShape(body, &shape, &circle);
		}
		b2MassData mass_data{};
		mass_data.mass = float(mass);
		mass_data.rotationalInertia = turns ? float(mass * radius * radius / 2) : 0;
		b2Body_SetMassData(body, mass_data);
		return body;
	}

	void join(b2BodyId a, b2BodyId b, double firmness) {
		b2DistanceJointDef joint = b2DefaultDistanceJointDef();
		joint.base.bodyIdA = a;
		joint.base.bodyIdB = b;
		joint.length = b2Distance(b2Body_GetPosition(a), b2Body_GetPosition(b));
		joint.enableSpring = true;
		joint.hertz = FREQUENCY * std::sqrt(float(firmness));
		joint.dampingRatio = DAMPING_RATIO;
		b2CreateDistanceJoint(world_, &joint);
	}

	// Particles of one body, which is of a negative group, never collide.
	void add_body(const PileScene::Place &place, int group) {
		const bool has_center = settings_.body == RingBody::CENTER;
		const double mass = scene_.mass / (scene_.hull_points + (has_center ? 1 : 0));
		const std::size_t first = particles_.size();
		for (std::size_t k = 0; k < hull_points_; ++k) {
			const double angle = place.angle + 2 * std::numbers::pi * double(k) / double(hull_points_);
			const Vec2 arm{ Real(ring_.ring_radius * std::cos(angle)), Real(ring_.ring_radius * std::sin(angle)) };
			// Free to turn they would be the balls of a bearing, and friction nothing.
			particles_.push_back(add_circle(place.center + arm, ring_.particle_radius, mass, false, group));
		}
		const b2BodyId middle = has_center ? add_circle(place.center, 0, mass, false, group) : b2_nullBodyId;
		for (std::size_t k = 0; k < hull_points_; ++k) {
			join(particles_[first + k], particles_[first + (k + 1) % hull_points_], place.firmness);
			if (has_center) {
				join(particles_[first + k], middle, place.firmness);
			} else if (k < hull_points_ / 2) {
				join(particles_[first + k], particles_[first + k + hull_points_ / 2], place.firmness);
			}
		}
	}

	PileScene scene_;
	PeerSettings settings_;
	ParticleRing ring_;
	std::size_t hull_points_;
	b2WorldId world_ = {};
	std::vector<b2BodyId> particles_; // of the hulls, body by body; disks
	std::vector<std::size_t> starts_; // of each body among them
};

std::string version() {
	const b2Version version = b2GetVersion();
	return std::to_string(version.major) + "." + std::to_string(version.minor) + "." + std::to_string(version.revision);
}

std::vector<PeerSettings> settings() {
	PeerSettings recommended;
	recommended.name = "4 substeps";
	recommended.iterations = 4;
	return with_both_bodies(recommended);
}

std::unique_ptr<PileEngine> make(const PileScene &scene, const PeerSettings &settings, int threads) {
	return std::make_unique<Box2DV3Pile>(scene, settings, threads);
}

} // namespace

} // namespace bench

const bench::Peer &bench_peer() {
	static const bench::Peer peer{ "Box2D 3", bench::version(), bench::settings(), true, bench::make };
	return peer;
}
