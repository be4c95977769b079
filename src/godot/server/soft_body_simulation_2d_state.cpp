// SPDX-License-Identifier: MIT
// Spaces that a game steps, saves and restores by itself.
#include "godot/server/soft_body_simulation_2d.h"

#include "godot/convert.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/core/math.hpp>

#include <algorithm>

using softbody::to_godot;

namespace godot {

void SoftBodySimulation2D::set_automatic_stepping(const RID &p_space, bool p_enabled) {
	ERR_FAIL_COND_MSG(!p_space.is_valid(), "SoftBodySimulation2D.set_automatic_stepping: the space must be that of a World2D; give get_world_2d().space.");
	std::erase(by_hand_, p_space);
	if (!p_enabled) {
		by_hand_.push_back(p_space);
	}
}

bool SoftBodySimulation2D::is_automatic_stepping(const RID &p_space) const {
	return std::ranges::find(by_hand_, p_space) == by_hand_.end();
}

String SoftBodySimulation2D::find_problem(const RID &p_space) const {
	if (!p_space.is_valid()) {
		return "the space must be that of a World2D; give get_world_2d().space.";
	}
	if (stepping_) {
		return "a step is under way; call it between steps, such as in _physics_process or in a signal of a body.";
	}
	return String();
}

Error SoftBodySimulation2D::step(const RID &p_space, double p_delta, bool p_is_replay) {
	const String problem = find_problem(p_space);
	ERR_FAIL_COND_V_MSG(!problem.is_empty(), ERR_INVALID_PARAMETER, "SoftBodySimulation2D.step: " + problem);
	ERR_FAIL_COND_V_MSG(!Math::is_finite(p_delta) || p_delta <= 0, ERR_INVALID_PARAMETER, "SoftBodySimulation2D.step: delta = " + rtos(p_delta) + " must be finite and above 0 s; give the length of a tick.");
	softbody::SoftBodySpace2D *space = find_space(p_space);
	if (space == nullptr) {
		return OK; // nothing to move
	}
	softbody::StepSignals quiet(true);
	space->apply_budget({}); // what a measured time decides would differ from run to run
	stepping_ = true;
	space->step(p_delta, threads_, p_is_replay ? quiet : signals_, profile_);
	stepping_ = false;
	drop_empty_spaces();
	if (!p_is_replay) {
		signals_.emit(); // last: listeners may free nodes, and with them spaces
	}
	return OK;
}

PackedByteArray SoftBodySimulation2D::save_state(const RID &p_space, const PackedByteArray &p_base) {
	const String problem = find_problem(p_space);
	ERR_FAIL_COND_V_MSG(!problem.is_empty(), {}, "SoftBodySimulation2D.save_state: " + problem);
	softbody::SoftBodySpace2D *space = find_space(p_space);
	ERR_FAIL_NULL_V_MSG(space, {}, "SoftBodySimulation2D.save_state: the world has no soft body yet; add one to the scene tree first.");
	auto state = space->save_state(p_base);
	ERR_FAIL_COND_V_MSG(!state, {}, "SoftBodySimulation2D.save_state: " + to_godot(state.error()) + ".");
	return state.value();
}

Error SoftBodySimulation2D::restore_state(const RID &p_space, const PackedByteArray &p_state, const PackedByteArray &p_base) {
	const String problem = find_problem(p_space);
	ERR_FAIL_COND_V_MSG(!problem.is_empty(), ERR_INVALID_PARAMETER, "SoftBodySimulation2D.restore_state: " + problem);
	softbody::SoftBodySpace2D *space = find_space(p_space);
	ERR_FAIL_NULL_V_MSG(space, ERR_UNCONFIGURED, "SoftBodySimulation2D.restore_state: the world has no soft body yet; add those of the state first.");
	const softbody::Status refused = space->restore_state(p_state, p_base);
	ERR_FAIL_COND_V_MSG(refused, ERR_INVALID_DATA, "SoftBodySimulation2D.restore_state refused: " + to_godot(*refused) + ". The world goes on as it was.");
	return OK;
}

int64_t SoftBodySimulation2D::hash_state(const RID &p_space) const {
	const String problem = find_problem(p_space);
	ERR_FAIL_COND_V_MSG(!problem.is_empty(), 0, "SoftBodySimulation2D.hash_state: " + problem);
	softbody::SoftBodySpace2D *space = find_space(p_space);
	return space != nullptr ? int64_t(space->hash_of_motion()) : 0;
}

void SoftBodySimulation2D::bind_state_methods() {
	ClassDB::bind_method(D_METHOD("set_automatic_stepping", "space", "enabled"), &SoftBodySimulation2D::set_automatic_stepping);
	ClassDB::bind_method(D_METHOD("is_automatic_stepping", "space"), &SoftBodySimulation2D::is_automatic_stepping);
	ClassDB::bind_method(D_METHOD("step", "space", "delta", "is_replay"), &SoftBodySimulation2D::step, DEFVAL(false));
	ClassDB::bind_method(D_METHOD("save_state", "space", "base"), &SoftBodySimulation2D::save_state, DEFVAL(PackedByteArray()));
	ClassDB::bind_method(D_METHOD("restore_state", "space", "state", "base"), &SoftBodySimulation2D::restore_state, DEFVAL(PackedByteArray()));
	ClassDB::bind_method(D_METHOD("hash_state", "space"), &SoftBodySimulation2D::hash_state);
}

} // namespace godot
