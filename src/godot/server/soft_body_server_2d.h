// SPDX-License-Identifier: MIT
// The singleton that steps every soft body once a physics tick.
#pragma once

#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/classes/object.hpp>
#include <godot_cpp/classes/scene_tree.hpp>
#include <godot_cpp/variant/rid.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace godot {

/// Owns one `SoftBodySpace2D` for each `World2D` in use. It steps on the scene tree's
/// `physics_frame` signal: after Godot's own physics of the previous tick has been read back and
/// before any `_physics_process`, which is when a RigidBody2D's new transform appears, too.
class SoftBodyServer2D : public Object {
	GDCLASS(SoftBodyServer2D, Object)

public:
	static SoftBodyServer2D *get_singleton();

	SoftBodyServer2D();
	~SoftBodyServer2D();

	/// Registers a node with the space of its World2D and returns that space's world.
	softbody::SoftBodySpace2D *add_body(SoftBody2D *p_node);
	void remove_body(SoftBody2D *p_node);

	int64_t get_body_count() const;
	int64_t get_tick_count() const;
	double get_last_step_usec() const;
	double get_mean_step_usec() const;
	void reset_statistics();
	double measure_max_penetration() const;

protected:
	static void _bind_methods();

private:
	struct Space {
		RID rid;
		std::unique_ptr<softbody::SoftBodySpace2D> content;
	};

	void step();
	void watch(SceneTree *p_tree);

	std::vector<Space> spaces_;
	uint64_t watched_tree_ = 0; ///< instance id of the tree whose ticks step the spaces
	int64_t tick_count_ = 0;
	double last_step_usec_ = 0;
	double total_step_usec_ = 0;
	int64_t counted_steps_ = 0;
};

} // namespace godot
