// SPDX-License-Identifier: MIT
// Hands bodies of Godot's physics server to the core, and impulses of soft bodies back.
#pragma once

#include "core/model/world_data.h"
#include "godot/surroundings/body_record.h"
#include "godot/surroundings/collider_search.h"

#include <godot_cpp/classes/physics_direct_space_state2d.hpp>
#include <godot_cpp/variant/rid.hpp>

#include <cstdint>
#include <map>
#include <vector>

namespace softbody {

class HullProxy;

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

	/// Updates the environment for a step of `p_delta` [s]. The bodies `p_joined` belong to it wherever they are.
	void read(godot::PhysicsDirectSpaceState2D *p_state, const std::vector<godot::RID> &p_joined, double p_delta, WorldData &r_world);
	/// Whether `tell` has bodies to report, in this tick or to withdraw from the last.
	bool has_moving() const { return had_moving_ || !moving_.empty(); }
	/// Reports to the proxy of the soft body stored at `p_row` the bodies near it that move, or may.
	void tell(std::size_t p_row, HullProxy &r_proxy) const;
	/// Hands impulses of soft bodies in the step of `p_delta` [s] to the physics server. Bodies without impulses are
	/// not touched, so that they can sleep.
	void give_back(const WorldData &p_world, double p_delta);
	/// Called after proxies have moved, which wakes bodies near them.
	void keep_asleep();

private:
	/// A body of the engine that moves, or may.
	struct Moving {
		godot::RID body;
		godot::PhysicsServer2D::BodyMode mode;
		Aabb box; ///< in the world [px]
		uint32_t layer = 0;
	};

	void list_known();
	void take_joined(const std::vector<godot::RID> &p_joined);
	void take_new(godot::PhysicsDirectSpaceState2D *p_state);
	bool add(const godot::RID &p_body);
	void take_back();
	void forget_far(const std::vector<godot::RID> &p_joined);
	void drop_gone();
	void list_bodies();
	void poll(double p_delta, WorldData &r_world);
	void poll(BodyRecord &r_body, double p_delta, bool &r_has_moved);
	void look_at_some();
	void reread_some();
	void count_shapes();
	void list_moving();
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
	std::vector<godot::RID> known_;
	std::vector<Moving> moving_;
	std::vector<std::vector<uint32_t>> moving_near_; ///< for each group of soft bodies
	int64_t tick_ = 0;
	int64_t look_from_ = 0; ///< id of the body with which checking goes on
	int64_t reread_from_ = 0; ///< id of the body with which rereading goes on
	bool are_bodies_listed_ = true;
	bool is_handed_over_ = true;
	bool had_moving_ = false;
};

} // namespace softbody
