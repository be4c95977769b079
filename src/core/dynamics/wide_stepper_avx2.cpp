// SPDX-License-Identifier: MIT
// Batches of WIDE_WIDTH bodies in registers of 32 bytes. This file alone is compiled for AVX2, and linked last (see SConstruct).
#include "core/dynamics/wide_stepper.h"

// GCC cannot align the stack to 32 bytes on Windows (its bug 54412). SOFTBODY_SHUFFLES implies single precision.
#if defined(__AVX2__) && defined(SOFTBODY_SHUFFLES) && !(defined(_WIN32) && !defined(__clang__))

#include "core/collision/extent_lanes.h"
#include "core/collision/surface_constraint_lanes.h"
#include "core/dynamics/area_lanes.h"
#include "core/dynamics/forces_lanes.h"
#include "core/dynamics/integrators/lane_steps.h"
#include "core/dynamics/pressure_lanes.h"
#include "core/dynamics/rigid_damping_lanes.h"
#include "core/dynamics/shape_limits_lanes.h"
#include "core/dynamics/finite_check.h"
#include "core/model/body_frame_lanes.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

namespace softbody {

namespace {

using WidePack = BasicPack<WIDE_WIDTH>;
using WideVec2 = BasicVec2<WidePack>;
using Lanes = std::array<Vec2 *, WIDE_WIDTH>;

typedef float Floats __attribute__((vector_size(16)));
typedef float WideFloats __attribute__((vector_size(32)));

// Two vectors each of lanes l and l + 4, in the two halves of a register. Shuffles work within each half.
WideFloats load_two(const Lanes &lanes, std::size_t lane, std::size_t i) {
	Floats low;
	Floats high;
	std::memcpy(&low, lanes[lane] + i, sizeof(low));
	std::memcpy(&high, lanes[lane + 4] + i, sizeof(high));
	return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

void store_two(WideFloats two, const Lanes &lanes, std::size_t lane, std::size_t i) {
	const Floats low = __builtin_shufflevector(two, two, 0, 1, 2, 3);
	const Floats high = __builtin_shufflevector(two, two, 4, 5, 6, 7);
	std::memcpy(static_cast<void *>(lanes[lane] + i), &low, sizeof(low));
	std::memcpy(static_cast<void *>(lanes[lane + 4] + i), &high, sizeof(high));
}

// The first or last two numbers of each pair of halves: interleaved (in_turn), or one pair after the other (pairs).
WideFloats first_in_turn(WideFloats a, WideFloats b) {
	return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
}
WideFloats last_in_turn(WideFloats a, WideFloats b) {
	return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
}
WideFloats first_pairs(WideFloats a, WideFloats b) {
	return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
}
WideFloats last_pairs(WideFloats a, WideFloats b) {
	return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}

// Transposes two points at a time, to move the state into lanes. With an odd number of points, the last but one is
// moved twice.
void gather_all(const Lanes &lanes, std::span<WideVec2> all) {
	for (std::size_t next = 0; next < all.size(); next += 2) {
		const std::size_t i = std::min(next, all.size() - 2);
		const WideFloats r0 = load_two(lanes, 0, i);
		const WideFloats r1 = load_two(lanes, 1, i);
		const WideFloats r2 = load_two(lanes, 2, i);
		const WideFloats r3 = load_two(lanes, 3, i);
		const WideFloats first01 = first_in_turn(r0, r1);
		const WideFloats first23 = first_in_turn(r2, r3);
		const WideFloats last01 = last_in_turn(r0, r1);
		const WideFloats last23 = last_in_turn(r2, r3);
		all[i] = { WidePack::of_lanes(first_pairs(first01, first23)), WidePack::of_lanes(last_pairs(first01, first23)) };
		all[i + 1] = { WidePack::of_lanes(first_pairs(last01, last23)), WidePack::of_lanes(last_pairs(last01, last23)) };
	}
}

void scatter_all(std::span<const WideVec2> all, const Lanes &lanes) {
	for (std::size_t next = 0; next < all.size(); next += 2) {
		const std::size_t i = std::min(next, all.size() - 2);
		const WideFloats a01 = first_in_turn(all[i].x.lanes(), all[i].y.lanes());
		const WideFloats a23 = last_in_turn(all[i].x.lanes(), all[i].y.lanes());
		const WideFloats b01 = first_in_turn(all[i + 1].x.lanes(), all[i + 1].y.lanes());
		const WideFloats b23 = last_in_turn(all[i + 1].x.lanes(), all[i + 1].y.lanes());
		store_two(first_pairs(a01, b01), lanes, 0, i);
		store_two(last_pairs(a01, b01), lanes, 1, i);
		store_two(first_pairs(a23, b23), lanes, 2, i);
		store_two(last_pairs(a23, b23), lanes, 3, i);
	}
}

class Avx2Stepper final : public WideStepper {
public:
	std::optional<std::uint64_t> advance(const WideTimeSlice &slice, StatePrefetch &prefetch) override {
		const Batch &batch = *slice.batch;
		const SoftBodyShape &shape = *batch.shape;
		const BodySettings &settings = *batch.settings;
		const std::size_t count = shape.point_count();
		positions_.resize(std::max(positions_.size(), count));
		velocities_.resize(std::max(velocities_.size(), count));
		workspace_.begin_body(count);
		BodyLanes<WidePack> bodies{ { shape, settings, {} }, shape.inverse_masses(), { positions_.data(), count },
			{ velocities_.data(), count } };
		const Lanes &to_positions = batch.states;
		Lanes to_velocities;
		for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
			to_velocities[lane] = batch.velocities(lane);
		}
		if (settings.turns_with_body()) {
			for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
				const Rotation memory = batch.rotation_memory(lane);
				bodies.model.rotation_memory.c.set(lane, memory.c);
				bodies.model.rotation_memory.s.set(lane, memory.s);
			}
		}
		// Prefetches one or two bodies at a time, spread evenly over the work.
		prefetch.ask(1);
		gather_all(to_positions, bodies.positions);
		prefetch.ask(1);
		gather_all(to_velocities, bodies.velocities);
		const std::size_t hull_count = slice.solver_bodies[0] != nullptr ? shape.hull_count() : 0;
		before_.assign(positions_.begin(), positions_.begin() + std::ptrdiff_t(hull_count));
		const LaneStep<WidePack> step = lane_step<WidePack>(slice.integrator);
		WidePack contacts(0);
		for (int i = 0; i < slice.substeps; ++i) {
			prefetch.ask(2);
			step(bodies, { slice.gravity, {}, slice.h }, workspace_);
			if (holds_area(shape, settings)) {
				hold_area<WidePack>(bodies, slice.h);
				workspace_.forces_are_current = WidePack(0) < WidePack(0);
			}
			if (settings.has_limits() && any(may_break_limits<WidePack>(bodies.model, bodies.positions))) {
				prefetch.ask_all();
				return std::nullopt; // rare; left to the narrower code
			}
			prefetch.ask(2);
			if (settings.has_damp()) {
				damp_rigid_motion<WidePack>(bodies, slice.h);
			}
			if (!slice.borders.empty()) {
				const WidePack solved = solve_borders(bodies, slice);
				workspace_.forces_are_current = both(workspace_.forces_are_current, !(solved > WidePack(0)));
				contacts += solved;
			}
		}
		prefetch.ask_all();
		if (any(!is_finite_within<WidePack>(bodies.positions, bodies.velocities, slice.reach))) {
			return std::nullopt;
		}
		if (settings.has_limits() && any(may_break_limits<WidePack>(bodies.model, bodies.positions))) {
			return std::nullopt;
		}
		scatter_all(bodies.positions, to_positions);
		scatter_all(bodies.velocities, to_velocities);
		if (hull_count > 0) {
			hand_out(measure_extent<WidePack>(bodies.positions.first(hull_count), before_), slice.solver_bodies);
		}
		std::uint64_t all_contacts = 0;
		for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
			all_contacts += std::uint64_t(contacts[lane]);
		}
		return all_contacts;
	}

private:
	// As `EnvironmentContactSolver::solve_borders_side_by_side`.
	static WidePack solve_borders(const BodyLanes<WidePack> &bodies, const WideTimeSlice &slice) {
		BasicContactLoad<WidePack> load;
		for (const Border &border : slice.borders) {
			if (is_noticed(bodies.model.settings, border.surface)) {
				solve_border<WidePack>(bodies, border, std::numeric_limits<Real>::infinity(), slice.h, load);
			}
		}
		resist_rolling<WidePack>(bodies, load);
		return load.contacts;
	}

	static void hand_out(const BasicExtent<WidePack> &extent, const std::array<SolverBody *, WIDE_WIDTH> &solver_bodies) {
		for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
			SolverBody &body = *solver_bodies[lane];
			body.box = { { extent.min.x[lane], extent.min.y[lane] }, { extent.max.x[lane], extent.max.y[lane] } };
			body.center = { extent.center.x[lane], extent.center.y[lane] };
			body.radius = extent.radius[lane];
			body.way = extent.way[lane];
		}
	}

	BasicWorkspace<WidePack> workspace_;
	std::vector<WideVec2> positions_;
	std::vector<WideVec2> velocities_;
	std::vector<WideVec2> before_; ///< hull points at the start
};

std::unique_ptr<WideStepper> make() {
	return std::make_unique<Avx2Stepper>();
}

} // namespace

std::unique_ptr<WideStepper> (*const detail::make_avx2_stepper)() = make;

} // namespace softbody

#else

namespace softbody {

std::unique_ptr<WideStepper> (*const detail::make_avx2_stepper)() = nullptr;

} // namespace softbody

#endif
