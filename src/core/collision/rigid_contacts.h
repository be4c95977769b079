// SPDX-License-Identifier: MIT
// Contacts of soft bodies with rigid bodies that they push back.
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

/// Moves the rigid bodies of the surroundings through a step, and solves the contacts of soft bodies with the dynamic
/// ones. These couple bodies that are stepped on different threads, so they are solved between substeps: contacts are
/// found for all bodies at once, in parallel, and then solved together, one after the other in the order of the
/// bodies, so that every contact feels what the ones before it did to the rigid body. Answering all of them from the
/// same velocity instead would push a light crate on fifty points fifty times too hard, or need the crate divided into
/// fifty parts (mass splitting), which takes more passes.
///
/// Impulses are equal and opposite in one place: linear momentum stays. The hull alone moves out of an overlap, since
/// where a rigid body is belongs to the engine that owns it.
class RigidContacts {
public:
	/// Forgets the last step's bodies and reactions. Both must outlive the step.
	void begin_step(WorldData &world, const ColliderIndex &surroundings);
	/// A soft body that may meet a dynamic collider in this step.
	void add_body(SoftBodyData &body);
	bool has_bodies() const { return !bodies_.empty(); }

	/// Moves the dynamic bodies that do not sleep by `h` [s], then gives them their acceleration; the contacts of the substep come
	/// last. In this order a body at rest does not sink by what it gains between two contacts.
	void begin_substep(Real h);
	/// Answers every contact of the substep. Returns how many. O(points of the bodies added × colliders near).
	std::uint64_t solve(const ParallelFor &parallel_for);
	/// The contacts solved with bodies that are monitored, since it was last cleared.
	ContactLog &log() { return log_; }
	/// Moves the kinematic bodies to the end of a step of `dt` [s].
	void end_step(Real dt);

private:
	/// Tasks among which bodies are divided; independent of the number of threads.
	static constexpr std::size_t TASKS = 16;

	struct NearBody {
		SoftBodyData *body = nullptr;
		std::size_t first_before = 0; ///< of its hull points in `before_`
	};
	/// Ready to be solved, and what it has got so far.
	struct Contact {
		SoftBodyData *body = nullptr;
		SurfaceContact at;
		std::uint32_t rigid_body = 0;
		std::uint32_t collider = 0;
		std::uint32_t feature = 0; ///< see ContactPoint
		Vec2 place; ///< where it was found
		Vec2 belt; ///< velocity of the collider's surface beyond that of its body [length/s]
		Vec2 arm; ///< from the rigid body's center of mass
		Vec2 held; ///< the direction in which the rigid body is held, times the root of the share that is taken
		Real inverse_inertia = 0; ///< of the rigid body, as held
		Real friction = 0;
		Real restitution = 0;
		PointOnEdge edge; ///< where it is on the soft body
		Real normal_response = 0; ///< change of relative velocity per impulse
		Real tangent_response = 0;
		Real wanted = 0; ///< normal relative velocity [length/s]
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
	std::array<Task, TASKS> tasks_;
	std::vector<Contact> contacts_;
	ContactLog log_;
	Real h_ = 0;
	Real bounce_threshold_ = 0;
};

} // namespace softbody
