// SPDX-License-Identifier: MIT
// Finds bodies of the engine near soft bodies that are not known yet.
#pragma once

#include "core/geometry/aabb.h"
#include "core/model/world_data.h"
#include "godot/surroundings/crowd_watch.h"

#include <godot_cpp/classes/physics_direct_space_state2d.hpp>
#include <godot_cpp/classes/physics_shape_query_parameters2d.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// A shape of a body of the physics server, by the body and the index of the shape in it.
struct FoundShape {
	godot::RID body;
	int32_t shape = 0;
};

/// Asks the engine by one rectangle around each group of close soft bodies. Known bodies (the list of `exclude`, and
/// proxies) are left out of the answers. Sleeping bodies are asked for every second tick, or more seldom and in larger
/// rectangles if there are thousands. The engine tests at most 2048 shapes in one query and does not report more, so
/// rectangles with many shapes, known ones or others (`CrowdWatch`), are asked in pieces.
/// See docs/decisions/reading-the-engine.md.
class ColliderSearch {
public:
	ColliderSearch();
	~ColliderSearch();
	ColliderSearch(const ColliderSearch &) = delete;
	ColliderSearch &operator=(const ColliderSearch &) = delete;

	/// Updates places and reach of soft bodies for a step of `p_delta` [s]. `p_changed` are the rows of those that move or
	/// have changed since the last call. O(changed); O(bodies) after bodies came, went or got other settings, and once in
	/// REGROUP_INTERVAL ticks.
	void follow(const WorldData &p_world, std::span<const uint32_t> p_changed, double p_delta);
	/// Adds shapes that overlap a group, on layers that its bodies collide with. May repeat known shapes.
	void find(godot::PhysicsDirectSpaceState2D *p_state, std::vector<FoundShape> &r_found);

	/// Waits until a physics server on a thread of its own has done what it was told: bodies that were freed or added
	/// since are gone or there.
	void await_server() const;
	/// Longest time between two queries that cover a body [ticks].
	int64_t interval() const;
	/// Counts answers of the last `find` that were known already.
	void note_needless(int64_t p_count) { needless_ += p_count; }
	/// Whether it is time to call `exclude`, with `p_known` bodies known.
	bool is_list_due(int64_t p_known) const;
	/// The known bodies, to which all proxies are added.
	void exclude(godot::TypedArray<godot::RID> p_known);
	/// Marks some known bodies as unknown: they must be found again.
	void forget_list() { is_list_valid_ = false; }

	/// Whether the groups differ from those of the last tick.
	bool is_regrouped() const { return is_regrouped_; }
	void clear_counts();
	/// Reports the number of known shapes in the box.
	void count_shapes(const Aabb &p_box, int64_t p_count);

	/// Whether any group is in or near the box.
	bool is_near(const Aabb &p_box) const;
	std::size_t group_count() const { return groups_.size(); }
	/// Box around the bodies of a group, with a margin for fast bodies.
	const Aabb &group_box(std::size_t p_group) const { return groups_[p_group].box; }

	/// Adds the rows of a group's bodies.
	void append_rows(std::size_t p_group, std::vector<uint32_t> &r_rows) const {
		for (std::size_t i = groups_[p_group].begin; i < groups_[p_group].end; i++) {
			r_rows.push_back(order_[i].second);
		}
	}
	/// Group of the body stored at `p_row`, or NO_GROUP if it collides with nothing.
	uint32_t group_of(std::size_t p_row) const { return followed_[p_row].group; }
	/// Layers that the body collides with.
	uint32_t mask(std::size_t p_row) const { return followed_[p_row].mask; }
	/// Box that the body may reach in the coming step [px].
	const Aabb &reach(std::size_t p_row) const { return followed_[p_row].reach; }

	static constexpr uint32_t NO_GROUP = UINT32_MAX;

private:
	struct Followed {
		BodyId id;
		Aabb reach;
		uint32_t mask = 0;
		uint32_t group = NO_GROUP;
		bool asleep = false; ///< `reach` is that of a body at rest
	};
	struct Group {
		std::size_t begin = 0, end = 0; ///< in `order_`
		Aabb box;
		uint32_t mask = 0;
		int64_t shapes = 0; ///< known shapes, without proxies
		bool asleep = true;
		int64_t asked = 0; ///< tick of its last query
		bool is_current = false; ///< whether box, mask and sleep are those of its bodies
	};

	bool follow(const WorldData &p_world, std::size_t p_row, Real p_delta, bool &r_is_moving);
	void regroup();
	void divide(std::size_t p_begin, std::size_t p_end);
	void measure_groups();
	/// The groups from `p_begin` on that one query covers: one whose bodies are awake, or several asleep side by side.
	std::size_t end_of_run(std::size_t p_begin, Aabb &r_box) const;
	void watch_crowds(godot::PhysicsDirectSpaceState2D *p_state);
	void query(godot::PhysicsDirectSpaceState2D *p_state, const Aabb &p_box, int p_splits, int p_depth,
			std::vector<FoundShape> &r_found);

	godot::RID query_shape_;
	godot::Ref<godot::PhysicsShapeQueryParameters2D> query_;
	std::vector<Followed> followed_; ///< one a body of the world, in its order
	std::vector<std::pair<Vec2, uint32_t>> order_; ///< centers and rows of bodies that collide, group by group
	std::vector<Group> groups_;
	std::size_t asleep_count_ = 0; ///< bodies of groups in which all are asleep
	bool is_regrouped_ = false;
	uint64_t arrangement_ = UINT64_MAX; ///< of the world when all bodies were last followed
	int64_t tick_ = 0;
	int64_t regrouped_ = 0; ///< tick of the last regrouping

	CrowdWatch crowds_;
	std::size_t watched_group_ = 0; ///< whose crowd was counted last
	int64_t needless_ = 0; ///< since the list was handed over
	uint64_t listed_proxies_ = 0; ///< number of proxies at that time
	bool is_list_valid_ = false;
};

} // namespace softbody
