// SPDX-License-Identifier: MIT
// A time slice of bodies side by side, for any number of lanes. Included where it is instantiated.
#pragma once

#include "core/collision/extent_lanes.h"
#include "core/collision/surface_constraint_lanes.h"
#include "core/dynamics/area_lanes.h"
#include "core/dynamics/body_reset.h"
#include "core/dynamics/forces_lanes.h"
#include "core/dynamics/integrators/lane_steps.h"
#include "core/dynamics/lane_stepper.h"
#include "core/dynamics/rigid_damping_lanes.h"
#include "core/dynamics/rigid_flight_lanes.h"
#include "core/dynamics/shape_limits_lanes.h"
#include "core/dynamics/state_lanes.h"
#include "core/model/body_frame_lanes.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace softbody {

/// Ends a substep of `h` [s] but for its contacts, which act last and sweep the whole path: area, limits and damping.
/// Returns for which lanes the forces found before still hold; damping changes none of a body without pins. `scratch`
/// has room for the positions and velocities of one body, unless T is `Real`.
template <class T>
MaskOf<T> keep_shape(const BodyLanes<T> &bodies, Real h, bool bears_load, std::span<Vec2> scratch) {
	const BodySettings &settings = bodies.model.settings;
	MaskOf<T> still_hold = T(0) < T(1);
	if (holds_area(bodies.model.shape, settings)) {
		hold_area<T>(bodies, h);
		still_hold = !still_hold;
	}
	if (settings.has_limits()) {
		still_hold = both(still_hold, !keep_whole_in_lanes<T>(bodies, h, bears_load, scratch));
	}
	if (settings.has_damp()) {
		damp_rigid_motion<T>(bodies, h);
	}
	return still_hold;
}

template <class T>
class BasicLaneStepper final : public LaneStepper {
public:
	LaneResult advance(const LaneSlice &slice, StatePrefetch &prefetch) override;
	FlightResult fly(const FlightSlice &slice, FlightGate &gate) override;
	void measure_frames(const Batch &batch, std::span<BodyFrame> frames) override;

private:
	using Lanes = std::array<Vec2 *, WIDE_WIDTH>;

	static Lanes velocities_of(const Batch &batch);
	/// Loads a batch into lanes, in scratch memory that the next call overwrites.
	BodyLanes<T> load(const Batch &batch, StatePrefetch &prefetch);
	void store(const BodyLanes<T> &bodies, const Batch &batch) const;
	/// Solves the contacts of a substep. Returns the number of contacts of each lane.
	T solve_contacts(const BodyLanes<T> &bodies, const LaneSlice &slice);
	T solve_borders(const BodyLanes<T> &bodies, const LaneSlice &slice);
	void follow_bounces(const BodyLanes<T> &bodies, const BasicContactLoad<T> &load, const LaneSlice &slice);
	static void hand_out_motion(const BasicTranslation<T> &motion, const LaneSlice &slice);
	void hand_out_extents(std::span<const BasicVec2<T>> hull, const LaneSlice &slice) const;

	BasicWorkspace<T> workspace_;
	std::vector<BasicVec2<T>> positions_;
	std::vector<BasicVec2<T>> velocities_;
	std::vector<BasicVec2<T>> before_; ///< hull points at the start
	std::uint32_t touching_ = 0; ///< bit mask of the lanes with a touch to follow
	std::vector<BasicPointSolution<T>> solutions_; ///< of a border, at the hull points of monitored bodies
};

template <class T>
LaneResult BasicLaneStepper<T>::advance(const LaneSlice &slice, StatePrefetch &prefetch) {
	const Batch &batch = *slice.batch;
	const BodyLanes<T> bodies = load(batch, prefetch);
	workspace_.begin_body(bodies.positions.size());
	const std::size_t hull_count = slice.solver_bodies[0] != nullptr ? batch.shape->hull_count() : 0;
	before_.assign(positions_.begin(), positions_.begin() + std::ptrdiff_t(hull_count));
	if (slice.pairs_bounce) {
		hand_out_motion(measure_translation<T>(*batch.shape, bodies.positions, bodies.velocities), slice);
	}
	const LaneStep<T> step = LANE_STEPS<T>[std::size_t(batch.plan->integrator)];
	T all_contacts(0);
	touching_ = slice.touching;
	for (int i = 0; i < slice.substeps; ++i) {
		prefetch.ask(2);
		step(bodies, { slice.gravity, {}, slice.h }, workspace_);
		workspace_.forces_are_current =
				both(workspace_.forces_are_current, keep_shape<T>(bodies, slice.h, slice.bears_load, slice.scratch));
		prefetch.ask(2);
		if ((slice.solved_alone | touching_) != 0 || !slice.borders.empty()) {
			const T contacts = solve_contacts(bodies, slice);
			workspace_.forces_are_current = both(workspace_.forces_are_current, !(contacts > T(0)));
			all_contacts += contacts;
		}
	}
	prefetch.ask_all();
	LaneResult result;
	const MaskOf<T> is_whole = is_finite_within<T>(bodies.positions, bodies.velocities, slice.reach);
	const bool are_whole = !any(!is_whole);
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		result.contacts += std::uint64_t(all_contacts[lane]);
		result.ruined |= std::uint32_t(!are_whole && !is_whole[lane]) << lane;
	}
	if (result.ruined == 0) {
		store(bodies, batch);
	}
	for (std::size_t lane = 0; result.ruined != 0 && lane < LANES<T>; ++lane) {
		for (std::size_t i = 0; is_whole[lane] && i < bodies.positions.size(); ++i) {
			batch.states[lane][i] = lane_of(bodies.positions[i], lane);
			batch.velocities(lane)[i] = lane_of(bodies.velocities[i], lane);
		}
	}
	if (hull_count > 0) {
		hand_out_extents(bodies.positions.first(hull_count), slice);
	}
	return result;
}

