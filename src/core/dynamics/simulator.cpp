// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#include "core/dynamics/simulator.h"

#include <algorithm>
#include <utility>

namespace softbody {

namespace {

// Into how many tasks the crews are divided: enough to keep the threads of a large machine busy to the end, few
// enough that a task outweighs its dispatch. Independent of the number of threads, so that results are too.
constexpr std::size_t TASKS = 32;
constexpr std::size_t CREWS_A_TASK = 16;
constexpr std::size_t GROUPS_A_TASK = 4;

// Where bodies are too many for the cache, a step waits for memory: their state is asked for three crews ahead
// (353,400 bodies in explicit Euler steps: 61 ns a body without, 50 with).
constexpr std::size_t CREWS_AHEAD = 3;

void prefetch_state(const Crew &crew) {
#ifdef SOFTBODY_VECTOR_EXTENSION
	constexpr std::size_t LINE = 64; // bytes of a line of the cache, on nearly all processors
	for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
		const char *begin = reinterpret_cast<const char *>(crew.positions[lane]);
		const char *end = reinterpret_cast<const char *>(crew.velocities[lane] + crew.shape->point_count());
		for (const char *line = begin; line < end; line += LINE) {
			__builtin_prefetch(line, 1);
		}
	}
#else
	(void)crew;
#endif
}

} // namespace

Simulator::Simulator(WorldData &world, ParallelFor parallel_for) :
		world_(world), parallel_for_(std::move(parallel_for)), steppers_(TASKS), pair_handlings_(TASKS),
		pair_contacts_(TASKS) {}

SubstepPlan Simulator::plan(const SoftBodyData &body, Real dt) const {
	const bool has_contacts = !world_.borders().empty() || !world_.colliders().empty();
	return plan_substeps(body.shape(), body.settings(), dt, has_contacts);
}

// What holds until bodies are rearranged, the time step changes or the first surroundings appear.
void Simulator::arrange(Real dt) {
	const bool has_contacts = !world_.borders().empty() || !world_.colliders().empty();
	if (arranged_roster_ == roster_.version() && arranged_dt_ == dt && arranged_with_contacts_ == has_contacts) {
		return;
	}
	arranged_roster_ = roster_.version();
	arranged_dt_ = dt;
	arranged_with_contacts_ = has_contacts;
	crews_.clear();
	touching_.clear();
	broad_.clear();
	std::uint32_t layers = 0;
	std::uint32_t masks = 0;
	for (const Crew &crew : roster_.crews()) {
		CrewState &state = crews_.emplace_back();
		state.plan = plan(world_.soft_bodies()[crew.bodies[0]], dt);
		for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
			SoftBodyData &body = world_.soft_bodies()[crew.bodies[lane]];
			const BodySettings &settings = body.settings();
			state.rows[lane] = std::uint32_t(touching_.size());
			touching_.push_back({ {}, {}, 0, body.mutable_positions().first(body.shape().hull_count()),
					body.mutable_velocities(), body.inverse_masses(), settings.friction, settings.restitution });
			broad_.push_back({ {}, settings.collision_layer, settings.collision_mask });
			layers |= settings.collision_layer;
			masks |= settings.collision_mask;
		}
	}
	bodies_notice_bodies_ = touching_.size() > 1 && (layers & masks) != 0;
}

template <class Work>
void Simulator::for_crews(std::span<const std::uint32_t> crews, const Work &work) {
	const std::size_t count = crews.size();
	const std::size_t tasks = std::clamp<std::size_t>(count / CREWS_A_TASK, 1, TASKS);
	run_tasks(parallel_for_, tasks, [&](std::size_t task) {
		const std::size_t end = count * (task + 1) / tasks;
		for (std::size_t i = count * task / tasks; i < end; ++i) {
			if (i + CREWS_AHEAD < end) {
				prefetch_state(roster_.crews()[crews[i + CREWS_AHEAD]]);
			}
			work(steppers_[task], crews[i]);
		}
	});
}

