// SPDX-License-Identifier: MIT
// The active bodies of a world as a step goes through them: one after the other in active indices, and side by side in batches.
#pragma once

#include "core/base/pack.h"
#include "core/collision/pair_contact_solver.h"
#include "core/dynamics/batch_builder.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Where a batch's bodies stand among the active indices, how they are stepped, and which of them take part.
struct BatchState {
	static constexpr std::uint32_t NO_OWN_PLANS = UINT32_MAX;

	SubstepPlan plan;
	std::array<std::uint32_t, PACK_WIDTH> active_indices{};
	std::uint32_t awake = 0; ///< a bit a lane
	std::uint32_t coupled = 0; ///< likewise: who takes contact substeps, with the rest of a island
	std::uint32_t active_mask = ALL_LANES; ///< likewise: who takes part in the present pass
	std::uint32_t kind = 0; ///< the same for batches in a sequence that `move_alike`
	std::uint32_t own_plans = NO_OWN_PLANS; ///< which of `ActiveBodies`, where lanes differ in this step

	std::uint32_t stepped() const { return awake & active_mask; }
	bool has_own_plans() const { return own_plans != NO_OWN_PLANS; }
};

/// Keeps active indices and batches, which hold until bodies are rearranged, the time step changes or the first surroundings appear.
/// A active index is a body's body index among the active ones, in the order of the world whatever the batches: pairs go by it.
class ActiveBodies {
public:
	/// `world` must outlive the object.
	explicit ActiveBodies(WorldData &world) : world_(world) {}

	/// Brings all up to date for a step of `dt` [s]. True when something was arranged anew; then all count as awake.
	/// O(1) where nothing has changed, else O(bodies).
	bool update(Real dt);
	/// Moves when a active index may mean another body than before.
	std::uint64_t version() const { return batch_builder_.version(); }
	/// Plans of bodies under pressure: on a stretched hull it needs more substeps than at rest, so that bodies of one batch
	/// may differ from step to step. O(bodies with pressure).
	void plan_pressure(Real dt);

	// Rows.
	std::uint32_t count() const { return std::uint32_t(solver_bodies_.size()); }
	/// Places in the world, ascending; one a active index.
	std::span<const std::uint32_t> body_indices() const { return body_indices_; }
	/// As those who solve contacts between bodies see them; one a active index.
	std::span<SolverBody> solver_bodies() { return solver_bodies_; }
	SolverBody &solver_body(std::uint32_t active_index) { return solver_bodies_[active_index]; }
	const SolverBody &solver_body(std::uint32_t active_index) const { return solver_bodies_[active_index]; }
	SoftBodyData &data(std::uint32_t active_index) const { return world_.soft_bodies()[body_indices_[active_index]]; }
	/// Where the hull's points were when the body last had looked at the surroundings.
	std::span<Vec2> sweep_start(std::uint32_t active_index) { return { sweep_start_.data() + first_hull_point_[active_index], hull_count(active_index) }; }
	const Vec2 *sweep_start(std::uint32_t active_index) const { return sweep_start_.data() + first_hull_point_[active_index]; }
	std::size_t frozen_count() const { return frozen_count_; }
	bool has_monitored() const { return has_monitored_; }
	/// Whether any body collides with itself.
	bool meet_themselves() const { return meet_themselves_; }
	std::span<const std::uint32_t> inactive_bodies() const { return batch_builder_.inactive_bodies(); }

	// Batches.
	std::uint32_t batch_count() const { return std::uint32_t(batches_.size()); }
	Batch &batch(std::uint32_t i) { return batch_builder_.batches()[i]; }
	const Batch &batch(std::uint32_t i) const { return batch_builder_.batches()[i]; }
	BatchState &state(std::uint32_t i) { return batches_[i]; }
	const BatchState &state(std::uint32_t i) const { return batches_[i]; }
	/// What a body of a batch is stepped by.
	const SubstepPlan &plan_of(const BatchState &state, std::uint32_t lane) const {
		return state.has_own_plans() ? own_plans_[state.own_plans][lane] : state.plan;
	}
	/// Whether all bodies of both batches take part in the present pass, and move alike in it.
	bool move_alike_now(std::uint32_t a, std::uint32_t b) const {
		const BatchState &state_a = batches_[a];
		const BatchState &state_b = batches_[b];
		return state_a.kind == state_b.kind && (state_a.stepped() & state_b.stepped()) == ALL_LANES &&
				!state_a.has_own_plans() && !state_b.has_own_plans() && state_a.plan.substeps == state_b.plan.substeps &&
				state_a.plan.integrator == state_b.plan.integrator;
	}

	/// A body has fallen asleep, where it stays without any velocity or memory of touches, or has woken.
	void note_awake(std::uint32_t active_index, bool awake);

private:
	std::size_t hull_count(std::uint32_t active_index) const { return solver_bodies_[active_index].before.size(); }
	void add_body(std::uint32_t body_index);
	void add_batch(const Batch &batch, Real dt);

	WorldData &world_;
	BatchBuilder batch_builder_;
	// One a active index.
	std::vector<SolverBody> solver_bodies_;
	std::vector<std::uint32_t> body_indices_;
	std::vector<std::uint32_t> batch_of_;
	std::vector<std::size_t> first_hull_point_; ///< in the next two
	std::vector<Vec2> before_; ///< hull points of all bodies at the start of a contact substep
	std::vector<Vec2> sweep_start_;
	// One a batch.
	std::vector<BatchState> batches_;
	std::vector<std::array<SubstepPlan, PACK_WIDTH>> own_plans_;
	std::vector<std::uint32_t> pressed_batches_; ///< those with pressure
	std::vector<std::uint32_t> active_index_of_; ///< of every body index in the world
	std::size_t frozen_count_ = 0;
	bool has_monitored_ = false;
	bool meet_themselves_ = false;

	std::uint64_t arranged_batch_builder_ = 0;
	Real arranged_dt_ = 0;
	bool arranged_with_contacts_ = false;
};

} // namespace softbody
