// SPDX-License-Identifier: MIT
// A body of the engine as it was last read, with its shapes in the core's terms.
#pragma once

#include "core/model/rigid_body.h"
#include "core/model/surroundings.h"
#include "godot/surroundings/shape_traits.h"
#include "godot/surroundings/shape_translation.h"

#include <godot_cpp/classes/physics_direct_body_state2d.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/transform2d.hpp>
#include <godot_cpp/variant/variant.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace softbody {

/// One shape of a body.
struct ShapeRecord {
	godot::RID shape;
	godot::PhysicsServer2D::ShapeType type = godot::PhysicsServer2D::SHAPE_CUSTOM;
	godot::Variant data;
	godot::Transform2D transform; ///< in the body
	ShapeTraits traits;
	int64_t seen = -1; ///< tick in which it was last found; counts for bodies without a node
	TranslatedShape translated; ///< in the frame of `BodyRecord::frame()`; empty while it is disabled
};

/// What happened to a body since it was last read.
enum class BodyChange {
	NONE,
	MOVED, ///< its rigid body is elsewhere, or moves otherwise
	REBUILT, ///< its colliders are others, or belong to something else
	GONE, ///< it is no body of this space any more
};

/// A body of the physics server and all its shapes. What has stood still for a while is handed to the core as
/// colliders that stand still. Everything else is a rigid body of the core: what is driven by the game (AnimatableBody2D,
/// CharacterBody2D, a frozen RigidBody2D, a StaticBody2D that is moved) goes in a tick the way from where it was in the last
/// tick to where it is now, a RigidBody2D is pushed by soft bodies and pushes them.
class BodyRecord {
public:
	/// Reads a body that is in `p_space` in this tick.
	BodyRecord(const godot::RID &p_rid, const godot::RID &p_space, int64_t p_tick);

	const godot::RID &rid() const { return rid_; }
	/// Of the node that it belongs to; 0 without one.
	uint64_t object_id() const { return object_id_; }
	/// Whether it is one of the bodies of a TileMapLayer, which all move together.
	bool is_tile() const { return is_tile_; }
	bool is_rigid() const { return is_rigid_; }
	godot::PhysicsServer2D::BodyMode mode() const { return mode_; }
	/// Whether its node tells which shapes are disabled. The physics server does not: of other bodies those shapes count
	/// that queries find, so these must go on finding them.
	bool is_told_by_node() const { return is_told_by_node_; }
	/// Around all its shapes, in the world.
	Aabb bounds() const;
	bool has_rigid_body() const { return is_rigid_ || is_mover_; }
	const Surface &surface() const { return surface_; }
	/// Of the core, at the beginning of the coming step.
	const RigidBody &rigid_body() const { return rigid_body_; }
	/// In which the shapes are translated, as seen from the world: of a body that stands still the world itself, else
	/// the rotation and position of the body.
	godot::Transform2D frame() const;
	/// In the world.
	godot::Vector2 origin() const { return transform_.get_origin(); }
	/// A border of the body, which the core has no rigid body for: at the end of its way in the coming step, with its velocity.
	Border border_in_world(const Plane &p_border, double p_delta) const;
	const std::vector<ShapeRecord> &shapes() const { return shapes_; }

	/// A query found the shape in this tick.
	void note_seen(int32_t p_shape, int64_t p_tick);

	/// Reads where the body is, how it moves and on which layers it is, after `p_delta` [s].
	BodyChange poll(double p_delta);
	/// Reads shapes and surface again. True if anything is different.
	bool reread(int64_t p_tick);
	/// Whether shapes were added, removed, enabled or disabled since they were read. O(shape owners).
	bool has_other_shapes(int64_t p_tick) const;
	/// Whether it is still a body of the space. Cheap.
	bool is_there() const;

	/// Place of its rigid body in the core's list, as long as that list is not made anew.
	uint32_t rigid_index = NO_RIGID_BODY;
	/// Takes over what soft bodies gave it in a step of `p_delta` [s], and says what the physics server is to get. A body that
	/// sleeps is left alone as long as its weight, its support and what soft bodies give it cancel.
	Reaction take_reaction(const Reaction &p_reaction, double p_delta);
	/// Puts it to sleep again if it slept and was to be left alone, but proxies of soft bodies have woken it.
	void keep_asleep();
	/// Wakes it if it sleeps held by soft bodies: there will be none.
	void let_go();

private:
	BodyChange poll_driven(const godot::Transform2D &p_transform, double p_delta);
	BodyChange settle();
	void poll_rigid(godot::PhysicsDirectBodyState2D *p_state, double p_delta);
	void estimate_support(godot::PhysicsDirectBodyState2D *p_state, double p_delta, RigidBody &r_body) const;
	bool read_surface();
	void read_shape(int32_t p_index, const ShapeTraits &p_traits, ShapeRecord &r_shape);
	bool is_enabled(const ShapeRecord &p_shape, int64_t p_tick) const;
	void translate(ShapeRecord &r_shape) const;
	void measure_bounds();
	void translate_all();
	bool take_transform(const godot::Transform2D &p_transform);

	godot::RID rid_;
	godot::RID space_;
	uint64_t object_id_ = 0;
	uint64_t owners_ = 0; ///< what `describe_shape_owners` said
	bool is_told_by_node_ = false;
	bool is_tile_ = false;
	godot::PhysicsServer2D::BodyMode mode_ = godot::PhysicsServer2D::BODY_MODE_STATIC;
	bool is_rigid_ = false;
	bool is_mover_ = false; ///< moved not long ago, and not by forces
	int still_ticks_ = 0;
	godot::Transform2D transform_;
	godot::Transform2D scale_; ///< what its transform has beyond rotation and position
	Surface surface_;
	RigidBody rigid_body_;
	bool was_rigid_ = false; ///< whether `rigid_body_` and `last_reaction_` are those of the last tick
	bool is_sleeping_ = false; ///< in the engine, until it is given something
	Vec2 weight_; ///< what gravity and constant forces add to its velocity [px/s²]
	Reaction last_reaction_;
	Reaction withheld_; ///< since it fell asleep, its weight included
	std::vector<ShapeRecord> shapes_;
	Aabb bounds_; ///< in `frame()`
	bool has_border_ = false;
};

} // namespace softbody
