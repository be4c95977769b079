// SPDX-License-Identifier: MIT
// All soft bodies of one physics space, stepped together once a physics tick.
#pragma once

#include "core/dynamics/simulator.h"
#include "core/dynamics/step_budget.h"
#include "core/dynamics/world_state.h"
#include "core/model/world_data.h"
#include "godot/server/node_list.h"
#include "godot/server/step_settings.h"
#include "godot/server/step_threads.h"
#include "godot/server/stepped_node.h"
#include "godot/surroundings/area_effects.h"
#include "godot/surroundings/environment_reader.h"

#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <vector>

namespace softbody {

class StepSignals;

/// Time of the parts of steps [µs].
struct TickProfile {
	double nodes = 0; ///< number of nodes gone through
	double prepare = 0; ///< taking over changes of users
	double surroundings = 0; ///< reading the environment near bodies
	double simulate = 0; ///< in the core
	double finish = 0; ///< moving nodes along
	double proxies = 0; ///< showing the hulls to the engine
};

/// Joins the core's world of one `World2D` with the nodes of its bodies. A tick goes through busy nodes only: those
/// whose bodies move, and those that have something else to do in it. A node at rest costs nothing in a tick.
class SoftBodySpace2D {
public:
	/// `p_space` is the space of a `World2D` and must outlive this object. `p_parallel_for` divides the work of a step.
	SoftBodySpace2D(const godot::RID &p_space, ParallelFor p_parallel_for);

	WorldData &world() { return world_; }
	const WorldData &world() const { return world_; }
	const Simulator &simulator() const { return simulator_; }
	void apply_settings(const StepSettings &p_settings);
	bool is_empty() const { return nodes_.count() == 0 && joints_.empty() && fluids_.empty(); }
	/// All nodes, those without a body among them.
	NodeList<&SteppedNode::Places::all> &nodes() { return nodes_; }

	/// Number of bodies that were neither asleep nor disabled in the last step.
	int64_t awake_body_count() const { return int64_t(awake_.size()); }
	/// Of a node whose body bears its strain no more, while it finishes the step. It is torn after the step, or after a later
	/// one if there are too many.
	void note_overstretched(SteppedNode &r_node) { overstretched_.push_back(&r_node); }
	/// What bodies give up for the project's budget, from the next step on.
	void apply_budget(const BudgetLevels &p_levels);
	/// Number of bodies that took the last step as rigid ones.
	int64_t flying_body_count() const { return flying_count_; }
	/// Number of bodies that stand still for the budget.
	int64_t paused_body_count() const { return int64_t(paused_.count()); }
	/// Contacts solved in the last step, counted in every substep.
	int64_t contact_count() const { return contact_count_; }
	void set_reporting_islands(bool p_reports) { simulator_.set_reporting_islands(p_reports); }
	/// Of the last step: a dictionary for each island, as SoftBodySimulation2D.get_islands tells it.
	void list_islands(godot::TypedArray<godot::Dictionary> &r_islands) const;

	/// Adds a node, which takes part in ticks once it has a body.
	void add(SteppedNode &r_node) {
		nodes_.add(r_node);
		undrawn_.add(r_node);
	}
	/// Removes the node from all lists. Its body must have left the world.
	void remove(SteppedNode &r_node);
	/// Puts a node's body into the world.
	BodyId add_body(SteppedNode &r_node, SoftBodyData p_body);
	/// Has the node take part in the coming tick, though its body may rest. To be called for every change of the node or
	/// of its body.
	void note_change(SteppedNode &r_node) { busy_.add(r_node); }
	/// Has the node take part in the coming frame. To be called when its body has moved or is to look different.
	void note_look(SteppedNode &r_node) { undrawn_.add(r_node); }
	/// Before a frame is drawn: brings the nodes that have moved or changed to where they are in it. How many these are.
	int64_t draw(const DrawingFrame &p_frame);
	void add_joint(SteppedJoint &r_joint) { joints_.push_back(&r_joint); }
	void remove_joint(SteppedJoint &r_joint) { std::erase(joints_, &r_joint); }
	std::span<SteppedJoint *const> joints() const { return joints_; }
	/// Fluids push in the order in which they came.
	void add_fluid(SteppedFluid &r_fluid) { fluids_.push_back(&r_fluid); }
	void remove_fluid(SteppedFluid &r_fluid) { std::erase(fluids_, &r_fluid); }
	/// Reads gravity and environment, steps the core by `p_delta` [s], and hands the result to the nodes and to the
	/// rigid bodies of the engine. Sends the helpers of `p_threads` away before it asks the physics server anything more.
	/// Adds the signals of the step to `r_signals`, and its times to `r_profile`. A replay, whose signals are quiet, moves no body of
	/// the engine.
	void step(double p_delta, StepThreads &p_threads, StepSignals &r_signals, TickProfile &r_profile);

