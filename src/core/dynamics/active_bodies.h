// SPDX-License-Identifier: MIT
// The active bodies of a world: their data for a step, which are awake, and which share a batch.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/pair_contact_solver.h"
#include "core/dynamics/batch.h"
#include "core/dynamics/state_prefetch.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// The list of active bodies, in the order of the world. It is rebuilt when bodies are added, removed or changed, when
/// the time step changes, and when the environment appears or disappears. The index of a body in this list is its
/// active index. A body is awake, asleep or frozen; a step stores that only here.
class ActiveBodies {
public:
	/// `world` must outlive the object.
	explicit ActiveBodies(WorldData &world) : world_(world) {}

	/// Updates the list for a step of `dt` [s]. Returns true if it was rebuilt; then all bodies count as awake. O(1)
	/// without changes, else O(bodies).
	bool update(Real dt);
	/// Grows when an active index may belong to another body than before.
	std::uint64_t version() const { return version_; }
	/// Updates the substep plans of bodies under pressure: a stretched hull needs more substeps than one at rest.
	/// O(bodies with pressure).
	void plan_pressure(Real dt);

	/// Chooses the plans of the `listed` bodies for this step, by whether each is near its rest shape (plan_near_rest).
	/// O(points of bodies whose two plans differ).
	void plan_near_rest_shapes(std::span<const std::uint32_t> listed, const ParallelFor &parallel_for);

	std::uint32_t count() const { return std::uint32_t(solver_bodies_.size()); }
	/// Indices into `WorldData::soft_bodies()`, ascending; one for each active index.
	std::span<const std::uint32_t> body_indices() const { return body_indices_; }
	/// Indices into `WorldData::soft_bodies()` of the bodies that are not active, ascending.
	std::span<const std::uint32_t> inactive_bodies() const { return inactive_bodies_; }
	/// Views of the bodies for contacts between bodies, by active index.
	std::span<SolverBody> solver_bodies() { return solver_bodies_; }
	SolverBody &solver_body(std::uint32_t active_index) { return solver_bodies_[active_index]; }
	const SolverBody &solver_body(std::uint32_t active_index) const { return solver_bodies_[active_index]; }
	SoftBodyData &data(std::uint32_t active_index) const { return world_.soft_bodies()[body_indices_[active_index]]; }
	/// Integrator and substeps of the body.
	const SubstepPlan &plan(std::uint32_t active_index) const { return plans_[plan_of_[active_index]]; }
	/// Hull points of the body when its contacts with colliders were last solved.
	std::span<Vec2> sweep_start(std::uint32_t active_index) {
		return { sweep_start_.data() + first_hull_point_[active_index], solver_bodies_[active_index].before.size() };
	}
	/// Whether the body may have a touch (TouchMemory) with a bouncing surface.
	char &has_touch(std::uint32_t active_index) { return has_touch_[active_index]; }
	bool has_monitored() const { return has_monitored_; }
	/// Whether any body collides with itself.
	bool has_self_collision() const { return has_self_collision_; }

	/// Active indices of the awake bodies, those that may share batches one after the other. O(1), or O(bodies) after a
	/// change.
	std::span<const std::uint32_t> awake();
	/// One entry for each active index; not 0 for a sleeping or frozen body.
	std::span<const char> resting() const { return resting_; }
	bool is_resting(std::uint32_t active_index) const { return resting_[active_index] != 0; }
	std::size_t resting_count() const { return resting_count_; }
	std::size_t frozen_count() const { return frozen_count_; }
	/// Puts a body to rest, which clears its velocities and its memory of touches, or makes it awake. For a body that
	/// rests already, the extent is measured again.
	void set_resting(std::uint32_t active_index, bool resting);

	/// Batch of the first bodies of a list, ordered as `awake`, that can share one in a step of `parts` equal slices
	/// (`substeps_in_slice`). Precondition: `list` is not empty.
	Batch batch_at(std::span<const std::uint32_t> list, int parts = 1) const;
	/// Adds the first `bodies` of a list (at most WIDE_WIDTH) to `prefetch`.
	void prefetch(std::span<const std::uint32_t> list, std::size_t bodies, StatePrefetch &prefetch) const;

private:
	/// Bodies of one kind have one shape and equal settings. Kinds of one family may share batches, unless `single`.
	struct Kind {
		const SoftBodyShape *shape = nullptr;
		const BodySettings *settings = nullptr;
		std::uint32_t family = 0;
		bool single = false;
	};
	class KindFinder;

	void add_body(std::uint32_t body_index, KindFinder &finder, Real dt);
	void order_kinds();
	bool is_alike(std::uint32_t a, std::uint32_t b, int parts) const;

	WorldData &world_;
	// One entry for each active index.
	std::vector<SolverBody> solver_bodies_;
	std::vector<std::uint32_t> body_indices_;
	std::vector<std::uint32_t> kind_of_;
	std::vector<std::uint32_t> plan_of_;
	std::vector<Vec2 *> states_;
	std::vector<char> has_touch_;
	std::vector<char> resting_;
	std::vector<std::size_t> first_hull_point_; ///< index into the next two arrays
	std::vector<Vec2> before_; ///< hull points of all bodies at the start of a contact substep
	std::vector<Vec2> sweep_start_;

	std::vector<Kind> kinds_;
	std::vector<SubstepPlan> plans_; ///< one for each kind, then one near rest for each kind, then one for each body under pressure
	std::vector<std::uint32_t> pressed_; ///< bodies under pressure
	std::vector<std::uint32_t> row_of_kind_; ///< place among the rows of `awake_`; of one family those with like plans share a row
	std::uint32_t row_count_ = 0;
	std::vector<std::uint32_t> awake_; ///< empty while out of date
	std::vector<std::uint32_t> starts_; ///< scratch memory of `awake`
	std::vector<std::uint32_t> inactive_bodies_;
	std::size_t resting_count_ = 0;
	std::size_t frozen_count_ = 0;
	bool has_monitored_ = false;
	bool has_self_collision_ = false;
	bool awake_is_current_ = false;

	std::uint64_t version_ = 0;
	std::uint64_t arrangement_ = 0;
	Real dt_ = 0;
	bool with_contacts_ = false;
};

} // namespace softbody
