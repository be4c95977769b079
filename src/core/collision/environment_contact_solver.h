// SPDX-License-Identifier: MIT
// Finds and solves the contacts of bodies with their surroundings.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/collider_contact.h"
#include "core/collision/contact_log.h"
#include "core/collision/one_way.h"
#include "core/collision/surface_constraint.h"
#include "core/collision/collider_index.h"
#include "core/geometry/polygon.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Contacts of soft bodies with borders and colliders (thesis 4.4.2, "EnvironmentContactSolver"). Broad phase once a
/// step: colliders whose box meets the box a body may sweep. Narrow phase in every substep: each hull point against
/// each border and collider, and each corner (or round end) of a collider against the hull edges,
/// so that neither can enter the other. A kinematic collider is met where it is at the end of each substep, and its
/// velocity is felt; dynamic ones are left to `RigidContacts`. One object serves one thread.
class EnvironmentContactSolver {
public:
	/// Broad phase for one body and the coming `dt` [s], which begins `elapsed` [s] after the step did. False where no
	/// collider is near. Of bodies side by side each is begun in a lane of its own, < PACK_WIDTH. O(colliders near the body).
	bool begin_body(const ColliderIndex &surroundings, SoftBodyData &body, Real elapsed, Real dt, std::size_t lane = 0);
	/// Answers every contact of the body begun in that lane after a substep of `h` [s] that started at `before` (one
	/// position a hull point), under the acceleration `gravity`, and resists rolling. Returns how many it
	/// solved.
	/// O(hull points × colliders nearby).
	std::size_t handle(SoftBodyData &body, std::span<const Vec2> before, Vec2 gravity, Real h, std::size_t lane = 0);
	/// Contacts of bodies side by side with borders alone: the same as `handle` where nothing bounces and no collider is
	/// near. `body_indices` are the bodies' in the world; a bit of `monitored` tells whose contacts are logged. Returns how
	/// many it solved in each lane.
	RealPack solve_borders_side_by_side(const BodyLanes<RealPack> &bodies, std::span<const Border> borders, Real h,
			std::span<const std::uint32_t> body_indices, std::uint32_t monitored);
	/// The contacts solved of bodies of the world that are monitored, since it was last cleared.
	ContactLog &log() { return log_; }

private:
	Real solve(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface, std::uint32_t feature);
	std::uint32_t index_of(const SoftBodyData &body) const;
	void gather(const SoftBodyData &body, Real margin);
	void handle_borders(SoftBodyData &body);
	void handle_colliders(SoftBodyData &body, std::span<const Vec2> before);
	void handle_collider(SoftBodyData &body, std::span<const Vec2> before, const Aabb &swept, std::uint32_t index,
			bool corners);
	void solve_collider(SoftBodyData &body, const HullMotion &hull, const Collider &collider, const Surface &surface,
			const ColliderMotion &motion, const Aabb &box, bool corners);
	Real handle_points(SoftBodyData &body, const HullMotion &hull, const Collider &collider, const Surface &surface,
			const ColliderMotion &motion, const Aabb &own_bounds, const OneWay *one_way);
	Real handle_corners(SoftBodyData &body, const HullMotion &hull, const Collider &collider, const Surface &surface,
			const ColliderMotion &motion, const Aabb &box, const OneWay *one_way);
	void begin_one_ways(SoftBodyData &body, std::span<const Vec2> before, const Aabb &swept);
	bool is_beside_passed(const SoftBodyData &body, const Collider &collider) const;
	void forget_one_ways(SoftBodyData &body) const;

	const ColliderIndex *surroundings_ = nullptr;
	/// What is near a body.
	struct Near {
		std::vector<std::uint32_t> colliders; ///< that it may meet
		Aabb reach; ///< box for which they are complete
		Real margin = 0;
		Real elapsed = 0; ///< since the step began, at the start of the coming substep [s]
		bool has_one_way = false; ///< among the colliders
	};
	Near &near() { return near_[lane_]; }
	const Near &near() const { return near_[lane_]; }

	std::array<Near, PACK_WIDTH> near_;
	std::size_t lane_ = 0; ///< of the current body
	// Of the current body and substep.
	Real bounce_threshold_ = 0;
	Real h_ = 0;
	ContactLoad load_;
	std::uint32_t collider_ = 0; ///< which is being solved
	ContactLog log_;
	std::vector<Vec2> own_hull_; ///< in the frame of a one-way collider
	std::vector<Vec2> starts_; ///< of the hull's points, as a one-way collider sees them
	std::vector<BasicPointSolution<Real>> solutions_; ///< of a border at the hull's points
	std::vector<BasicPointSolution<RealPack>> pack_solutions_;
};

/// The box in which a body that moves as fast as now stays for `dt` [s], and some more. Of a hull that is not finite, one that
/// holds NaN and overlaps nothing.
Aabb sweep_box(std::span<const Vec2> hull, std::span<const Vec2> velocities, Real dt);

/// How deep a body is inside its surroundings where they are now [length]: the largest depth of a hull point in a border
/// or collider that it notices, or of a collider's corner or round end in the hull. 0 when apart.
/// O(hull points × colliders).
Real measure_penetration(const WorldData &world, const SoftBodyData &body);

} // namespace softbody
