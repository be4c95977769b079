// SPDX-License-Identifier: MIT
// Reads the static shapes near soft bodies from Godot's physics server into the core's surroundings.
#pragma once

#include "core/geometry/polygon.h"
#include "core/model/world_data.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/physics_direct_space_state2d.hpp>
#include <godot_cpp/classes/physics_shape_query_parameters2d.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/transform2d.hpp>
#include <godot_cpp/variant/typed_array.hpp>
#include <godot_cpp/variant/variant.hpp>

#include <cstdint>
#include <set>
#include <utility>

namespace softbody {

/// Asks the space which shapes overlap given boxes, and translates each once a step. Understood:
/// rectangle, circle, capsule, segment, convex and concave polygon, world boundary, on bodies that do
/// not move by forces (static and kinematic), with any transform. Surface values follow the body's
/// PhysicsMaterial, a StaticBody2D's constant velocity included.
class SurroundingsReader {
public:
	SurroundingsReader();
	~SurroundingsReader();
	SurroundingsReader(const SurroundingsReader &) = delete;
	SurroundingsReader &operator=(const SurroundingsReader &) = delete;

	/// Forgets the last step's surroundings, in the world too.
	void begin(WorldData &r_world);
	/// Adds everything in `p_space` that overlaps `p_box` (global pixels) on a layer of `p_mask`.
	/// `r_proxy` learns which bodies are near.
	void read(godot::PhysicsDirectSpaceState2D *p_space, const Aabb &p_box, uint32_t p_mask, HullProxy &r_proxy, WorldData &r_world);
	/// What `read` does not look at: bodies of the physics server.
	void set_excluded(const godot::TypedArray<godot::RID> &p_bodies) { query_->set_exclude(p_bodies); }

private:
	void read_shape(const godot::RID &p_body, int p_shape_index, WorldData &r_world);

	godot::RID query_shape_;
	godot::Ref<godot::PhysicsShapeQueryParameters2D> query_;
	std::set<std::pair<int64_t, int>> known_; ///< body and shape index already read in this step
};

} // namespace softbody
