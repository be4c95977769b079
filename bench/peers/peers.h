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

/// How an engine is asked to hold the pile. What no engine offers is left alone.
struct PeerSettings {
	std::string name; ///< of this choice, for the table
	int iterations = 0; ///< Chipmunk: of the solver. Box2D: velocity iterations
	int position_iterations = 0; ///< Box2D
	double scale = 1; ///< Box2D: units of its world in a meter
	bool continuous = true; ///< Box2D: continuous collision with what is fixed
	bool spatial_hash = false; ///< Chipmunk: in place of its tree
};

std::string box2d_version();
/// As its manual recommends, and the fastest that were found to hold the pile of 5000 and of 1000 bodies.
std::vector<PeerSettings> box2d_settings();
std::unique_ptr<PileEngine> make_box2d_pile(const PileScene &scene, const PeerSettings &settings);

std::string chipmunk_version();
std::vector<PeerSettings> chipmunk_settings();
std::unique_ptr<PileEngine> make_chipmunk_pile(const PileScene &scene, const PeerSettings &settings);

} // namespace bench