	// States of everything in the space: soft_body_space_2d_state.cpp.
	/// What determines the next steps, surroundings and properties of nodes aside. `p_base` as in `WorldState`; empty for none.
	Result<godot::PackedByteArray> save_state(const godot::PackedByteArray &p_base);
	/// Puts it back, or refuses it, by name, and changes nothing.
	Status restore_state(const godot::PackedByteArray &p_state, const godot::PackedByteArray &p_base);
	uint64_t hash_of_motion();

private:
	struct Owner {
		BodyId body;
		SteppedNode *node = nullptr;
	};

	void push_by_fluids(double p_delta);
	void prepare_joints();
	void collect_broken_joints(const StepReport &p_report, StepSignals &r_signals);
	void read_gravity();
	void feel_areas();
	void read_environment(double p_delta);
	void collect_signals(StepSignals &r_signals);
	void tell_proxies();
	void tell_riders();
	void move_proxies();
	void pause_unseen();
	void tear_overstretched(StepSignals &r_signals);
	void let_idle();
	/// The node of a body; null if the body has left the world.
	SteppedNode *node_of(BodyId p_body) const;
	SteppedNode *node_at(std::size_t p_index) const { return node_of(world_.id_at(p_index)); }
	WorldState::Companion companion();
	Status read_joints(StateReader &r_from, bool p_is_foreign, bool p_takes);

	godot::RID space_;
	WorldData world_;
	Simulator simulator_;
	EnvironmentReader reader_;
	AreaEffects space_effects_; ///< outside all areas
	std::vector<godot::RID> joined_; ///< bodies of the engine at the ends of joints
	NodeList<&SteppedNode::Places::all> nodes_;
	NodeList<&SteppedNode::Places::busy> busy_;
	NodeList<&SteppedNode::Places::near_moving> near_moving_; ///< whose proxies were told of moving bodies near them
	NodeList<&SteppedNode::Places::undrawn> undrawn_; ///< with something to do in the coming frame
	std::vector<Owner> owners_; ///< by the index of the body's id
	std::vector<SteppedJoint *> joints_;
	std::vector<SteppedFluid *> fluids_;
	std::vector<BodyId> awake_; ///< after the last step
	std::vector<Rider> riders_; ///< scratch memory of `tell_riders`
	std::vector<uint32_t> busy_rows_; ///< scratch memory of `read_environment`
	std::vector<BodyId> stirred_; ///< bodies at rest whose proxies the engine works out anew
	std::size_t next_look_ = 0; ///< place in `nodes_` of the next node at rest that looks at areas
	std::size_t look_credit_ = 0; ///< looks due, times LOOK_INTERVAL
	std::size_t urgent_looks_ = 0;
	int default_substeps_ = 0; ///< as the nodes know it
	Real character_mass_ = 0; ///< [kg]
	int detailed_count_ = 0; ///< proxies that show dents
	std::vector<SteppedNode *> overstretched_; ///< after this step, in the order of the nodes
	uint64_t turn_to_tear_ = 0; ///< tears looked for so far
	int most_tears_ = 0; ///< StepSettings::most_tears
	int64_t contact_count_ = 0;
	int64_t flying_count_ = 0;
	BudgetLevels budget_;
	bool has_rigid_flight_ = false; ///< StepSettings::rigid_flight
	NodeList<&SteppedNode::Places::paused> paused_; ///< for the budget
	std::vector<SteppedNode *> pausable_; ///< scratch memory of `pause_unseen`
	std::vector<IslandReport> islands_; ///< of the last step, if they are reported
	bool had_fluids_ = false; ///< at the last step
	uint64_t seen_restores_ = 0; ///< states restored before the last step
	uint64_t last_frame_ = UINT64_MAX; ///< of the engine's physics, at the last step
	WorldState state_;
	std::vector<uint8_t> saved_; ///< scratch memory of `save_state`
	uint64_t token_ = 0; ///< WorldState::Companion::world_token
};

} // namespace softbody
