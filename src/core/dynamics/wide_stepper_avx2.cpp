// SPDX-License-Identifier: MIT
// Two crews at once in registers of 32 bytes. This file alone is compiled for AVX2, and linked last (see SConstruct).
#include "core/dynamics/wide_stepper.h"

// GCC cannot align the stack to 32 bytes on Windows (its bug 54412). SOFTBODY_SHUFFLES implies single precision.
#if defined(__AVX2__) && defined(SOFTBODY_SHUFFLES) && !(defined(_WIN32) && !defined(__clang__))

#include "core/collision/surface_response_lanes.h"
#include "core/dynamics/forces_lanes.h"
#include "core/dynamics/integrators/lane_steps.h"
#include "core/dynamics/pressure_lanes.h"
#include "core/dynamics/rigid_damping_lanes.h"
#include "core/dynamics/soundness.h"
#include "core/model/body_frame_lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <vector>

namespace softbody {

namespace {

using WidePack = BasicPack<WIDE_WIDTH>;
using WideVec2 = BasicVec2<WidePack>;
using Lanes = std::array<Vec2 *, WIDE_WIDTH>;

typedef float Floats __attribute__((vector_size(16)));
typedef float WideFloats __attribute__((vector_size(32)));
typedef std::uint64_t WideVectors __attribute__((vector_size(32)));

Floats two_vectors(const Vec2 &a, const Vec2 &b) {
	const detail::VectorPair pair = { detail::bits_of(a), detail::bits_of(b) };
	return std::bit_cast<Floats>(pair);
}

// Shuffles work within each half of a register: lanes 0, 1 and 4, 5 in one register, 2, 3 and 6, 7 in the other.
WideVec2 gather_wide(const Lanes &lanes, std::size_t i) {
	const WideFloats a = __builtin_shufflevector(two_vectors(lanes[0][i], lanes[1][i]),
			two_vectors(lanes[4][i], lanes[5][i]), 0, 1, 2, 3, 4, 5, 6, 7);
	const WideFloats b = __builtin_shufflevector(two_vectors(lanes[2][i], lanes[3][i]),
			two_vectors(lanes[6][i], lanes[7][i]), 0, 1, 2, 3, 4, 5, 6, 7);
	return { WidePack::of_lanes(__builtin_shufflevector(a, b, 0, 2, 8, 10, 4, 6, 12, 14)),
		WidePack::of_lanes(__builtin_shufflevector(a, b, 1, 3, 9, 11, 5, 7, 13, 15)) };
}

void scatter_wide(const WideVec2 &pack, const Lanes &lanes, std::size_t i) {
	const auto a = std::bit_cast<WideVectors>(
			__builtin_shufflevector(pack.x.lanes(), pack.y.lanes(), 0, 8, 1, 9, 4, 12, 5, 13));
	const auto b = std::bit_cast<WideVectors>(
			__builtin_shufflevector(pack.x.lanes(), pack.y.lanes(), 2, 10, 3, 11, 6, 14, 7, 15));
	lanes[0][i] = std::bit_cast<Vec2>(a[0]);
	lanes[1][i] = std::bit_cast<Vec2>(a[1]);
	lanes[2][i] = std::bit_cast<Vec2>(b[0]);
	lanes[3][i] = std::bit_cast<Vec2>(b[1]);
	lanes[4][i] = std::bit_cast<Vec2>(a[2]);
	lanes[5][i] = std::bit_cast<Vec2>(a[3]);
	lanes[6][i] = std::bit_cast<Vec2>(b[2]);
	lanes[7][i] = std::bit_cast<Vec2>(b[3]);
}

class Avx2Stepper final : public WideStepper {
public:
	std::optional<std::uint64_t> advance(const WideStretch &stretch) override {
		const SoftBodyShape &shape = *stretch.crews[0]->shape;
		const BodySettings &settings = *stretch.crews[0]->settings;
		const std::size_t count = shape.point_count();
		positions_.resize(std::max(positions_.size(), count));
		velocities_.resize(std::max(velocities_.size(), count));
		workspace_.begin_body(count);
		BodyLanes<WidePack> bodies{ { shape, settings, {} }, shape.inverse_masses(), { positions_.data(), count },
			{ velocities_.data(), count } };
		Lanes to_positions;
		Lanes to_velocities;
		for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
			const Crew &crew = *stretch.crews[lane / PACK_WIDTH];
			to_positions[lane] = crew.positions[lane % PACK_WIDTH];
			to_velocities[lane] = crew.velocities[lane % PACK_WIDTH];
		}
		if (settings.matches_shape()) {
			for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
				bodies.model.rotation_memory.c.set(lane, stretch.rotation_memories[lane].c);
				bodies.model.rotation_memory.s.set(lane, stretch.rotation_memories[lane].s);
			}
		}
		for (std::size_t i = 0; i < count; ++i) {
			bodies.positions[i] = gather_wide(to_positions, i);
			bodies.velocities[i] = gather_wide(to_velocities, i);
		}
		const LaneStep<WidePack> step = lane_step<WidePack>(stretch.integrator);
		WidePack contacts(0);
		for (int i = 0; i < stretch.substeps; ++i) {
			step(bodies, { stretch.gravity, {}, stretch.h }, workspace_);
			if (settings.has_damp()) {
				damp_rigid_motion<WidePack>(bodies, stretch.h);
			}
			if (!stretch.borders.empty()) {
				const WidePack answered = answer_borders(bodies, stretch);
				workspace_.forces_are_current = both(workspace_.forces_are_current, !(answered > WidePack(0)));
				contacts += answered;
			}
		}
		if (any(!is_sound<WidePack>(bodies.positions, bodies.velocities, stretch.reach))) {
			return std::nullopt;
		}
		for (std::size_t i = 0; i < count; ++i) {
			scatter_wide(bodies.positions[i], to_positions, i);
			scatter_wide(bodies.velocities[i], to_velocities, i);
		}
		std::uint64_t all_contacts = 0;
		for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
			all_contacts += std::uint64_t(contacts[lane]);
		}
		return all_contacts;
	}

private:
	// As `CollisionHandling::handle_borders_side_by_side` does.
	static WidePack answer_borders(const BodyLanes<WidePack> &bodies, const WideStretch &stretch) {
		BasicContactLoad<WidePack> load;
		for (const Border &border : stretch.borders) {
			if (is_noticed(bodies.model.settings, border.surface)) {
				answer_border<WidePack>(bodies, border, std::numeric_limits<Real>::infinity(), stretch.h, load);
			}
		}
		resist_rolling<WidePack>(bodies, load);
		return load.contacts;
	}

	BasicWorkspace<WidePack> workspace_;
	std::vector<WideVec2> positions_;
	std::vector<WideVec2> velocities_;
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
