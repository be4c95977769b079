// SPDX-License-Identifier: MIT
// A body of the engine as it was last read, with its shapes translated for the core.
#pragma once

#include "core/model/rigid_body.h"
#include "core/model/surroundings.h"
#include "godot/surroundings/character_motion.h"
#include "godot/surroundings/shape_traits.h"
#include "godot/surroundings/shape_translation.h"

#include <godot_cpp/classes/physics_direct_body_state2d.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/transform2d.hpp>
#include <godot_cpp/variant/variant.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// One shape of a body.
struct ShapeRecord {
	godot::RID shape;
	godot::PhysicsServer2D::ShapeType type = godot::PhysicsServer2D::SHAPE_CUSTOM;
	godot::Variant data;
	godot::Transform2D transform; ///< in the body
	ShapeTraits traits;
	int64_t seen = -1; ///< tick of the last query that found it; used for bodies without a node
	TranslatedShape translated; ///< in the frame of `BodyRecord::frame()`; empty while it is disabled
};

/// Changes of a body since it was last read.
enum class BodyChange {
	NONE,
	MOVED, ///< its rigid body is elsewhere, or moves differently
	REBUILT, ///< its colliders have changed, or their owner
	GONE, ///< it is no longer a body of this space
};

/// A body of the physics server and all its shapes. A static body becomes static colliders of the core, any other a
/// rigid body: moved by the game (AnimatableBody2D, CharacterBody2D, a frozen RigidBody2D, a moved StaticBody2D) it
/// goes in a tick the way of the last tick; a RigidBody2D is pushed by soft bodies and pushes them.
class BodyRecord {
public:
	/// Reads a body that is in `p_space` in this tick.
	BodyRecord(const godot::RID &p_rid, const godot::RID &p_space, int64_t p_tick);

	const godot::RID &rid() const { return rid_; }
	/// Instance id of its node; 0 without one.
	uint64_t object_id() const { return object_id_; }
	/// Whether it is one of the bodies of a TileMapLayer, which all move together.
	bool is_tile() const { return is_tile_; }
	bool is_rigid() const { return mode_ >= godot::PhysicsServer2D::BODY_MODE_RIGID; }
	godot::PhysicsServer2D::BodyMode mode() const { return mode_; }
	/// Whether its node tells which shapes are disabled. The server does not: of other bodies shapes count that queries
	/// find.
	bool is_told_by_node() const { return is_told_by_node_; }
	/// Box around all its shapes, in the world.
	Aabb bounds() const;
	bool has_rigid_body() const { return is_rigid() || is_mover_; }
	const Surface &surface() const { return surface_; }
	/// The core's rigid body at the beginning of the coming step.
	const RigidBody &rigid_body() const { return rigid_body_; }
	/// Frame of the translated shapes, in the world: identity for a static body, else the body's rotation and position.
	godot::Transform2D frame() const;
	/// Origin in the world.
	godot::Vector2 origin() const { return transform_.get_origin(); }
	/// A border of the body, at its place at the end of the coming step, with its velocity.
	Border border_in_world(const Plane &p_border, double p_delta) const;
	const std::vector<ShapeRecord> &shapes() const { return shapes_; }

	/// Notes that a query found the shape in this tick.
	void note_seen(int32_t p_shape, int64_t p_tick);

	/// Reads place, motion and layers of the body after `p_delta` [s].
	BodyChange poll(double p_delta);
	/// Reads shapes and surface again. True if anything has changed. Of a body without a node, shapes count that a query
	/// has found in the tick `p_since` or later; so below.
	bool reread(int64_t p_since);
	/// Whether shapes were added, removed, enabled or disabled since they were read. O(shape owners).
	bool has_other_shapes(int64_t p_since) const;
	/// Whether it is still a body of the space. Cheap.
	bool is_there() const { return is_in_space(rid_, space_); }
	/// Whether this body exists and is in this space.
	static bool is_in_space(const godot::RID &p_body, const godot::RID &p_space);

	/// Index of its rigid body in the core's list, as long as that list is not made anew.
	uint32_t rigid_index = NO_RIGID_BODY;
	/// Takes over the impulses of soft bodies in a step of `p_delta` [s], and returns those for the physics server. A
	/// sleeping body gets none as long as its weight, its support and these impulses cancel.
	Reaction take_reaction(const Reaction &p_reaction, double p_delta);
	/// Puts the body to sleep again if proxies of soft bodies have woken it.
	void keep_asleep();
	/// Wakes the body if it sleeps supported by soft bodies that are about to leave.
	void let_go();

	/// What a CharacterBody2D does beside going its way; null for any other body.
	CharacterMotion *character() { return character_ ? &*character_ : nullptr; }
	/// Whether a shape of the body, where it is, reaches into the hull by more than `p_depth` [px].
	bool reaches_in(std::span<const Vec2> p_hull, Real p_depth) const;
	/// Whether a character is stopped by what is on these layers.
	bool meets_layer(uint32_t p_layer) const;
	/// Called after `poll`, once the soft bodies near are noted: makes the rigid body of a character whose mass acts.
	/// `p_mass` [kg] holds where the node has none of its own. MOVED if it has one, REBUILT if it must get one.
	BodyChange ride(Real p_mass, double p_delta);

private:
	BodyChange poll_driven(const godot::Transform2D &p_transform, double p_delta);
	BodyChange settle();
	void poll_rigid(godot::PhysicsDirectBodyState2D *p_state, double p_delta);
	Vec2 take_back_fall(double p_delta);
	void estimate_support(godot::PhysicsDirectBodyState2D *p_state, double p_delta, RigidBody &r_body) const;
	bool read_surface();
	void read_shape(int32_t p_index, const ShapeTraits &p_traits, ShapeRecord &r_shape);
	bool is_enabled(const ShapeRecord &p_shape, int64_t p_since) const;
	void translate(ShapeRecord &r_shape) const;
	void measure_bounds();
	void translate_all();
	bool take_transform(const godot::Transform2D &p_transform);

	godot::RID rid_;
	godot::RID space_;
	uint64_t object_id_ = 0;
	uint64_t owners_ = 0; ///< result of `describe_shape_owners`
	bool is_told_by_node_ = false;
	bool is_tile_ = false;
	godot::PhysicsServer2D::BodyMode mode_ = godot::PhysicsServer2D::BODY_MODE_STATIC;
	bool is_mover_ = false; ///< moved by the game, not by forces, in recent ticks
	int still_ticks_ = 0;
	godot::Transform2D transform_;
	godot::Transform2D scale_; ///< scale and skew of its transform
	Surface surface_;
	RigidBody rigid_body_;
	bool was_rigid_ = false; ///< whether `rigid_body_` and `last_reaction_` are those of the last tick
	bool is_sleeping_ = false; ///< in the engine, until it gets impulses
	Vec2 weight_; ///< acceleration by gravity and constant forces [px/s²]
	Reaction last_reaction_;
	std::optional<CharacterMotion> character_;
	Reaction withheld_; ///< impulses since it fell asleep, its weight included
	std::vector<ShapeRecord> shapes_;
	Aabb bounds_; ///< in `frame()`
	bool has_border_ = false;
};

} // namespace softbody