void Simulator::find_pairs(Real dt) {
	free_crews_.clear();
	coupled_crews_.clear();
	if (bodies_notice_bodies_) {
		const std::size_t count = touching_.size();
		const std::size_t tasks = std::clamp<std::size_t>(count / (CREWS_A_TASK * PACK_WIDTH), 1, TASKS);
		run_tasks(parallel_for_, tasks, [&](std::size_t task) {
			for (std::size_t i = count * task / tasks; i < count * (task + 1) / tasks; ++i) {
				broad_[i].box = sweep_box(touching_[i].hull, touching_[i].velocities, dt);
			}
		});
		broad_phase_.update(broad_, roster_.version());
		has_pair_.assign(count, 0);
		for (const BodyPair pair : broad_phase_.pairs()) {
			has_pair_[pair.a] = 1;
			has_pair_[pair.b] = 1;
		}
	}
	for (std::uint32_t i = 0; i < crews_.size(); ++i) {
		CrewState &state = crews_[i];
		state.is_coupled = false;
		for (std::uint32_t lane = 0; bodies_notice_bodies_ && lane < roster_.crews()[i].count; ++lane) {
			state.is_coupled |= has_pair_[state.rows[lane]] != 0;
		}
		for (std::uint32_t lane = 0; !has_rigid_body_.empty() && lane < roster_.crews()[i].count; ++lane) {
			if (has_rigid_body_[state.rows[lane]] != 0) {
				rigid_contacts_.add_body(world_.soft_bodies()[roster_.crews()[i].bodies[lane]]);
				state.is_coupled = true;
			}
		}
		(state.is_coupled ? coupled_crews_ : free_crews_).push_back(i);
	}
}

// Which bodies may meet a rigid body that they push back.
void Simulator::find_rigid_contacts(Real dt) {
	rigid_contacts_.begin_step(world_, surroundings_);
	rigid_contact_count_ = 0;
	has_rigid_body_.clear();
	if (!surroundings_.has_dynamic_colliders()) {
		return;
	}
	const std::size_t count = touching_.size();
	has_rigid_body_.assign(count, 0);
	const std::size_t tasks = std::clamp<std::size_t>(count / (CREWS_A_TASK * PACK_WIDTH), 1, TASKS);
	run_tasks(parallel_for_, tasks, [&](std::size_t task) {
		for (std::size_t i = count * task / tasks; i < count * (task + 1) / tasks; ++i) {
			has_rigid_body_[i] =
					surroundings_.has_dynamic_collider_in(sweep_box(touching_[i].hull, touching_[i].velocities, dt));
		}
	});
}

StepReport Simulator::simulate(Real dt) {
	StepReport report;
	report.refused = check_above("dt", dt, 0, "s");
	if (report.refused) {
		return report;
	}
	const std::uint64_t old_roster = roster_.version();
	roster_.update(world_);
	surroundings_.update(world_, dt);
	arrange(dt);
	// Bodies that came or were activated may have brought forces along.
	const bool has_forces = seen_forces_ != world_.change_counts().forces || roster_.version() != old_roster;
	seen_forces_ = world_.change_counts().forces;
	for (BodyStepper &stepper : steppers_) {
		stepper.begin_step(world_, surroundings_, has_forces);
	}
	std::ranges::fill(pair_contacts_, 0);
	find_rigid_contacts(dt);
	find_pairs(dt);
	for_crews(free_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = roster_.crews()[i];
		stepper.begin(crew);
		stepper.advance(crew, crews_[i].plan, 0, dt, crews_[i].plan.substeps);
		stepper.end(crew);
	});
	if (!coupled_crews_.empty()) {
		step_coupled(dt);
	} else {
		move_rigid_bodies_alone(dt);
	}
	rigid_contacts_.end_step(dt);
	for (const std::uint32_t place : roster_.inactive_bodies()) {
		SoftBodyData &body = world_.soft_bodies()[place];
		std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	}
	collect(report);
	return report;
}

