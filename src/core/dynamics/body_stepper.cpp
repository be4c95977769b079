// SPDX-License-Identifier: MIT
// Advances bodies through one step, alone or side by side.
#include "core/dynamics/body_stepper.h"

#include "core/model/body_frame.h"

#include <algorithm>
#include <array>

namespace softbody {

namespace {

bool has_finite_state(const SoftBodyData &body) {
	// A sum is finite only if all its terms are; one test instead of four a point.
	Vec2 sum;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		sum += (body.positions()[i] + body.velocities()[i]) * Real(0);
	}
	return sum == Vec2{};
}

void load(std::array<const Vec2 *, PACK_WIDTH> lanes, std::span<BasicVec2<RealPack>> packs) {
	for (std::size_t i = 0; i < packs.size(); ++i) {
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			set_lane(packs[i], lane, lanes[lane][i]);
		}
	}
}

void store(std::span<const BasicVec2<RealPack>> packs, std::array<Vec2 *, PACK_WIDTH> lanes) {
	for (std::size_t i = 0; i < packs.size(); ++i) {
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			lanes[lane][i] = lane_of(packs[i], lane);
		}
	}
}

} // namespace

void BodyStepper::begin_step(WorldData &world, const SurroundingsIndex &surroundings) {
	world_ = &world;
	surroundings_ = &surroundings;
	counts_.substeps = 0;
	counts_.contacts = 0;
	counts_.non_finite.clear();
}

void BodyStepper::begin(const Crew &crew) {
	for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
		SoftBodyData &data = body(crew.bodies[lane]);
		std::ranges::copy(data.positions(), data.mutable_previous_positions().begin());
	}
}

void BodyStepper::advance(const Crew &crew, const SubstepPlan &plan, Real duration, int substeps) {
	if (can_go_side_by_side(crew, plan, duration)) {
		advance_side_by_side(crew, plan, duration, substeps);
	} else {
		for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
			advance_alone(body(crew.bodies[lane]), plan, duration, substeps);
		}
	}
	counts_.substeps += std::uint64_t(substeps) * crew.count;
}

bool BodyStepper::can_go_side_by_side(const Crew &crew, const SubstepPlan &plan, Real duration) const {
	if (crew.count < PACK_WIDTH || !integrator_traits(plan.integrator).step_side_by_side) {
		return false;
	}
	for (const Border &border : world_->borders()) {
		if (border.surface.restitution != 0) {
			return false; // each body remembers its own bounce
		}
	}
	for (const std::uint32_t place : crew.bodies) {
		SoftBodyData &data = body(place);
		if (!data.external_forces().empty() || data.touch_memory().touching) {
			return false;
		}
		if (!surroundings_->bounds().empty() && surroundings_->has_collider_in(sweep_box(data, duration))) {
			return false;
		}
	}
	return true;
}

void BodyStepper::advance_side_by_side(const Crew &crew, const SubstepPlan &plan, Real duration, int substeps) {
	SoftBodyData &first = body(crew.bodies[0]);
	const std::size_t count = first.point_count();
	if (pack_positions_.size() < count) {
		pack_positions_.resize(count);
		pack_velocities_.resize(count);
	}
	BodyLanes<RealPack> lanes{ { first.shape(), first.settings(), {} }, first.inverse_masses(),
		{ pack_positions_.data(), count }, { pack_velocities_.data(), count } };
	std::array<Vec2 *, PACK_WIDTH> positions;
	std::array<Vec2 *, PACK_WIDTH> velocities;
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		SoftBodyData &data = body(crew.bodies[lane]);
		positions[lane] = data.mutable_positions().data();
		velocities[lane] = data.mutable_velocities().data();
		lanes.model.rotation_memory.c.set(lane, data.rotation_memory().c);
		lanes.model.rotation_memory.s.set(lane, data.rotation_memory().s);
	}
	load({ positions[0], positions[1], positions[2], positions[3] }, lanes.positions);
	load({ velocities[0], velocities[1], velocities[2], velocities[3] }, lanes.velocities);

	pack_workspace_.begin_body(count);
	const LaneStep<RealPack> step = integrator_traits(plan.integrator).step_side_by_side;
	const Real h = duration / Real(substeps);
	for (int i = 0; i < substeps; ++i) {
		step(lanes, { world_->gravity(), {}, h }, pack_workspace_);
		if (!world_->borders().empty()) {
			const RealPack contacts = handle_borders_side_by_side(lanes, world_->borders(), h);
			pack_workspace_.forces_are_current =
					both(pack_workspace_.forces_are_current, !(contacts > RealPack(0)));
			for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
				counts_.contacts += std::uint64_t(contacts[lane]);
			}
		}
	}
	store(lanes.positions, positions);
	store(lanes.velocities, velocities);
	const auto frame = measure_frame<RealPack>(first.shape(), lanes.model.rotation_memory, lanes.positions, lanes.velocities);
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		body(crew.bodies[lane]).set_rotation_memory({ frame.rotation.c[lane], frame.rotation.s[lane] });
	}
}

void BodyStepper::advance_alone(SoftBodyData &data, const SubstepPlan &plan, Real duration, int substeps) {
	const std::size_t count = data.point_count();
	workspace_.begin_body(count);
	before_.resize(std::max(before_.size(), count));
	external_.assign(count, Vec2{});
	for (const ExternalForce &external : data.external_forces()) {
		external_[external.point] += external.force;
	}
	const IntegratorStep step = integrator_traits(plan.integrator).step;
	const Real h = duration / Real(substeps);
	const SubstepInput input{ world_->gravity(), external_, h };
	const std::span<Vec2> before(before_.data(), count);
	const Vec2 gravity = world_->gravity() * data.settings().gravity_scale;
	collision_.begin_body(*surroundings_, data, duration);
	for (int i = 0; i < substeps; ++i) {
		std::ranges::copy(data.positions(), before.begin());
		step(data, input, workspace_);
		const std::size_t contacts = collision_.handle(data, before, gravity, h);
		counts_.contacts += contacts;
		if (contacts > 0) {
			workspace_.forces_are_current = false;
		}
	}
	data.set_rotation_memory(measure_frame(data).rotation); // the memory itself where it is not defined
}

void BodyStepper::end(const Crew &crew) {
	for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
		SoftBodyData &data = body(crew.bodies[lane]);
		data.clear_external_forces();
		if (!has_finite_state(data)) {
			std::ranges::copy(data.previous_positions(), data.mutable_positions().begin());
			std::ranges::fill(data.mutable_velocities(), Vec2{});
			data.touch_memory() = {};
			counts_.non_finite.push_back(crew.bodies[lane]);
		}
	}
}

} // namespace softbody
