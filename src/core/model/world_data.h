// SPDX-License-Identifier: MIT
// Everything a simulation contains: gravity, bodies, and their environment.
#pragma once

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/id_list.h"
#include "core/model/joint.h"
#include "core/model/rigid_body.h"
#include "core/model/soft_body_data.h"
#include "core/model/surroundings.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// The world of a simulation (thesis 4.4.2, "WorldData"). Bodies are stored densely and stepped in the order of
/// that storage; removing one moves the last into its place.
class WorldData {
public:
	/// Acceleration [length/s²], equal for every mass (thesis eq. 3.8 and 3.9).
	Vec2 gravity() const { return gravity_; }
	Status set_gravity(Vec2 gravity);
	/// World units in a meter [length/m], > 0: tolerances scale with it. Default 1.
	Real length_unit() const { return length_unit_; }
	Status set_length_unit(Real length_unit);

	/// Whether bodies fall asleep. Default true; false wakes all.
	bool has_sleeping() const { return sleeping_; }
	void set_sleeping(bool sleeping);

	/// Contact substeps of bodies that may touch one another in a step of USUAL_STEP, 1..MAX_SUBSTEPS; longer steps
	/// take more (`substeps_of_step`). More: less penetration and stiffer piles, at proportional cost. Default
	/// MIN_CONTACT_SUBSTEPS.
	int contact_substeps() const { return contact_substeps_; }
	Status set_contact_substeps(int contact_substeps);

	/// Whether bodies of elastic material that touch nothing and hardly wobble are moved as rigid ones, with three degrees of freedom
	/// (`FlightSlice`): cheaper, and without the last of their wobble. Default false.
	bool has_rigid_flight() const { return rigid_flight_; }
	void set_rigid_flight(bool flies) { rigid_flight_ = flies; }

	/// Wakes every sleeping body.
	void wake_all();

	/// Adds a body, awake.
	BodyId add_soft_body(SoftBodyData body);
	/// False when the id refers to nothing.
	bool remove_soft_body(BodyId id);
	/// Puts another body, awake, at the id and in the place of one, which may have other points. What rested on that one
	/// wakes; its joints are removed, its collision exceptions stay. False when the id refers to nothing.
	bool replace_soft_body(BodyId id, SoftBodyData body);
	/// Null when the id refers to nothing. Valid until a body is added or removed.
	SoftBodyData *find(BodyId id) { return bodies_.find(id); }
	const SoftBodyData *find(BodyId id) const { return bodies_.find(id); }
	std::span<SoftBodyData> soft_bodies() { return bodies_.items(); }
	std::span<const SoftBodyData> soft_bodies() const { return bodies_.items(); }
	/// Id of the body stored at `index` of `soft_bodies()`.
	BodyId id_at(std::size_t index) const { return bodies_.id_at(index); }

	/// Lets two soft bodies pass through each other, whatever their layers, from the next step on; wakes both.
	/// Forgotten when one of them is removed. Refuses ids that refer to nothing and a body with itself. O(exceptions).
	Status add_collision_exception(BodyId a, BodyId b);
	/// Lets two bodies collide again. False when there was no such exception.
	bool remove_collision_exception(BodyId a, BodyId b);
	bool has_collision_exception(BodyId a, BodyId b) const;
	/// All exceptions, in order; of each pair the lesser id comes first.
	struct CollisionException {
		BodyId a;
		BodyId b;
		friend auto operator<=>(const CollisionException &, const CollisionException &) = default;
	};
	std::span<const CollisionException> collision_exceptions() const { return collision_exceptions_; }

	/// Everything that the world remembers besides its bodies, and its environment, gravity and settings, which are the caller's.
	struct Memory {
		IdList<SoftBodyData>::Order bodies;
		std::vector<CollisionException> exceptions; ///< in order
		IdList<Joint>::Order joint_order;
		std::vector<Joint> joints;
		std::uint64_t put_to_sleep = 0; ///< ChangeCounts::put_to_sleep
		std::vector<WokenIsland> woken_islands; ///< that the next step takes note of
		std::vector<Aabb> disturbed_boxes; ///< that the next step takes note of
	};
	Memory memory() const;
	/// Refuses, by name, ids that the world has not, other bodies or another order of them, and what `add_joint` and
	/// `add_collision_exception` refuse.
	Status check_memory(const Memory &memory) const;
	/// Takes a memory over, after all bodies have got back their states (`SoftBodyData::put_back`): what has changed since then
	/// wakes no one. Bodies that are gone must stay gone, and coming ones get the ids that they got then. Precondition:
	/// `check_memory` accepts it.
	void put_back(Memory memory);

