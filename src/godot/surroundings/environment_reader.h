// SPDX-License-Identifier: MIT
// Hands bodies of Godot's physics server to the core.
#pragma once

#include "core/model/world_data.h"
#include "godot/surroundings/body_record.h"
#include "godot/surroundings/collider_search.h"

#include <godot_cpp/classes/physics_direct_space_state2d.hpp>
#include <godot_cpp/variant/rid.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace softbody {

/// Keeps the core's environment equal to the engine's: shapes of every kind but separation rays, on bodies of every
/// mode, with any transform. A body near a soft one is read once and kept while it is near; its place, motion and
/// layers are read every tick, its shapes and existence in turn. The core's list is made anew only when a body came,
/// went or changed, so static colliders cost nothing. See docs/decisions/reading-the-engine.md.
class EnvironmentReader {
public:
	explicit EnvironmentReader(const godot::RID &p_space) : space_(p_space) {}
	~EnvironmentReader();
	EnvironmentReader(const EnvironmentReader &) = delete;
	EnvironmentReader &operator=(const EnvironmentReader &) = delete;

	/// Updates the environment for a step of `p_delta` [s]. `p_changed` are the rows of soft bodies that move or have
	/// changed since the last call. The bodies `p_joined` belong to the environment wherever they are.
	void read(godot::PhysicsDirectSpaceState2D *p_state, std::span<const uint32_t> p_changed,
			const std::vector<godot::RID> &p_joined, double p_delta, WorldData &r_world);
	/// Rows of the soft bodies whose group (`ColliderSearch`) has bodies near it that move, or may.
	std::span<const uint32_t> rows_near_moving() const { return rows_near_moving_; }
	/// Calls `p_work(body)` for the bodies that move, or may, and are near the soft body stored at `p_row`.
	template <class Work>
	void for_moving_near(std::size_t p_row, const Work &p_work) const {
		const uint32_t group = search_.group_of(p_row);
		if (group == ColliderSearch::NO_GROUP) {
			return;
		}
		for (const uint32_t i : moving_near_[group]) {
			const Moving &moving = moving_[i];
			if ((moving.body->surface().layer & search_.mask(p_row)) != 0 && moving.box.overlaps(search_.reach(p_row))) {
				p_work(*moving.body);
			}
		}
	}
	/// Called after soft bodies near characters are noted (`CharacterMotion::note_near`): gives characters that fall or
	/// stand on them a mass for the step of `p_delta` [s]. `p_mass` [kg] is that of characters without a mass of their own.
	void begin_rides(Real p_mass, double p_delta, WorldData &r_world);
	/// Called after the step: takes over where it has left them.
	void end_rides(const WorldData &p_world, double p_delta);
	/// Hands impulses of soft bodies in the step of `p_delta` [s] to the physics server. Bodies without impulses are not
	/// touched, so that they can sleep.
	void give_back_impulses(const WorldData &p_world, double p_delta);
	/// Puts bodies that slept to sleep again, as proxies wake bodies near them when they move. Called after they have.
	void keep_rigid_bodies_asleep();

private:
	/// A body of the engine that moves, or may.
	struct Moving {
		BodyRecord *body;
		Aabb box; ///< that it may reach in the coming tick, in the world [px]
	};

	/// The tick since when a query has found every shape there is.
	int64_t seen_since() const { return tick_ - search_.interval() - 1; }
	void list_known();
	void take_joined(const std::vector<godot::RID> &p_joined);
	void take_new(godot::PhysicsDirectSpaceState2D *p_state);
	bool add(const godot::RID &p_body);
	void take_back();
	void forget_far(const std::vector<godot::RID> &p_joined);
	void drop_gone();
	void note_other_bodies();
	void list_bodies();
	void poll(double p_delta, WorldData &r_world);
	BodyChange poll(BodyRecord &r_body, double p_delta);
	void check_some();
	template <class Check>
	void check_in_turn(int64_t &r_from, int p_budget, const Check &p_check);
	void reread(BodyRecord &r_body);
	void count_shapes();
	void list_moving(double p_delta);
	void hand_over(double p_delta, WorldData &r_world);
	void hand_over_shapes(const BodyRecord &p_body, double p_delta, WorldData &r_world);

	godot::RID space_;
	ColliderSearch search_;
	std::map<int64_t, BodyRecord> bodies_; ///< by id of the body
	std::vector<BodyRecord *> leaders_; ///< asked every tick, in the order of `bodies_`
	std::vector<std::vector<BodyRecord *>> followers_; ///< of each leader
	std::vector<BodyRecord *> movers_; ///< those that are rigid bodies of the core
	std::vector<godot::RID> gone_; ///< found in this tick
	std::vector<godot::RID> missing_; ///< gone, but on the list of known bodies: they may come back
	std::vector<Collider> colliders_; ///< as handed over
	std::vector<FoundShape> found_;
	std::vector<Moving> moving_;
	std::vector<std::vector<uint32_t>> moving_near_; ///< for each group of soft bodies
	std::vector<uint32_t> rows_near_moving_;
	int64_t tick_ = 0;
	int64_t look_from_ = 0; ///< id of the body with which checking goes on
	int64_t reread_from_ = 0; ///< id of the body with which rereading goes on
	bool are_bodies_listed_ = true;
	bool is_handed_over_ = true;
};

} // namespace softbody
