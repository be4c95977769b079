// SPDX-License-Identifier: MIT
// Contacts of soft bodies with dynamic rigid bodies.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/collider_contact.h"
#include "core/collision/contact_log.h"
#include "core/collision/collider_index.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Moves the rigid bodies through a step, and solves the contacts of soft bodies with the dynamic ones. These contacts
/// couple bodies that are stepped on different threads, so they are solved between substeps. Contacts are found for all
/// bodies in parallel, and then solved one after the other in the order of the bodies. Every contact thus sees the
/// effect of earlier contacts on the rigid body.
///
/// Impulses are equal and opposite in one place: linear momentum stays. Only the hull is moved out of an overlap, as
/// the pose of a rigid body belongs to its engine.
class RigidContacts {
public:
	/// Clears bodies and reactions of the last step. `world` and `surroundings` must outlive the step.
	void begin_step(WorldData &world, const ColliderIndex &surroundings);
	/// Adds a soft body that may meet a dynamic collider in this step.
	void add_body(SoftBodyData &body);
	bool has_bodies() const { return !bodies_.empty(); }

	/// Moves the dynamic bodies that are awake by `h` [s], then applies their acceleration; the contacts of the substep
	/// come last. In this order a body at rest does not sink by the speed that it gains between two contacts.
	void begin_substep(Real h);
	/// Solves every contact of the substep. Returns their number. O(points of the bodies added × colliders near).
	std::uint64_t solve(const ParallelFor &parallel_for);
	/// Contacts of monitored bodies since the log was last cleared.
	ContactLog &log() { return log_; }
	/// Moves the kinematic bodies to the end of a step of `dt` [s].
	void end_step(Real dt);

private:
	struct NearBody {
		SoftBodyData *body = nullptr;
		std::size_t first_before = 0; ///< first of the body's hull points in `before_`
	};
	/// A contact ready to be solved, with its impulses so far.
	struct Contact {
		SoftBodyData *body = nullptr;
		SurfaceContact at;
		std::uint32_t rigid_body = 0;
		std::uint32_t collider = 0;
		std::uint32_t feature = 0; ///< see ContactPoint
		Vec2 place; ///< where the contact was found
		Vec2 belt; ///< velocity of the collider's surface relative to its body [length/s]
		Vec2 arm; ///< from the rigid body's center of mass
		Vec2 held; ///< direction of the rigid body's support, times the root of the share a
		Real inverse_inertia = 0; ///< of the rigid body, with its support
		Real friction = 0;
		Real restitution = 0;
		PointOnEdge edge; ///< place on the soft body
		Real normal_response = 0; ///< change of relative velocity per impulse
		Real tangent_response = 0;
		Real wanted = 0; ///< target normal relative velocity [length/s]
		Real normal_impulse = 0;
		Real tangent_impulse = 0;
	};
	struct Task {
		std::vector<Contact> contacts;
		std::vector<std::uint32_t> colliders;
	};

	void find(const NearBody &near, Task &task) const;
	void prepare(Contact &contact);
	void move_out(Contact &contact);
	void push(Contact &contact);
	void apply(Contact &contact, Vec2 impulse);
	Vec2 relative_velocity(const Contact &contact) const;
	Vec2 inverse_mass_along(const Contact &contact, Vec2 impulse) const;
	void note(const Contact &contact);

	WorldData *world_ = nullptr;
	const ColliderIndex *surroundings_ = nullptr;
	std::vector<NearBody> bodies_;
	std::vector<Vec2> before_; ///< hull points at the start of the substep
	std::vector<Pose> from_; ///< of every rigid body, at the start of the substep
	std::array<Task, MOST_SLICES> tasks_;
	std::vector<Contact> contacts_;
	ContactLog log_;
	Real h_ = 0;
	Real bounce_threshold_ = 0;
};

} // namespace softbody
