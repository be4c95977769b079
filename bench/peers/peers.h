// SPDX-License-Identifier: MIT
// The same pile in other engines, with bodies made as their own samples make soft ones.
#pragma once

#include "../pile_scene.h"

#include <memory>
#include <string>
#include <vector>

namespace bench {

/// Where the particles lie that stand for the hull points of a body: circles in a ring, that touch their neighbors and
/// whose rims reach out to R. This is how soft bodies are commonly made in both engines. Smaller circles let those of
/// other bodies in between; larger ones were no faster. All particles weigh a ninth of the body, like our points.
struct ParticleRing {
	double particle_radius = 0;
	double ring_radius = 0; ///< of the particles' centers

	/// The outline by which a body touches others, from its particles' centers. In the polygon through the rims, a
	/// particle that lies in the dip between two of another body would count as 7 % of R deep in that body, although the
	/// engine keeps apart all that it is asked to. So each corner is moved in by half of that dip; then such a pair just
	/// touches. It is the lenient choice: particles that face each other rim to rim may be pressed in by the whole dip
	/// before that shows.
	Hull outline(const std::vector<softbody::Vec2> &centers) const;
};
ParticleRing particle_ring(const PileScene &scene);

/// Of what a peer's soft bodies are made besides the ring.
enum class RingBody {
	CENTER, ///< a particle in the middle, with springs to all of the ring
	CROSS, ///< springs between opposite particles of the ring
};

/// How an engine is asked to hold the pile. What no engine offers is left alone.
struct PeerSettings {
	std::string name; ///< of this choice, for the table
	RingBody body = RingBody::CENTER;
	int iterations = 0; ///< Chipmunk: of the solver. Box2D 2.4: velocity iterations. Box2D 3: substeps
	int position_iterations = 0; ///< Box2D 2.4
	double scale = 1; ///< Box2D 2.4: units of its world in a meter
	bool continuous = true; ///< Box2D 2.4: continuous collision with what is fixed
	bool spatial_hash = false; ///< Chipmunk: in place of its tree
};

/// The same settings for both bodies.
std::vector<PeerSettings> with_both_bodies(const PeerSettings &settings);

/// An engine. Each is a library of its own, as two builds of one engine do not fit into one program.
struct Peer {
	std::string engine; ///< with what tells its build from others
	std::string version;
	std::vector<PeerSettings> settings;
	bool has_threads = false; ///< whether a pile may ask for several
	std::unique_ptr<PileEngine> (*make)(const PileScene &scene, const PeerSettings &settings, int threads) = nullptr;
};

} // namespace bench

/// What each of the libraries shows.
extern "C" const bench::Peer &bench_peer();
