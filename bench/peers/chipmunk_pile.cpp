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
constexpr double DAMPING = 8; // [N s/m]
constexpr double SLOP = 0.005; // [m], that of Box2D: the default of 0.1 is meant for pixels

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
			ring_(particle_ring(scene)),
			time_step_(scene.time_step),
			hull_points_(std::size_t(scene.hull_points)) {
		cpSpaceSetGravity(space_, cpv(0, -scene.gravity));
		cpSpaceSetIterations(space_, settings.iterations);
		cpSpaceSetCollisionSlop(space_, SLOP);
		if (settings.spatial_hash) {
			// As its manual advises: cells a little larger than the shapes, ten times as many as there are shapes.
			cpSpaceUseSpatialHash(space_, 2.2 * ring_.particle_radius, int(10 * scene.bodies.size() * hull_points_));
		}
		add_environment(scene);
		for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
			add_body(scene, scene.bodies[i], i);
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

	void step() override { cpSpaceStep(space_, time_step_); }

	std::vector<Hull> hulls() const override {
		std::vector<Hull> hulls;
		for (std::size_t i = 0; i < particles_.size(); i += hull_points_) {
			std::vector<Vec2> centers;
			for (std::size_t k = 0; k < hull_points_; ++k) {
				const cpVect p = cpBodyGetPosition(particles_[i + k]);
				centers.push_back({ Real(p.x), Real(p.y) });
			}
			hulls.push_back(ring_.outline(centers));
		}
		return hulls;
	}

private:
	void add_environment(const PileScene &scene) {
		const double height = 100;
		// Thick, with their inner side on the line: it knows no continuous collision.
		const double thick = 1;
		const auto add = [&](cpVect from, cpVect to) {
			cpShape *wall = cpSegmentShapeNew(cpSpaceGetStaticBody(space_), from, to, thick);
			cpShapeSetFriction(wall, std::sqrt(scene.friction)); // multiplied with a body's
			cpSpaceAddShape(space_, wall);
		};
		add(cpv(-thick, -thick), cpv(scene.width + thick, -thick));
		add(cpv(-thick, -thick), cpv(-thick, height));
		add(cpv(scene.width + thick, -thick), cpv(scene.width + thick, height));
	}

	cpBody *add_particle(const PileScene &scene, cpVect position) {
		const double mass = scene.mass / (scene.hull_points + 1);
		// Free to turn they would be the balls of a bearing, and friction nothing.
		cpBody *particle = cpSpaceAddBody(space_, cpBodyNew(mass, INFINITY));
		cpBodySetPosition(particle, position);
		return particle;
	}

	void join(cpBody *a, cpBody *b) {
		const double length = cpvdist(cpBodyGetPosition(a), cpBodyGetPosition(b));
		cpConstraint *spring = cpDampedSpringNew(a, b, cpvzero, cpvzero, length, STIFFNESS, DAMPING);
		cpConstraintSetCollideBodies(spring, cpFalse);
		cpSpaceAddConstraint(space_, spring);
	}

	void add_body(const PileScene &scene, const PileScene::Place &place, std::size_t index) {
		const cpVect center = cpv(place.center.x, place.center.y);
		const std::size_t first = particles_.size();
		for (std::size_t k = 0; k < hull_points_; ++k) {
			const double angle = place.angle + 2 * std::numbers::pi * double(k) / double(hull_points_);
			cpBody *particle = add_particle(scene, cpvadd(center, cpvmult(cpvforangle(angle), ring_.ring_radius)));
			particles_.push_back(particle);
			cpShape *circle = cpSpaceAddShape(space_, cpCircleShapeNew(particle, ring_.particle_radius, cpvzero));
			// Chipmunk multiplies frictions; this gives the scene's.
			cpShapeSetFriction(circle, std::sqrt(scene.friction));
			// Those of one body never collide.
			cpShapeSetFilter(circle, cpShapeFilterNew(index + 1, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
		}
		cpBody *middle = add_particle(scene, center);
		middles_.push_back(middle);
		for (std::size_t k = 0; k < hull_points_; ++k) {
			join(particles_[first + k], particles_[first + (k + 1) % hull_points_]);
			join(particles_[first + k], middle);
		}
	}

	cpSpace *space_;
	ParticleRing ring_;
	double time_step_;
	std::size_t hull_points_;
	std::vector<cpBody *> particles_; // of the hulls, body by body
	std::vector<cpBody *> middles_;
};

} // namespace

std::string chipmunk_version() {
	return cpVersionString;
}

std::vector<PeerSettings> chipmunk_settings() {
	PeerSettings recommended;
	recommended.name = "recommended: 10 iterations";
	recommended.iterations = 10;
	PeerSettings fast = recommended;
	fast.name = "fast: 10 iterations, spatial hash";
	fast.spatial_hash = true;
	PeerSettings faster = fast;
	faster.name = "faster: 7 iterations, spatial hash";
	faster.iterations = 7;
	return { recommended, fast, faster };
}

std::unique_ptr<PileEngine> make_chipmunk_pile(const PileScene &scene, const PeerSettings &settings) {
	return std::make_unique<ChipmunkPile>(scene, settings);
}

} // namespace bench
