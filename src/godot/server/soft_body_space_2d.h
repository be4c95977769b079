// SPDX-License-Identifier: MIT
// All soft bodies of one physics space, stepped together once a physics tick.
#pragma once

#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"
#include "godot/server/step_settings.h"
#include "godot/surroundings/area_effects.h"
#include "godot/surroundings/environment_reader.h"

#include <godot_cpp/variant/rid.hpp>

#include <vector>

namespace godot {
class SoftBody2D;
class SoftBodyJoint2D;
}

namespace softbody {

class BodySignals;

/// Time of the parts of a step [µs].
struct TickProfile {
	double prepare = 0; ///< taking over changes of users
	double surroundings = 0; ///< reading the environment near bodies
	double simulate = 0; ///< in the core
	double finish = 0; ///< moving nodes along
	double proxies = 0; ///< showing the hulls to the engine

	TickProfile &operator+=(const TickProfile &p_other);
};

/// Joins the core's world of one `World2D` with the nodes of its bodies.
class SoftBodySpace2D {
public:
	/// `p_space` is the space of a `World2D` and must outlive this object. `p_parallel_for` divides the work of a step.
	SoftBodySpace2D(const godot::RID &p_space, ParallelFor p_parallel_for);

	WorldData &world() { return world_; }
	const WorldData &world() const { return world_; }
	const Simulator &simulator() const { return simulator_; }
	void apply_settings(const StepSettings &p_settings);
	bool is_empty() const { return body_count_ == 0 && joints_.empty(); }
	int64_t body_count() const { return body_count_; }
	/// An entry is null if its node has left during the present step.
	const std::vector<godot::SoftBody2D *> &nodes() const { return nodes_; }

	/// Number of bodies that were neither asleep nor disabled in the last step.
	int64_t awake_body_count() const { return awake_body_count_; }
	/// Contacts solved in the last step, counted in every substep.
	int64_t contact_count() const { return contact_count_; }
	/// Times of the last step.
	const TickProfile &profile() const { return profile_; }

	void add(godot::SoftBody2D *p_node);
	void remove(godot::SoftBody2D *p_node);
	void add_joint(godot::SoftBodyJoint2D *p_node);
	void remove_joint(godot::SoftBodyJoint2D *p_node);
	/// Reads gravity and environment, steps the core by `p_delta` [s], and hands the result to the nodes and to the
	/// rigid bodies of the engine. Adds the signals of the step to `r_signals`.
	void step(double p_delta, BodySignals &r_signals);

private:
	/// Calls `p_work(node)` for the present nodes. Nodes that it removes are skipped; nodes that it adds wait.
	template <class Work>
	void for_nodes(const Work &p_work) {
		const size_t count = nodes_.size();
		for (size_t i = 0; i < count; i++) {
			if (nodes_[i] != nullptr) {
				p_work(*nodes_[i]);
			}
		}
	}
	void close_gaps();
	void collect_broken_joints(const StepReport &p_report, BodySignals &r_signals);
	int64_t count_awake() const;
	void read_gravity();
	void read_environment(double p_delta);
	void collect_signals(BodySignals &r_signals);
	void tell_proxies();
	void move_proxies();
	godot::SoftBody2D *node_of(BodyId p_id) const;

	godot::RID space_;
	WorldData world_;
	Simulator simulator_;
	EnvironmentReader reader_;
	AreaEffects space_effects_; ///< outside all areas
	std::vector<godot::RID> joined_; ///< bodies of the engine at the ends of joints
	uint64_t tick_ = 0;
	std::vector<godot::SoftBody2D *> nodes_;
	std::vector<godot::SoftBodyJoint2D *> joints_;
	int default_substeps_ = 0; ///< as the nodes know it
	int64_t body_count_ = 0; ///< nodes that are not null
	bool stepping_ = false;
	int64_t awake_body_count_ = 0;
	int64_t contact_count_ = 0;
	TickProfile profile_;
};

} // namespace softbody
