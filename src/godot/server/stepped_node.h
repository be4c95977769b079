// SPDX-License-Identifier: MIT
// What a space asks of the nodes whose bodies and joints it steps.
#pragma once

#include "core/geometry/aabb.h"
#include "core/model/contact.h"
#include "core/model/joint.h"
#include "core/model/soft_body_data.h"
#include "godot/surroundings/area_effects.h"

#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/string.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

class DrawingFrame;
class HullProxy;
class StateReader;
class StateWriter;
class StepSignals;

/// A node with a body in a `SoftBodySpace2D`. The space knows nothing else of nodes.
class SteppedNode {
public:
	virtual uint64_t instance_id() const = 0;
	/// The body in the space's world; that of no body if the node has none.
	virtual BodyId get_body_id() const = 0;
	/// Settings of the project that bodies may leave open have changed.
	virtual void note_project_settings() = 0;

	// The parts of a tick, in order.
	/// Takes over a transform that the user set, and whether the node may process, before a step of `p_delta` [s].
	virtual void prepare_step(double p_delta) = 0;
	/// Takes over gravity and damping of areas. `p_space` holds where no area is. `p_engine_has_stepped`: the engine's physics, since
	/// the last step.
	virtual void feel_areas(const AreaEffects &p_space, bool p_engine_has_stepped) = 0;
	/// Has the engine work out the effects of areas anew for a proxy that rests, for `feel_areas` in the next tick.
	virtual void stir_proxy() = 0;
	virtual HullProxy &proxy() = 0;
	/// Says of a body that the step has reset why that was done.
	virtual void note_failure(StepSignals &r_signals) = 0;
	/// Says of a body that its shape at rest has changed in the step.
	virtual void note_dent(StepSignals &r_signals) = 0;
	/// Tears the body, after the step, where strain is more than it bears.
	virtual void tear(StepSignals &r_signals) = 0;
	/// Moves the node along, and keeps what drawing interpolates.
	virtual void finish_step() = 0;
	/// Moves the proxy along. If it returns true, `flush_hull_proxies` must be called.
	virtual bool follow_with_proxy(bool p_may_detail) = 0;
	/// Adds a signal if the body has fallen asleep or woken.
	virtual void take_sleep(StepSignals &r_signals) = 0;
	virtual bool watches_contacts() const = 0;
	/// Takes the contacts and touches of this body. `p_colliders` has the instance id of the other side of each contact,
	/// 0 for none.
	virtual void take_contacts(std::span<const Contact> p_contacts, std::span<const uint64_t> p_colliders,
			std::vector<uint64_t> p_touched, StepSignals &r_signals) = 0;
	/// Whether the budget may pause the body, or keep it paused: it moves, is not important, and no camera sees it.
	virtual bool may_pause() const = 0;
	/// Whether all of these can be left out until the body moves or the node changes (`SoftBodySpace2D::note_change`).
	virtual bool is_idle() const = 0;

	// The state of a whole space, between two steps.
	/// Takes over a transform that the user has just set.
	virtual void take_over_transform() = 0;
	/// How messages name the node.
	virtual godot::String describe() const = 0;
	/// What the node remembers besides its body.
	virtual void write_state(StateWriter &r_to) const = 0;
	/// Refuses, by name, what `write_state` cannot have written, and states of another structure.
	virtual Status check_state(std::span<const uint8_t> p_state) const = 0;
	/// After the body has got back its state. Precondition: `check_state` accepts it. `p_is_foreign`: instance ids in it mean nothing.
	virtual void take_state(std::span<const uint8_t> p_state, bool p_is_foreign) = 0;

	/// Before a frame is drawn: brings the skin to where the body is in it. False if there was nothing to do.
	virtual bool draw_frame(const DrawingFrame &p_frame) = 0;
	/// Whether that can be left out until the node says so (`SoftBodySpace2D::note_look`).
	virtual bool is_drawn() const = 0;
	/// How deep the body is inside of surfaces [px].
	virtual double get_penetration() const = 0;

	/// The node's places in the lists of its space (`NodeList`), which alone change them.
	struct Places {
		std::size_t all = SIZE_MAX;
		std::size_t busy = SIZE_MAX;
		std::size_t near_moving = SIZE_MAX;
		std::size_t undrawn = SIZE_MAX;
		std::size_t paused = SIZE_MAX;
	};
	Places places;
	/// Whether its proxy shows dents, as the space last counted it.
	bool is_counted_detailed = false;
	/// Whether the body stands still for the budget. The space alone changes it.
	bool is_paused = false;

protected:
	~SteppedNode() = default;
};

/// A node with a joint in a `SoftBodySpace2D`.
class SteppedJoint {
public:
	virtual JointId get_joint_id() const = 0;
	/// The RigidBody2D that it pulls, which must then be among the surroundings; invalid if it pulls none.
	virtual godot::RID get_rigid_body() const = 0;
	/// Before a step: makes the joint if its ends have come, takes over what was changed.
	virtual void prepare_step() = 0;
	/// The step has removed the core's joint, which bore too much.
	virtual void note_break(StepSignals &r_signals) = 0;
	/// The body `p_whole` of the node `p_node` has been cut: ends on it go to the nearest of the pieces, which are nodes by
	/// instance id. `p_cut` is the number of the cut, above those of all earlier ones.
	virtual void follow_cut(uint64_t p_cut, uint64_t p_node, const SoftBodyData &p_whole, std::span<const uint64_t> p_pieces) = 0;
	/// The node's body is again what it was before the cut of that number: ends that stood on it then stand there again.
	virtual void undo_cuts(uint64_t p_first_cut, uint64_t p_node) = 0;
	/// What the node remembers besides the core's joint.
	virtual void write_state(StateWriter &r_to) const = 0;
	/// Reads what `write_state` wrote, and takes it over if `p_takes`: before bodies and joints of the core are put back. Refuses the
	/// state of another node, unless `p_is_foreign`: then instance ids in it mean nothing.
	virtual Status read_state(StateReader &r_from, bool p_is_foreign, bool p_takes) = 0;
	/// After the core's joints have been put back.
	virtual void note_restored() = 0;

protected:
	~SteppedJoint() = default;
};

/// A fluid in a `SoftBodySpace2D`.
class SteppedFluid {
public:
	/// Looks at its shapes and values before a step. False if it pushes nothing now.
	virtual bool look() = 0;
	/// Stands for what `look` has found, if it bears bodies; 0 if it does not.
	virtual uint64_t number() const = 0;
	/// Whether it flows, and so may wake a body.
	virtual bool flows() const = 0;
	/// Whether it may push a body whose hull has that box, by what `look` has found.
	virtual bool reaches(const SoftBodyData &p_body, const Aabb &p_box) const = 0;
	/// Adds its forces in a step of `p_delta` [s] to the body of a node that it reaches.
	virtual void push(SteppedNode &r_node, double p_delta) = 0;

protected:
	~SteppedFluid() = default;
};

} // namespace softbody
