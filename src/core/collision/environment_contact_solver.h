// SPDX-License-Identifier: MIT
// Finds and solves the contacts of bodies with the environment.
#pragma once

#include "core/base/constants.h"
#include "core/base/vec2.h"
#include "core/collision/collider_contact.h"
#include "core/collision/contact_log.h"
#include "core/collision/one_way.h"
#include "core/collision/surface_constraint.h"
#include "core/collision/collider_index.h"
#include "core/geometry/circle.h"
#include "core/geometry/polygon.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Contacts of soft bodies with borders and colliders (thesis 4.4.2, "CollisionHandling"). The broad phase runs once a
/// step: it finds the colliders whose box meets the box that a body may sweep. The narrow phase runs in every substep:
/// each hull point against each border and collider, and each corner or round end of a collider against the hull edges,
/// so that neither can enter the other. A kinematic collider is placed where it is at the end of each substep, and
/// contacts use its velocity. Dynamic colliders belong to `RigidContacts`. One object serves one thread.
class EnvironmentContactSolver {
public:
	/// Broad phase for one body and the coming `dt` [s], which begins `elapsed` [s] after the start of the step.
	/// Returns false if no collider is near. Each body of a batch is begun in its own `lane`, < WIDE_WIDTH. O(colliders
	/// near the body).
	bool begin_body(const ColliderIndex &surroundings, SoftBodyData &body, Real elapsed, Real dt, std::size_t lane = 0);
	/// Solves every contact of the body begun in `lane`, after a substep of `h` [s] that started at `before` (one
	/// position for each hull point) under the acceleration `gravity`, and applies rolling resistance. The motion of the
	/// substep holds the share `implicit_share` of its change of velocity (SubstepPlan), 1/2..1; friction takes back no
	/// more. Returns the number of contacts solved. O(hull points × colliders nearby).
	std::size_t handle(SoftBodyData &body, std::span<const Vec2> before, Vec2 gravity, Real h, std::size_t lane = 0,
			Real implicit_share = 1);
	/// Contacts of monitored bodies since the log was last cleared.
	ContactLog &log() { return log_; }

private:
	/// What touches: points or round edges of the hull, or corners of the collider.
	enum class Part { POINTS, ROUND_EDGES, CORNERS };

	Real solve(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface, std::uint32_t feature);
	std::uint32_t index_of(const SoftBodyData &body) const;
	Real slop() const { return LINEAR_SLOP * surroundings_->world().length_unit(); }
	ColliderMotion motion_of(const Collider &collider) const;
	void gather(const SoftBodyData &body, Real margin);
	void handle_borders(SoftBodyData &body);
	void handle_colliders(SoftBodyData &body, std::span<const Vec2> before);
	void handle_collider(SoftBodyData &body, std::span<const Vec2> before, const Aabb &swept, std::uint32_t index,
			Part part);
	void solve_collider(SoftBodyData &body, const HullMotion &hull, const Collider &collider, const Surface &surface,
			const ColliderMotion &motion, const Aabb &box, Part part);
	void begin_one_ways(SoftBodyData &body, std::span<const Vec2> before, const Aabb &swept);
	bool is_beside_passed(const SoftBodyData &body, const Collider &collider) const;
	void forget_one_ways(SoftBodyData &body) const;

	const ColliderIndex *surroundings_ = nullptr;
	/// Result of the broad phase for one body.
	struct Near {
		std::vector<std::uint32_t> colliders; ///< colliders that the body may meet
		Aabb reach; ///< box for which `colliders` is complete
		Real margin = 0;
		Real elapsed = 0; ///< time since the step began, at the start of the coming substep [s]
		bool has_one_way = false; ///< whether `colliders` holds a one-way collider
		bool is_placed = false; ///< whether the coming substep is the first since the body was placed (SoftBodyData::is_placed)
	};
	Near &near() { return near_[lane_]; }
	const Near &near() const { return near_[lane_]; }

	std::array<Near, WIDE_WIDTH> near_;
	std::size_t lane_ = 0; ///< of the current body
	// Values of the current body and substep.
	Real bounce_threshold_ = 0;
	Real h_ = 0;
	Real slide_time_ = 0; ///< in which a point has gone the way of its velocity in this substep [s]
	ContactLoad load_;
	int pressing_links_ = 0; ///< segments of chains that have pressed points in this pass
	std::uint32_t collider_ = 0; ///< collider being solved
	ContactLog log_;
	std::vector<Vec2> own_hull_; ///< hull in the frame of a one-way collider
	std::vector<Vec2> starts_from_middle_; ///< of the hull points of a placed body; else empty
	std::vector<Vec2> starts_; ///< start positions of the hull points, as adjusted for a one-way collider
	std::vector<BasicPointSolution<Real>> solutions_; ///< of a border, at the hull points
};

/// Box that contains the hull for `dt` [s] at its present velocities, with a margin. For a hull that is not finite, a
/// box that overlaps nothing.
Aabb sweep_box(std::span<const Vec2> hull, std::span<const Vec2> velocities, Real dt);

/// The highest of some speeds [length/s]; 0 without any. O(velocities).
Real fastest(std::span<const Vec2> velocities);

/// Circle that contains the hull for `dt` [s] while no point is faster than `pace` [length/s], with a margin, about the
/// mean of its points. For a hull that is not finite, one that overlaps nothing.
Circle sweep_circle(std::span<const Vec2> hull, Real pace, Real dt);

/// Depth of a body inside the environment at its present pose [length]: the largest depth of a hull point in a border
/// or collider that the body notices, or of a collider's corner or round end in the hull. 0 when apart. O(hull points ×
/// colliders).
Real measure_penetration(const WorldData &world, const SoftBodyData &body);

} // namespace softbody
