// SPDX-License-Identifier: MIT
// The active bodies of a world as a step goes through them: one after the other in rows, and side by side in crews.
#pragma once

#include "core/base/pack.h"
#include "core/collision/pair_handling.h"
#include "core/dynamics/roster.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/world_data.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Where a crew's bodies stand among the rows, how they are stepped, and which of them take part.
struct CrewState {
	static constexpr std::uint32_t NO_OWN_PLANS = UINT32_MAX;

	SubstepPlan plan;
	std::array<std::uint32_t, PACK_WIDTH> rows{};
	std::uint32_t awake = 0; ///< a bit a lane
	std::uint32_t coupled = 0; ///< likewise: who takes contact substeps, with the rest of a heap
	std::uint32_t turn = ALL_LANES; ///< likewise: who takes part in the present pass
	std::uint32_t kind = 0; ///< the same for crews in a row that `move_alike`
	std::uint32_t own_plans = NO_OWN_PLANS; ///< which of `ActiveBodies`, where lanes differ in this step

	std::uint32_t stepped() const { return awake & turn; }
	bool has_own_plans() const { return own_plans != NO_OWN_PLANS; }
};

/// Keeps rows and crews, which hold until bodies are rearranged, the time step changes or the first surroundings appear.
/// A row is a body's place among the active ones, in the order of the world whatever the crews: pairs go by it.
class ActiveBodies {
public:
	/// `world` must outlive the object.
	explicit ActiveBodies(WorldData &world) : world_(world) {}

	/// Brings all up to date for a step of `dt` [s]. True when something was arranged anew; then all count as awake.
	/// O(1) where nothing has changed, else O(bodies).
	bool update(Real dt);
	/// Moves when a row may mean another body than before.
	std::uint64_t version() const { return roster_.version(); }
	/// Plans of bodies under pressure: on a stretched hull it needs more substeps than at rest, so that bodies of one crew
	/// may differ from step to step. O(bodies with pressure).
	void plan_pressure(Real dt);

	// Rows.
	std::uint32_t count() const { return std::uint32_t(touching_.size()); }
	/// Places in the world, ascending; one a row.
	std::span<const std::uint32_t> places() const { return places_; }
	/// As those who answer contacts between bodies see them; one a row.
	std::span<TouchingBody> touching() { return touching_; }
	TouchingBody &touching(std::uint32_t row) { return touching_[row]; }
	const TouchingBody &touching(std::uint32_t row) const { return touching_[row]; }
	SoftBodyData &data(std::uint32_t row) const { return world_.soft_bodies()[places_[row]]; }
	/// Where the hull's points were when the body last had looked at the surroundings.
	std::span<Vec2> swept_from(std::uint32_t row) { return { swept_from_.data() + first_hull_point_[row], hull_count(row) }; }
	const Vec2 *swept_from(std::uint32_t row) const { return swept_from_.data() + first_hull_point_[row]; }
	std::size_t frozen_count() const { return frozen_count_; }
	bool has_monitored() const { return has_monitored_; }
	/// Whether any body collides with itself.
	bool meet_themselves() const { return meet_themselves_; }
	std::span<const std::uint32_t> inactive_places() const { return roster_.inactive_bodies(); }

	// Crews.
	std::uint32_t crew_count() const { return std::uint32_t(crews_.size()); }
	Crew &crew(std::uint32_t i) { return roster_.crews()[i]; }
	const Crew &crew(std::uint32_t i) const { return roster_.crews()[i]; }
	CrewState &state(std::uint32_t i) { return crews_[i]; }
	const CrewState &state(std::uint32_t i) const { return crews_[i]; }
	/// What a body of a crew is stepped by.
	const SubstepPlan &plan_of(const CrewState &state, std::uint32_t lane) const {
		return state.has_own_plans() ? own_plans_[state.own_plans][lane] : state.plan;
	}
	/// Whether all bodies of both crews take part in the present pass, and move alike in it.
	bool move_alike_now(std::uint32_t a, std::uint32_t b) const {
		const CrewState &state_a = crews_[a];
		const CrewState &state_b = crews_[b];
		return state_a.kind == state_b.kind && (state_a.stepped() & state_b.stepped()) == ALL_LANES &&
				!state_a.has_own_plans() && !state_b.has_own_plans() && state_a.plan.substeps == state_b.plan.substeps &&
				state_a.plan.integrator == state_b.plan.integrator;
	}

	/// A body has fallen asleep, where it stays without any velocity or memory of touches, or has woken.
	void note_awake(std::uint32_t row, bool awake);

private:
	std::size_t hull_count(std::uint32_t row) const { return touching_[row].before.size(); }
	void add_row(std::uint32_t place);
	void add_crew(const Crew &crew, Real dt);

	WorldData &world_;
	Roster roster_;
	// One a row.
	std::vector<TouchingBody> touching_;
	std::vector<std::uint32_t> places_;
	std::vector<std::uint32_t> crew_of_;
	std::vector<std::size_t> first_hull_point_; ///< in the next two
	std::vector<Vec2> before_; ///< hull points of all bodies at the start of a contact substep
	std::vector<Vec2> swept_from_;
	// One a crew.
	std::vector<CrewState> crews_;
	std::vector<std::array<SubstepPlan, PACK_WIDTH>> own_plans_;
	std::vector<std::uint32_t> pressed_crews_; ///< those with pressure
	std::vector<std::uint32_t> row_of_; ///< of every place in the world
	std::size_t frozen_count_ = 0;
	bool has_monitored_ = false;
	bool meet_themselves_ = false;

	std::uint64_t arranged_roster_ = 0;
	Real arranged_dt_ = 0;
	bool arranged_with_contacts_ = false;
};

} // namespace softbody
