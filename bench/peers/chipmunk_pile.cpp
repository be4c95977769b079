// SPDX-License-Identifier: MIT
// The pile in Chipmunk 7: circles that do not rotate, joined by damped springs.
//
// What was tried, on 1000 bodies for 400 to 600 steps:
// - Springs of 1000 N/m and 8 N s/m: in the pile the bodies keep 0.96 of their area. Of 400 N/m a sixth of them fold, of
//   600 a hundredth. They are explicit, so there is a limit: with 15 N s/m the pile explodes.
// - Two steps of 1/120 s with stiffer springs, or slide joints of 0.9 to 1.1 of the length around softer springs: hold as
//   well, but are a third dearer.
// - Iterations: 10 are its default. 7 hold 1000 bodies, but leave a few pairs of 5000 inside each other, as 8 do.
// - The spatial hash in place of the tree saves a tenth; its manual recommends it for many shapes of like size.
// - Particles of one body that collide: not better here.
// - The Debian package is built with assertions; a build of the same version without was 6 to 10 % faster.
#include "peers.h"

#include <chipmunk/chipmunk.h>

#include <cmath>
#include <numbers>

namespace bench {

namespace {

using softbody::Real;
using softbody::Vec2;

constexpr double STIFFNESS = 1000; // of the springs [N/m]
constexpr cpFloat DAMPING = 8; // [N s/m]
constexpr cpFloat SLOP = 0.005; // [m], that of Box2D: the default of 0.1 is meant for pixels

// Frees what the space holds; the callbacks of its iterators want plain functions.
void free_shape(cpShape *shape, void *) {
	cpShapeFree(shape);
}
void free_constraint(cpConstraint *constraint, void *) {
	cpConstraintFree(constraint);
}

class ChipmunkPile : public PileEngine {
public:
	ChipmunkPile(const PileScene &scene, const PeerSettings &settings) :
			space_(cpSpaceNew()),
			scene_(scene),
			settings_(settings),
			ring_(particle_ring(scene)),
			hull_points_(std::size_t(scene.hull_points)) {
		cpSpaceSetGravity(space_, cpv(0, cpFloat(-scene.gravity)));
		cpSpaceSetIterations(space_, settings.iterations);
		cpSpaceSetCollisionSlop(space_, SLOP);
		if (settings.spatial_hash) {
			// As its manual advises: cells a little larger than the shapes, ten times as many as there are shapes.
			cpSpaceUseSpatialHash(space_, cpFloat(2.2 * ring_.particle_radius), int(10 * scene.bodies.size() * hull_points_));
		}
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

	~ChipmunkPile() override {
		cpSpaceEachShape(space_, free_shape, nullptr);
		cpSpaceEachConstraint(space_, free_constraint, nullptr);
		cpSpaceFree(space_);
		for (cpBody *body : particles_) {
			cpBodyFree(body);
		}
		for (cpBody *body : middles_) {
			cpBodyFree(body);
		}
	}

	ChipmunkPile(const ChipmunkPile &) = delete;
	ChipmunkPile &operator=(const ChipmunkPile &) = delete;

	void step() override { cpSpaceStep(space_, cpFloat(scene_.time_step)); }

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
		const cpVect p = cpBodyGetPosition(particles_[particle]);
		return { Real(p.x), Real(p.y) };
	}

	// Chipmunk multiplies what both sides have; this gives the scene's.
	void set_surface(cpShape *shape) const {
		cpShapeSetFriction(shape, cpFloat(std::sqrt(scene_.friction)));
		cpShapeSetElasticity(shape, cpFloat(std::sqrt(scene_.restitution)));
	}

	void add_environment() {
		const cpFloat height = 100;
		const cpFloat width = cpFloat(scene_.width);
		// Thick, with their inner side on the line: it knows no continuous collision.
		const cpFloat thick = 1;
		const auto add = [&](cpVect from, cpVect to) {
			cpShape *wall = cpSegmentShapeNew(cpSpaceGetStaticBody(space_), from, to, thick);
			set_surface(wall);
			cpSpaceAddShape(space_, wall);
		};
		add(cpv(-thick, -thick), cpv(width + thick, -thick));
		add(cpv(-thick, -thick), cpv(-thick, height));
		add(cpv(width + thick, -thick), cpv(width + thick, height));
	}