void Simulator::step_coupled(Real dt) {
	// A point that moves through several force substeps between two looks at its contacts trembles: each body gets as
	// many looks as it has force substeps, up to a bound that keeps one very stiff body from slowing all the others.
	int contact_substeps = world_.contact_substeps();
	for (const std::uint32_t i : coupled_crews_) {
		contact_substeps = std::max(contact_substeps, std::min(crews_[i].plan.substeps, MAX_CONTACT_SUBSTEPS));
	}
	const Real duration = dt / Real(contact_substeps);
	for (PairHandling &handling : pair_handlings_) {
		handling.begin_substep(world_.gravity(), duration);
	}
	for (int substep = 0; substep < contact_substeps; ++substep) {
		rigid_contacts_.begin_substep(duration);
		for_crews(coupled_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
			const Crew &crew = roster_.crews()[i];
			const CrewState &state = crews_[i];
			if (substep == 0) {
				stepper.begin(crew);
			}
			const int force_substeps = (state.plan.substeps + contact_substeps - 1) / contact_substeps;
			stepper.advance(crew, state.plan, Real(substep) * duration, duration, force_substeps);
			for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
				touching_[state.rows[lane]].measure_extent();
			}
		});
		answer_pairs();
		if (rigid_contacts_.has_bodies()) {
			rigid_contact_count_ += rigid_contacts_.answer(parallel_for_);
		}
	}
	for_crews(coupled_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
		stepper.check(roster_.crews()[i]);
		stepper.end(roster_.crews()[i]);
	});
}

// As they would among soft bodies, so that their fall does not depend on whether one is near.
void Simulator::move_rigid_bodies_alone(Real dt) {
	for (int substep = 0; substep < world_.contact_substeps(); ++substep) {
		rigid_contacts_.begin_substep(dt / Real(world_.contact_substeps()));
	}
}

void Simulator::answer_pairs() {
	if (!bodies_notice_bodies_) {
		return; // coupled by a rigid body alone; the pairs are of another time
	}
	for (std::size_t colour = 0; colour < BroadPhase::COLOURS; ++colour) {
		const std::span<const BroadPhase::Group> groups = broad_phase_.groups(colour);
		const bool may_share_bodies = colour + 1 == BroadPhase::COLOURS;
		const std::size_t tasks =
				may_share_bodies ? 1 : std::clamp<std::size_t>(groups.size() / GROUPS_A_TASK, 1, TASKS);
		run_tasks(parallel_for_, tasks, [&](std::size_t task) {
			for (std::size_t i = groups.size() * task / tasks; i < groups.size() * (task + 1) / tasks; ++i) {
				for (const BodyPair pair : broad_phase_.pairs().subspan(groups[i].begin, groups[i].end - groups[i].begin)) {
					pair_contacts_[task] += pair_handlings_[task].handle(touching_[pair.a], touching_[pair.b]);
				}
			}
		});
	}
}

void Simulator::collect(StepReport &report) {
	for (const std::uint64_t contacts : pair_contacts_) {
		report.pair_contacts += contacts;
	}
	report.contacts += rigid_contact_count_;
	std::vector<std::uint32_t> non_finite;
	for (BodyStepper &stepper : steppers_) {
		const StepCounts &counts = stepper.counts();
		report.substeps += counts.substeps;
		report.contacts += counts.contacts;
		non_finite.insert(non_finite.end(), counts.non_finite.begin(), counts.non_finite.end());
	}
	std::ranges::sort(non_finite);
	non_finite.erase(std::unique(non_finite.begin(), non_finite.end()), non_finite.end());
	for (const std::uint32_t place : non_finite) {
		report.reset_bodies.push_back(world_.id_at(place));
	}
}

} // namespace softbody
