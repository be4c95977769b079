// SPDX-License-Identifier: MIT
// A world as a new project has it, bodies as new nodes are, and what the scenes of the field are judged by.
#pragma once

#include "elastic_bodies.h"
#include "soft_pile.h"

#include "core/dynamics/simulator.h"
#include "core/model/joint.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace bench {

inline constexpr double FIELD_GRAVITY = 980; ///< px/s²

/// The default material, and one of so many times its Young's modulus.
struct Firmness {
	const char *name = "default";
	double times = 1;
};

/// What a scene may set of its nodes; a new node and project have these.
struct NodeValues {
	double friction = 0.4;
	double restitution = 0;
	double rolling_resistance = 0.03;
	double damping_ratio = double(softbody::Material{}.damping_ratio);
	double linear_damp = 0.1; ///< the project's [1/s]
	double angular_damp = 1; ///< the project's [1/s]
	bool can_sleep = true;
	softbody::Integrator integrator = softbody::Integrator::AUTOMATIC;
	int substeps = 0; ///< 0: automatic
	int least_substeps = 0; ///< of those, where stability needs fewer
};

class Stage {
public:
	explicit Stage(const Firmness &firmness, double gravity = FIELD_GRAVITY);

	/// Solid behind it, with that velocity of its surface.
	void add_wall(softbody::Vec2 at, softbody::Vec2 normal, softbody::Vec2 velocity = {});
	/// Solid below y = 0.
	void add_floor();
	/// Of bodies added from now on.
	NodeValues values;
	/// A new node of that outline [px], which lies about its own center.
	softbody::BodyId add(const Points &outline, softbody::Vec2 at, double mass = 1, double angle = 0);
	/// Two anchors are one place from now on.
	void join(const softbody::JointAnchor &first, const softbody::JointAnchor &second);
	/// Of a body, nearest to a place in the world.
	softbody::JointAnchor anchor(softbody::BodyId id, softbody::Vec2 place) const;

	/// One tick; samples penetration from time to time.
	void step();
	/// Ticks until `seconds` are over, all bodies sleep, or `is_over` says so after a tick.
	void run(double seconds, const std::function<bool()> &is_over = {});

	softbody::WorldData &world() { return world_; }
	const softbody::SoftBodyData &body(softbody::BodyId id) const { return *world_.find(id); }
	softbody::Vec2 center(softbody::BodyId id) const;
	double seconds() const { return ticks_ * TICK; }
	/// Processor time a body and step, while any is awake [µs].
	double us_per_body_step() const;
	/// Substeps in which bodies look for contacts, if all touch one another.
	int contact_substeps() const;
	bool all_asleep() const;
	/// The widest that a joint is open now, or ever was after a tick [px].
	double gap() const;
	double widest_gap() const { return widest_gap_; }
	/// The deepest that a body is in another or behind a border now; R is the width of the thinner, half of a square's side.
	/// Joined bodies do not count: they pass through each other.
	double penetration() const;
	double worst_penetration() const { return std::max(deepest_, penetration()); } ///< now, or ever when it was sampled
	/// Root mean square of the speeds of the centers [px/s].
	double speed() const;
	double kinetic_energy() const; ///< mean over bodies [J]
	/// Share of a body's area at rest, and the least of all bodies.
	double area(softbody::BodyId id) const;
	double least_area() const;

	/// What every row has: scene, material, size, cost, and the state at the end.
	nlohmann::json row(const char *scene) const;

private:
	softbody::WorldData world_;
	softbody::Simulator simulator_;
	Firmness firmness_;
	std::set<std::pair<std::size_t, std::size_t>> joined_;
	int ticks_ = 0;
	int awake_ticks_ = 0;
	double awake_time_ = 0; ///< processor time of these [s]
	double deepest_ = 0;
	double widest_gap_ = 0;
	nlohmann::json asleep_after_ = nullptr;
	std::size_t resets_ = 0;
};

/// Points as of a new node, on the sides of a rectangle about its center.
Points rectangle(double width, double height);

/// Moves an outline so that its center of area is at the origin; where it was.
softbody::Vec2 center_outline(Points &outline);

} // namespace bench
