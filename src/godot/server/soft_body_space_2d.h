// SPDX-License-Identifier: MIT
// All soft bodies of one physics space, stepped together once a physics tick.
#pragma once

#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"
#include "godot/surroundings/surroundings_reader.h"

#include <godot_cpp/variant/rid.hpp>

#include <vector>

namespace godot {
class SoftBody2D;
}

namespace softbody {

/// Joins the core's world of one `World2D` with the nodes that stand for its bodies.
class SoftBodySpace2D {
public:
	/// `p_space` is the space of a `World2D` and must outlive this object.
	explicit SoftBodySpace2D(const godot::RID &p_space);

	WorldData &world() { return world_; }
	const WorldData &world() const { return world_; }
	const Simulator &simulator() const { return simulator_; }
	bool is_empty() const { return nodes_.empty(); }
	const std::vector<godot::SoftBody2D *> &nodes() const { return nodes_; }

	void add(godot::SoftBody2D *p_node);
	void remove(godot::SoftBody2D *p_node);
	/// Reads gravity and surroundings, steps the core by `p_delta` [s], hands the result to the nodes.
	void step(double p_delta);

private:
	void read_gravity();
	void read_surroundings(double p_delta);
	godot::SoftBody2D *node_of(BodyId p_id) const;

	godot::RID space_;
	WorldData world_;
	Simulator simulator_{ world_ };
	SurroundingsReader reader_;
	std::vector<godot::SoftBody2D *> nodes_;
};

} // namespace softbody