	/// Counts of bodies that came, went, or were changed.
	const ChangeCounts &change_counts() const { return *changes_; }
	/// For the step: islands with a body that was woken since the last call.
	std::vector<WokenIsland> take_woken_islands() { return std::exchange(changes_->woken_islands, {}); }
	/// For the step: boxes in which frozen bodies were moved, came or went since the last call.
	std::vector<Aabb> take_disturbed_boxes() { return std::exchange(changes_->disturbed_boxes, {}); }

	/// Joins two anchors; the joined soft bodies wake. Refuses joints that `check_joint` refuses, missing bodies,
	/// points out of range, and edges that do not begin at a hull point. Removing a body removes its joints.
	Result<JointId> add_joint(const Joint &joint);
	/// Changes a joint, for example its length or place in the world. Refuses an id that refers to nothing, and joints
	/// that `add_joint` refuses.
	Status set_joint(JointId id, const Joint &joint);
	/// False when the id refers to nothing.
	bool remove_joint(JointId id);
	/// Null when the id refers to nothing. Valid until a joint is added or removed.
	const Joint *find_joint(JointId id) { return joints_.find(id); }
	std::span<const Joint> joints() const { return joints_.items(); }
	/// Id of the joint stored at `index` of `joints()`.
	JointId joint_id_at(std::size_t index) const { return joints_.id_at(index); }

	const std::vector<Border> &borders() const { return borders_; }
	const std::vector<Collider> &colliders() const { return colliders_; }
	/// Whether there are borders or colliders.
	bool has_environment() const { return !borders_.empty() || !colliders_.empty(); }
	Status add_border(const Border &border);
	/// Refuses colliders that `check_collider` refuses, and a missing rigid body.
	Status add_collider(Collider collider);

	/// Rigid bodies that own colliders. A step moves them: after it they are where its end found them, with the
	/// velocities that contacts left them.
	std::span<const RigidBody> rigid_bodies() const { return rigid_bodies_; }
	/// Returns its index, by which colliders refer to it; indices hold until the environment is cleared.
	Result<std::uint32_t> add_rigid_body(const RigidBody &body);
	/// Replaces its values. Refuses an index out of range.
	Status set_rigid_body(std::uint32_t index, const RigidBody &body);
	/// Impulses of the last step on each rigid body: zero for a kinematic one.
	std::span<const Reaction> reactions() const { return reactions_; }

	/// Removes borders, colliders and rigid bodies, for callers that add fresh ones every step.
	void clear_environment();
	/// Changes whenever borders or colliders come or go; no two worlds share a version, unless one is the other's copy.
	std::uint64_t environment_version() const { return environment_version_; }

	// Access of the step; not for users of the core.
	std::span<RigidBody> mutable_rigid_bodies() { return rigid_bodies_; }
	std::span<Reaction> mutable_reactions() { return reactions_; }

private:
	Status check_joint_here(const Joint &joint) const;
	void note_joint(const Joint &joint);
	void remove_joints_of(BodyId id);

	std::shared_ptr<ChangeCounts> changes_ = std::make_shared<ChangeCounts>();
	Vec2 gravity_{ 0, 0 };
	Real length_unit_ = 1;
	int contact_substeps_ = MIN_CONTACT_SUBSTEPS;
	bool sleeping_ = true;
	bool rigid_flight_ = false;
	IdList<SoftBodyData> bodies_;
	std::vector<CollisionException> collision_exceptions_;
	IdList<Joint> joints_;
	std::vector<Border> borders_;
	std::vector<Collider> colliders_;
	std::vector<RigidBody> rigid_bodies_;
	std::vector<Reaction> reactions_; ///< one a rigid body
	std::uint64_t environment_version_ = 0;
};

} // namespace softbody