	cpShape *add_circle(cpBody *body, double radius) {
		cpShape *circle = cpSpaceAddShape(space_, cpCircleShapeNew(body, cpFloat(radius), cpvzero));
		set_surface(circle);
		return circle;
	}

	cpBody *add_particle(cpVect position) {
		const bool has_center = settings_.body == RingBody::CENTER;
		const double mass = scene_.mass / (scene_.hull_points + (has_center ? 1 : 0));
		// Free to turn they would be the balls of a bearing, and friction nothing.
		cpBody *particle = cpSpaceAddBody(space_, cpBodyNew(cpFloat(mass), INFINITY));
		cpBodySetPosition(particle, position);
		return particle;
	}

	void add_disk(const PileScene::Place &place) {
		const double inertia = scene_.mass * scene_.radius * scene_.radius / 2;
		cpBody *disk = cpSpaceAddBody(space_, cpBodyNew(cpFloat(scene_.mass), cpFloat(inertia)));
		cpBodySetPosition(disk, cpv(place.center.x, place.center.y));
		particles_.push_back(disk);
		add_circle(disk, scene_.radius);
	}

	void join(cpBody *a, cpBody *b, double firmness) {
		const cpFloat length = cpvdist(cpBodyGetPosition(a), cpBodyGetPosition(b));
		cpConstraint *spring = cpDampedSpringNew(a, b, cpvzero, cpvzero, length, cpFloat(STIFFNESS * firmness), DAMPING);
		cpConstraintSetCollideBodies(spring, cpFalse);
		cpSpaceAddConstraint(space_, spring);
	}

	void add_body(const PileScene::Place &place, std::size_t index) {
		const cpVect center = cpv(place.center.x, place.center.y);
		const std::size_t first = particles_.size();
		for (std::size_t k = 0; k < hull_points_; ++k) {
			const auto angle = cpFloat(place.angle + 2 * std::numbers::pi * double(k) / double(hull_points_));
			cpBody *particle = add_particle(cpvadd(center, cpvmult(cpvforangle(angle), cpFloat(ring_.ring_radius))));
			particles_.push_back(particle);
			// Those of one body never collide.
			cpShapeSetFilter(add_circle(particle, ring_.particle_radius),
					cpShapeFilterNew(index + 1, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
		}
		cpBody *middle = nullptr;
		if (settings_.body == RingBody::CENTER) {
			middle = add_particle(center);
			middles_.push_back(middle);
		}
		for (std::size_t k = 0; k < hull_points_; ++k) {
			join(particles_[first + k], particles_[first + (k + 1) % hull_points_], place.firmness);
			if (middle != nullptr) {
				join(particles_[first + k], middle, place.firmness);
			} else if (k < hull_points_ / 2) {
				join(particles_[first + k], particles_[first + k + hull_points_ / 2], place.firmness);
			}
		}
	}

	cpSpace *space_;
	PileScene scene_;
	PeerSettings settings_;
	ParticleRing ring_;
	std::size_t hull_points_;
	std::vector<cpBody *> particles_; // of the hulls, body by body; disks
	std::vector<std::size_t> starts_; // of each body among them
	std::vector<cpBody *> middles_;
};

std::vector<PeerSettings> settings() {
	PeerSettings fast;
	fast.name = "10 iterations, spatial hash";
	fast.iterations = 10;
	fast.spatial_hash = true;
	return with_both_bodies(fast);
}

std::unique_ptr<PileEngine> make(const PileScene &scene, const PeerSettings &settings, int) {
	return std::make_unique<ChipmunkPile>(scene, settings);
}

} // namespace

} // namespace bench

const bench::Peer &bench_peer() {
	const char *engine = sizeof(cpFloat) == sizeof(float) ? "Chipmunk in floats" : "Chipmunk";
	static const bench::Peer peer{ engine, cpVersionString, bench::settings(), false, bench::make };
	return peer;
}