template <class T>
FlightResult BasicLaneStepper<T>::fly(const FlightSlice &slice, FlightGate &gate) {
	const Batch &batch = *slice.batch;
	StatePrefetch none;
	const BodyLanes<T> bodies = load(batch, none);
	const FlightResult result = fly_lanes<T>(bodies, slice, gate);
	if (result.flown == (1u << LANES<T>)-1) {
		store(bodies, batch);
		return result;
	}
	for (std::size_t lane = 0; result.flown != 0 && lane < LANES<T>; ++lane) {
		for (std::size_t i = 0; (result.flown >> lane & 1) != 0 && i < bodies.positions.size(); ++i) {
			batch.states[lane][i] = lane_of(bodies.positions[i], lane);
			batch.velocities(lane)[i] = lane_of(bodies.velocities[i], lane);
		}
	}
	return result;
}

template <class T>
void BasicLaneStepper<T>::measure_frames(const Batch &batch, std::span<BodyFrame> frames) {
	StatePrefetch none;
	const BodyLanes<T> bodies = load(batch, none);
	const auto all = measure_frame<T>(*batch.shape, bodies.model.rotation_memory, bodies.positions, bodies.velocities);
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		frames[lane] = { lane_of(all.center, lane), lane_of(all.velocity, lane), { all.rotation.c[lane], all.rotation.s[lane] },
			all.rotation_defined[lane], all.inertia[lane], all.angular_velocity[lane] };
	}
}

template <class T>
auto BasicLaneStepper<T>::velocities_of(const Batch &batch) -> Lanes {
	Lanes velocities;
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		velocities[lane] = batch.velocities(lane);
	}
	return velocities;
}

template <class T>
BodyLanes<T> BasicLaneStepper<T>::load(const Batch &batch, StatePrefetch &prefetch) {
	const std::size_t count = batch.shape->point_count();
	positions_.resize(std::max(positions_.size(), count));
	velocities_.resize(std::max(velocities_.size(), count));
	const ForceCoefficients<T> coefficients =
			batch.are_unlike ? coefficients_of<T>(batch.own_settings.data()) : coefficients_of<T>(*batch.settings);
	BodyLanes<T> bodies{ { *batch.shape, *batch.settings, {}, coefficients }, batch.shape->inverse_masses(), { positions_.data(), count },
		{ velocities_.data(), count } };
	for (std::size_t lane = 0; batch.settings->turns_with_body() && lane < LANES<T>; ++lane) {
		const Rotation memory = batch.rotation_memory(lane);
		bodies.model.rotation_memory.c.set(lane, memory.c);
		bodies.model.rotation_memory.s.set(lane, memory.s);
	}
	prefetch.ask(1); // one or two bodies at a time, spread evenly over the work
	gather_all<T>(batch.states.data(), bodies.positions);
	prefetch.ask(1);
	gather_all<T>(velocities_of(batch).data(), bodies.velocities);
	return bodies;
}

template <class T>
void BasicLaneStepper<T>::store(const BodyLanes<T> &bodies, const Batch &batch) const {
	scatter_all<T>(bodies.positions, batch.states.data());
	scatter_all<T>(bodies.velocities, velocities_of(batch).data());
}

