// SPDX-License-Identifier: MIT
// Contacts of soft bodies with dynamic rigid bodies.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/collider_index.h"
#include "core/collision/contact_log.h"
#include "core/collision/rigid_contact_search.h"
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
	/// Adds a soft body that may meet a dynamic collider in this step. The list of its surroundings, if it has one, must outlive the step.
	void add_body(SoftBodyData &body, const RigidSurroundings &surroundings = {}) { search_.add_body(body, surroundings); }
	bool has_bodies() const { return search_.body_count() > 0; }

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
	/// A contact ready to be solved, with its impulses so far: what every pass reads.
	struct Contact {
		Vec2 *velocity_a = nullptr; ///< of the ends of the edge of the soft body
		Vec2 *velocity_b = nullptr;
		std::uint32_t rigid_body = 0;
		Real share_a = 1; ///< as in PointOnEdge
		Real share_b = 0;
		Real inverse_mass_a = 0;
		Real inverse_mass_b = 0;
		Vec2 normal; ///< unit, from the rigid body into the soft one
		Vec2 arm; ///< from the rigid body's center of mass
		Vec2 belt; ///< velocity of the collider's surface relative to its body [length/s]
		Vec2 held; ///< direction of the rigid body's support, times the root of the share a
		Real inverse_mass = 0; ///< of the rigid body
		Real inverse_inertia = 0; ///< of the rigid body, with its support
		Real friction = 0;
		Real wanted = 0; ///< target normal relative velocity [length/s]
		Real normal_mass = 0; ///< impulse per change of the relative velocity; 0 if neither side can move
		Real tangent_mass = 0;
		Real coupling = 0; ///< change of the sliding speed per normal impulse
		Real normal_impulse = 0;
		Real tangent_impulse = 0;
	};
	/// What moves a place out of an overlap, after the passes.
	struct Place {
		RigidTouch touch;
		PointOnEdge edge;
		Vec2 found; ///< where the place was when the contact was found
	};
	struct Task {
		std::vector<Contact> contacts;
		std::vector<Place> places; ///< of each contact
	};

	void add_contact(const RigidTouch &touch, Task &task) const;
	void push(Contact &contact);
	bool apply(Contact &contact, Vec2 impulse);
	void finish(const Contact &contact, const Place &place);
	Vec2 relative_velocity(const Contact &contact) const;
	static Vec2 inverse_mass_along(const Contact &contact, Vec2 impulse);
	void note(const Contact &contact, const Place &place);

	WorldData *world_ = nullptr;
	RigidContactSearch search_;
	std::array<Task, MOST_SLICES> tasks_;
	ContactLog log_;
	Real h_ = 0;
	Real pull_ = 0; ///< the greatest acceleration of any body here [length/s²]
};

} // namespace softbody
