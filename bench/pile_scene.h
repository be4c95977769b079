// SPDX-License-Identifier: MIT
// A pile of thesis bodies that any engine can be asked to hold, and how well and how fast it does.
#pragma once

#include "core/base/constants.h"
#include "core/base/vec2.h"
#include "core/model/body_settings.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace bench {

/// Bodies over a ground at y = 0 between upright walls at x = `left` and `left + width`, y up; all in meters, kilogrammes
/// and seconds. They start apart, in `rows` rows that fall a little, every second row shifted by half a body, each body
/// turned by an angle of its own and a little out of its place, as nothing that is perfectly straight tells much.
struct PileScene {
	struct Place {
		softbody::Vec2 center;
		double angle = 0;
		double firmness = 1; ///< stiffness over that of the pile
		bool is_rigid = false; ///< a disk of the same radius and mass instead, which has no angle to see
	};

	double radius = 0.5; // of a body, its hull points are that far from its center
	int hull_points = 8; // and a center point; hull springs join neighbors, centre springs all with the center
	double mass = 1; // of a body, a ninth on every point
	double gravity = 9.81; // downwards
	double friction = 0.4;
	double restitution = 0; ///< of every contact
	double time_step = 1.0 / 60;
	int rows = 10;
	double left = 0;
	double width = 0;
	bool has_walls = true;
	std::vector<Place> bodies;

	/// Load that the lowest body of a column carries [N].
	double load() const { return rows * mass * gravity; }
};

/// The scene with that many bodies, alike for every engine and on every machine.
PileScene pile_scene(std::size_t bodies, int rows = 10);

using Hull = std::vector<softbody::Vec2>;

/// The outline of a rigid disk of the scene, as fine as the judge needs it.
Hull disk_outline(const PileScene &scene, softbody::Vec2 center);

/// Something that holds such a pile. Its construction is not timed.
class PileEngine {
public:
	virtual ~PileEngine() = default;
	/// One time step of the scene.
	virtual void step() = 0;
	/// Of every body, in the scene's order, the outline by which it touches others, of positive winding.
	virtual std::vector<Hull> hulls() const = 0;
};

/// State of a pile, by the outlines alone.
struct PileQuality {
	std::size_t folded = 0; ///< bodies turned over, flat, or whose outline meets itself
	std::size_t overlapping = 0; ///< pairs deeper in each other than 5 % of R
	std::size_t escaped = 0; ///< bodies whose center is behind the ground or a wall, or not finite
	double mean_penetration = 0; ///< over bodies, of the deepest each is in another, the ground or a wall; over R
	double worst_penetration = 0; ///< of any body, over R
	double mean_area = 0; ///< of soft bodies, over that of the regular outline of R
	double height = 0; ///< of the highest point [m]
};
PileQuality judge_pile(const PileScene &scene, const std::vector<Hull> &hulls);

/// Times of one engine's steps, over the number of bodies [ns], and what became of the pile.
struct PileRun {
	double median = 0; ///< over the second half of the steps, in which the pile has come to rest
	double low = 0; ///< a tenth of the same steps were faster
	double high = 0; ///< a tenth of the same steps were slower
	double mean = 0; ///< over the same
	double median_whole = 0;
	double mean_whole = 0;
	double worst = 0; ///< the dearest step of all
	PileQuality quality; ///< at the end
	std::vector<Hull> hulls; ///< at the end
};

/// What times are taken of. Processor time, of all threads together, leaves out what else the machine does.
enum class PileClock { PROCESSOR, WALL };

/// Steps all engines for that many steps, some steps of each in turn, so that whatever disturbs the machine disturbs
/// them alike.
std::vector<PileRun> run_piles(const PileScene &scene, const std::vector<PileEngine *> &engines, int steps,
		PileClock clock = PileClock::PROCESSOR);

/// How our own simulator is asked to hold the pile.
struct SoftBodySettings {
	std::string name; ///< of this choice, for the table
	double load_factor = 10; ///< stiffness times R over the load on the lowest body
	softbody::Integrator integrator = softbody::Integrator::AUTOMATIC;
	int substeps = 0; ///< 0: automatic
	int contact_substeps = softbody::MIN_CONTACT_SUBSTEPS; ///< at least
};
/// As the node would by itself, and the fastest that holds the pile as well as the fastest of the others.
std::vector<SoftBodySettings> softbody_settings();

/// The pile in our own simulator.
std::unique_ptr<PileEngine> make_softbody_pile(const PileScene &scene, const SoftBodySettings &settings, int threads = 1);
/// How our bodies are made for it, in words.
std::string softbody_pile_settings(const PileScene &scene, const SoftBodySettings &settings);

} // namespace bench