// Forces and integrators stay in lanes, as they take most of the time. Only contacts with colliders are solved for each
// body alone.
template <class T>
T BasicLaneStepper<T>::solve_contacts(const BodyLanes<T> &bodies, const LaneSlice &slice) {
	if (slice.solved_alone == 0) {
		return solve_borders(bodies, slice);
	}
	const Batch &batch = *slice.batch;
	const std::size_t count = bodies.positions.size();
	const auto is_alone = [&](std::size_t lane) { return (slice.solved_alone >> lane & 1) != 0; };
	const bool all_at_once = (slice.borders.empty() && touching_ == 0) || slice.solved_alone == (1u << LANES<T>)-1;
	if (all_at_once) {
		store(bodies, batch);
	}
	for (std::size_t lane = 0; !all_at_once && lane < LANES<T>; ++lane) {
		for (std::size_t i = 0; is_alone(lane) && i < count; ++i) {
			batch.states[lane][i] = lane_of(bodies.positions[i], lane);
			batch.velocities(lane)[i] = lane_of(bodies.velocities[i], lane);
		}
	}
	T contacts = all_at_once ? T(0) : solve_borders(bodies, slice); // of the others; lanes solved alone are overwritten
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		if (!is_alone(lane)) {
			continue;
		}
		contacts.set(lane, Real(slice.lone_contacts->solve(lane)));
		for (std::size_t i = 0; !all_at_once && i < count; ++i) {
			set_lane(bodies.positions[i], lane, batch.states[lane][i]);
			set_lane(bodies.velocities[i], lane, batch.velocities(lane)[i]);
		}
	}
	if (all_at_once) {
		gather_all<T>(batch.states.data(), bodies.positions);
		gather_all<T>(velocities_of(batch).data(), bodies.velocities);
	}
	return contacts;
}

template <class T>
T BasicLaneStepper<T>::solve_borders(const BodyLanes<T> &bodies, const LaneSlice &slice) {
	BasicContactLoad<T> load;
	load.is_summed = bodies.model.settings.rolling_resistance > 0 || slice.may_bounce || touching_ != 0;
	for (std::uint32_t i = 0; i < slice.borders.size(); ++i) {
		const Border &border = slice.borders[i];
		if (!is_noticed(bodies.model.settings, border.surface)) {
			continue;
		}
		const T contacts = load.contacts;
		solutions_.assign(bodies.model.settings.contact_monitor ? bodies.model.shape.hull_count() : 0, {});
		solve_border<T>(bodies, border, std::numeric_limits<Real>::infinity(), slice.h, load, solutions_); // no point bounces by itself
		for (std::uint32_t point = 0; any(load.contacts > contacts) && point < solutions_.size(); ++point) {
			for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
				const bool is_alone = (slice.solved_alone >> lane & 1) != 0;
				if (const Real depth = solutions_[point].depth[lane]; depth > 0 && !is_alone) {
					slice.lone_contacts->report({ slice.batch->body_indices[lane], ContactOther::Kind::BORDER, i, point, point, 0,
							lane_of(bodies.positions[point], lane), border.plane.normal, solutions_[point].normal_impulse[lane], depth });
				}
			}
		}
	}
	resist_rolling<T>(bodies, load);
	if ((slice.may_bounce && any(load.restitution > T(0))) || touching_ != 0) {
		follow_bounces(bodies, load, slice);
	}
	return load.contacts;
}

template <class T>
void BasicLaneStepper<T>::follow_bounces(const BodyLanes<T> &bodies, const BasicContactLoad<T> &load, const LaneSlice &slice) {
	const auto velocity = measure_translation<T>(bodies.model.shape, bodies.positions, bodies.velocities).velocity;
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		const std::uint32_t bit = 1u << lane;
		if ((slice.solved_alone & bit) != 0 || ((touching_ & bit) == 0 && !(load.restitution[lane] > 0))) {
			continue;
		}
		ContactLoad own;
		own.normal_impulse = load.normal_impulse[lane];
		own.impulse = lane_of(load.impulse, lane);
		own.restitution = load.restitution[lane];
		own.surface_velocity = lane_of(load.surface_velocity, lane);
		own.work = load.work[lane];
		const bool goes_on = slice.lone_contacts->follow_bounce(lane, own, lane_of(velocity, lane));
		touching_ = goes_on ? touching_ | bit : touching_ & ~bit;
	}
}

template <class T>
void BasicLaneStepper<T>::hand_out_motion(const BasicTranslation<T> &motion, const LaneSlice &slice) {
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		slice.solver_bodies[lane]->mass_center = lane_of(motion.center, lane);
		slice.solver_bodies[lane]->mass_velocity = lane_of(motion.velocity, lane);
	}
}

template <class T>
void BasicLaneStepper<T>::hand_out_extents(std::span<const BasicVec2<T>> hull, const LaneSlice &slice) const {
	const BasicExtent<T> extent = measure_extent<T>(hull, before_);
	for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
		SolverBody &body = *slice.solver_bodies[lane];
		body.box = { lane_of(extent.min, lane), lane_of(extent.max, lane) };
		body.center = lane_of(extent.center, lane);
		body.radius = extent.radius[lane];
		body.way = extent.way[lane];
	}
}

} // namespace softbody
