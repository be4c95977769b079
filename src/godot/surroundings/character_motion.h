// SPDX-License-Identifier: MIT
// A CharacterBody2D as a body with a mass, while it falls or stands on soft bodies.
#pragma once

#include "core/model/rigid_body.h"
#include "core/model/soft_body_data.h"
#include "godot/surroundings/rider.h"

#include <godot_cpp/classes/character_body2d.hpp>
#include <godot_cpp/variant/rid.hpp>

#include <cstdint>

namespace softbody {

/// What a CharacterBody2D does to soft bodies and they to it. It is moved by its script and moves whatever is in its way,
/// except along its `up_direction` while it is in the air or stands on a soft body: there it falls, presses and is
/// thrown as a rigid body of its mass. `move_and_slide` follows, as the proxy of the soft body has the hull that the
/// step has left, and at the character's soles the velocity of the character in that step: that of a platform, which
/// carries what stands on it and throws it off. See docs/decisions/characters.md.
class CharacterMotion {
public:
	/// Forgets which soft bodies are near.
	void begin_tick();
	/// Notes a soft body that the character can stand on. `box` is around the character's shapes in the world [px]; a
	/// `hard` body takes no notice of its mass.
	void note_near(const SoftBodyData &body, const Aabb &box, bool hard);

	/// Makes `r_body`, at the place of the character, its rigid body for a step of `delta` [s], if its mass acts, and
	/// returns whether it does. `gravity` is the acceleration at the character [px/s²]; `mass` [kg] holds where the node
	/// has no mass of its own; 0 is a character that no soft body moves.
	bool begin_step(const godot::CharacterBody2D &node, Vec2 gravity, Real mass, Real delta, RigidBody &r_body);
	/// Takes over where a step of `delta` [s] has left its rigid body.
	void end_step(const RigidBody &body, const Reaction &reaction, Real delta);

	/// Whether its mass acts in this tick.
	bool acts() const { return acts_; }
	/// The character after the step. `box` is around its shapes before it.
	Rider rider(const Aabb &box) const;

	/// Metadata of the node with its mass [kg].
	static const char *const MASS_META;

private:
	Vec2 up_;
	Vec2 from_; ///< place before the step
	Vec2 way_; ///< expected in this tick
	Real speed_ = 0; ///< along `up_` after the last step [px/s]
	Vec2 calm_place_; ///< where it has stood still
	Real calm_time_ = 0; ///< for so long [s]
	Real own_speed_ = 0; ///< of the node along `up_`, relative to the floor on which it is [px/s]
	Real reach_ = 0; ///< to either side in this tick [px]
	Real level_ = 0; ///< expected place along `up_` after this tick [px]
	Real floor_gap_ = 0; ///< between the soles and its floor [px]
	Real snap_length_ = 0; ///< of the node [px]
	Real surface_speed_ = 0; ///< along `up_`, of what it stands on [px/s]
	Real gap_ = 0; ///< see `Rider`
	bool acts_ = false;
	bool stood_ = false; ///< on a soft body, in the last tick
	bool is_near_ = false;
	bool is_above_ = false;
	bool is_hard_ = false;
};

} // namespace softbody
