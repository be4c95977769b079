// SPDX-License-Identifier: MIT
// The singleton that steps every soft body once a physics tick.
#pragma once

#include "godot/drawing/drawing_frame.h"
#include "godot/server/late_work.h"
#include "godot/server/soft_body_space_2d.h"
#include "godot/server/step_settings.h"
#include "godot/server/step_signals.h"
#include "godot/server/step_threads.h"

#include <godot_cpp/classes/canvas_item.hpp>
#include <godot_cpp/classes/node2d.hpp>
#include <godot_cpp/classes/object.hpp>
#include <godot_cpp/classes/physics_shape_query_parameters2d.hpp>
#include <godot_cpp/classes/scene_tree.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace godot {

/// Owns one `SoftBodySpace2D` for each `World2D` in use. It steps on the scene tree's `physics_frame` signal: after
/// Godot's own physics of the previous tick has been read back and before any `_physics_process`, when a RigidBody2D's
/// new transform appears, too.
class SoftBodySimulation2D : public Object {
	GDCLASS(SoftBodySimulation2D, Object)

public:
	static SoftBodySimulation2D *get_singleton();

	SoftBodySimulation2D();
	~SoftBodySimulation2D();

	/// The space of the node's World2D, made on first use. The node must then be added to it.
	softbody::SoftBodySpace2D &space_of(const CanvasItem *p_node);
	/// To be called after a node or joint has been removed from its space: drops spaces that have none left.
	void drop_empty_spaces();

	/// Whether nodes are being stepped now. Code of the user may run meanwhile, as nodes are moved.
	bool is_stepping() const { return stepping_; }
	/// Calls `p_emit` after the present step, or else after the next one, if the object `p_sender` then still exists.
	void after_step(uint64_t p_sender, std::function<void()> p_emit) { signals_.add(p_sender, std::move(p_emit)); }
	softbody::LateWork &late_work() { return late_work_; }

	/// Settings of the project's soft bodies, as last read.
	const softbody::StepSettings &settings() const { return settings_; }
	/// The state of the frame that nodes need for drawing.
	softbody::DrawingFrame &drawing() { return drawing_; }
	const softbody::DrawingFrame &drawing() const { return drawing_; }

	int64_t get_body_count() const;
	int64_t get_awake_body_count() const;
	int64_t get_contact_count() const;
	int64_t get_rigid_flight_count() const;
	Dictionary get_budget_report() const;
	int64_t get_built_shape_count() const;
	int get_thread_count() const { return threads_.get_thread_count(); }
	int64_t get_tick_count() const { return tick_count_; }
	double get_last_step_usec() const { return last_step_usec_; }
	double get_mean_step_usec() const;
	double get_last_drawing_usec() const { return last_drawing_usec_; }
	int64_t get_last_drawn_count() const { return last_drawn_count_; }
	/// Every soft body of the world that overlaps the shape, each once; of the first tree's own world for null.
	TypedArray<Node2D> intersect_shape(const Ref<PhysicsShapeQueryParameters2D> &p_parameters, const Ref<World2D> &p_world) const;
	void reset_statistics();

	// Spaces by hand: soft_body_simulation_2d_state.cpp. A space is that of a World2D.
	void set_automatic_stepping(const RID &p_space, bool p_enabled);
	bool is_automatic_stepping(const RID &p_space) const;
	/// Steps one space now. A replay tells listeners nothing and pushes no body of the engine.
	Error step(const RID &p_space, double p_delta, bool p_is_replay);
	PackedByteArray save_state(const RID &p_space, const PackedByteArray &p_base);
	Error restore_state(const RID &p_space, const PackedByteArray &p_state, const PackedByteArray &p_base);
	int64_t hash_state(const RID &p_space) const;
	Dictionary get_step_profile() const;
	double measure_max_penetration() const;
	/// Whether each step measures its islands, in all spaces.
	void set_reporting_islands(bool p_reports);
	bool is_reporting_islands() const { return reports_islands_; }
	TypedArray<Dictionary> get_islands() const;

protected:
	static void _bind_methods();

private:
	struct Space {
		RID rid;
		std::unique_ptr<softbody::SoftBodySpace2D> content;
	};

	template <class Count>
	int64_t count_in_spaces(const Count &p_count) const;
	/// Null for a space without soft bodies.
	softbody::SoftBodySpace2D *find_space(const RID &p_space) const;
	/// What keeps a space from being stepped, saved or restored now; empty if nothing does.
	String find_problem(const RID &p_space) const;
	static void bind_state_methods();
	void step_all();
	void step_spaces(double p_delta);
	void draw_frame();
	void draw_idle_frame();
	void watch(SceneTree *p_tree);
	void read_settings();
	void add_monitors();

	softbody::StepSettings settings_;
	bool settings_known_ = false;
	softbody::StepThreads threads_; ///< before the spaces, whose simulators use them
	std::vector<Space> spaces_;
	std::vector<RID> by_hand_; ///< spaces that ticks do not step
	softbody::StepSignals signals_;
	softbody::LateWork late_work_;
	bool stepping_ = false; ///< while nodes may come and go, but no space may
	uint64_t watched_tree_ = 0; ///< instance id of the tree whose ticks step the spaces
	int64_t tick_count_ = 0;
	double last_step_usec_ = 0;
	softbody::StepBudget budget_;
	softbody::TickProfile profile_; ///< summed since the last reset
	double total_step_usec_ = 0;
	int64_t counted_steps_ = 0;
	softbody::DrawingFrame drawing_;
	double last_drawing_usec_ = 0;
	int64_t last_drawn_count_ = 0;
	bool reports_islands_ = false;
};

} // namespace godot
