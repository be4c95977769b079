// SPDX-License-Identifier: MIT
// Hands the bodies of Godot's physics server to the core, and what soft bodies did to them back.
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

/// Keeps the core's surroundings as the engine's: rectangle, circle, capsule, segment, convex and concave polygon and world
/// boundary, on bodies of every mode, with any transform. A body near a soft one is read once, with all its shapes, and
/// kept while it is near; it is handed over in the order of bodies and shapes, whichever way the engine found it. Where a
/// body is, how it moves and its layers are read every tick; of several bodies of one node, tiles for example, one is asked,
/// and the others when it moved. Whether bodies are still there and which of their shapes are enabled is looked at in turn,
/// LOOKS of them a tick, shapes and materials REREAD_SHAPES a tick. The core's list is made anew only when a body came, went
/// or changed, so that what stands still costs nothing and lets bodies sleep on it.
class EnvironmentReader {
public:
	explicit EnvironmentReader(const godot::RID &p_space) : space_(p_space) {}
	~EnvironmentReader();
	EnvironmentReader(const EnvironmentReader &) = delete;
	EnvironmentReader &operator=(const EnvironmentReader &) = delete;

	/// Brings the surroundings of the world up to date for a step of `p_delta` [s]. The bodies `p_joined` belong to them wherever
	/// they are.
	void read(godot::PhysicsDirectSpaceState2D *p_state, const std::vector<godot::RID> &p_joined, double p_delta, WorldData &r_world);
	/// Whether `tell` has anything to say, in this tick or to take back from the last.
	bool has_moving() const { return had_moving_ || !moving_.empty(); }
	/// Tells the proxy of the soft body stored at `p_row` which bodies that move, or may, are near it.
	void tell(std::size_t p_row, HullProxy &r_proxy) const;
	/// Hands what soft bodies did to rigid bodies in the step of `p_delta` [s] to the physics server. Bodies that got nothing
	/// are left alone, so that they sleep.
	void give_back(const WorldData &p_world, double p_delta);
	/// After proxies have moved, which wakes what is near them.
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
	std::vector<BodyRecord *> movers_; ///< those that the core has as rigid bodies
	std::vector<godot::RID> gone_; ///< found out in this tick
	std::vector<godot::RID> missing_; ///< gone, but on the list of the known: they may come back
	std::vector<Collider> colliders_; ///< as they are handed over
	std::vector<FoundShape> found_;
	std::vector<godot::RID> known_;
	std::vector<Moving> moving_;
	std::vector<std::vector<uint32_t>> moving_near_; ///< those near each group of soft bodies
	int64_t tick_ = 0;
	int64_t look_from_ = 0; ///< id of the body with which looking goes on
	int64_t reread_from_ = 0; ///< the same of rereading
	bool are_bodies_listed_ = true;
	bool is_handed_over_ = true;
	bool had_moving_ = false;
};

} // namespace softbody
