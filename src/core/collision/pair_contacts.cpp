// SPDX-License-Identifier: MIT
// Contacts between soft bodies through a step.
#include "core/collision/pair_contacts.h"

#include "core/base/constants.h"
#include "core/collision/environment_contact_solver.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

constexpr std::size_t BODIES_A_TASK = 64;
constexpr std::size_t GROUPS_A_TASK = 1;

// Number of pairs by which the data of a body is prefetched ahead, and then its points.
constexpr std::uint32_t BODIES_AHEAD = 8;
constexpr std::uint32_t POINTS_AHEAD = 4;
// Fewer bodies stay in the cache.
constexpr std::size_t MANY_BODIES = 1500;

// With too many bodies for the cache, contacts wait for memory. Prefetching changes only the time. Always inline: GCC
// finds that a call has no effect and removes it.
#if defined(__GNUC__) || defined(__clang__)
[[gnu::always_inline]]
#endif
inline void prefetch_pairs(std::span<const SolverBody> bodies, std::span<const BodyPair> pairs, std::uint32_t now) {
#if defined(__GNUC__) || defined(__clang__)
	constexpr std::size_t LINE = 64; // bytes of a cache line on nearly all processors
	if (now + BODIES_AHEAD < pairs.size()) {
		const BodyPair pair = pairs[now + BODIES_AHEAD];
		for (const std::uint32_t active_index : { pair.a, pair.b }) {
			const char *body = reinterpret_cast<const char *>(&bodies[active_index]);
			__builtin_prefetch(body);
			__builtin_prefetch(body + LINE);
		}
	}
	if (now + POINTS_AHEAD < pairs.size()) {
		const BodyPair pair = pairs[now + POINTS_AHEAD];
		for (const std::uint32_t active_index : { pair.a, pair.b }) {
			const char *points = reinterpret_cast<const char *>(bodies[active_index].positions.data()); // velocities follow
			__builtin_prefetch(points, 1);
			__builtin_prefetch(points + LINE, 1);
			__builtin_prefetch(points + 2 * LINE, 1);
			__builtin_prefetch(bodies[active_index].before.data());
		}
	}
#else
	(void)bodies;
	(void)pairs;
	(void)now;
#endif
}

constexpr std::uint32_t NOT_ACTIVE = UINT32_MAX; // removed, or inactive

std::uint32_t active_index_of(const PairBodies &bodies, BodyId id) {
	const SoftBodyData *body = bodies.world.find(id);
	if (body == nullptr) {
		return NOT_ACTIVE;
	}
	const std::uint32_t body_index = std::uint32_t(body - bodies.world.soft_bodies().data());
	if (body_index < bodies.body_indices.size() && bodies.body_indices[body_index] == body_index) {
		return body_index; // all bodies before it are active, too
	}
	const auto found = std::ranges::lower_bound(bodies.body_indices, body_index);
	return found != bodies.body_indices.end() && *found == body_index ? std::uint32_t(found - bodies.body_indices.begin()) : NOT_ACTIVE;
}

} // namespace

PairContacts::PairContacts() :
		solvers_(MOST_SLICES), contacts_(MOST_SLICES) {}

void PairContacts::begin_arranging() {
	circles_.clear();
	layers_ = 0;
	masks_ = 0;
	bounces_ = false;
	resists_rolling_ = false;
}

void PairContacts::add_body(const BodySettings &settings) {
	circles_.push_back({ {}, 0, settings.collision_layer, settings.collision_mask });
	layers_ |= settings.collision_layer;
	masks_ |= settings.collision_mask;
	bounces_ |= settings.restitution > 0;
	resists_rolling_ |= settings.rolling_resistance > 0;
}

void PairContacts::forget_step() {
	is_used_ = false;
	std::ranges::fill(contacts_, 0);
}

void PairContacts::begin_step(const PairBodies &bodies, Real dt, std::uint64_t version,
		std::span<const BodyPair> separated, const ParallelFor &parallel_for) {
	is_used_ = circles_.size() > 1 && (layers_ & masks_) != 0;
	if (!is_used_) {
		return;
	}
	run_slices(parallel_for, circles_.size(), BODIES_A_TASK, [&](std::size_t, std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i) {
			SolverBody &body = bodies.solver_bodies[i];
			circles_[i].rests = bodies.asleep[i] != 0;
			body.pace = bodies.asleep[i] ? Real(0) : fastest(body.velocities);
			const Circle circle = bodies.asleep[i] ? Circle{ body.center, body.radius } : sweep_circle(body.hull(), body.pace, dt);
			circles_[i].center = circle.center;
			circles_[i].radius = circle.radius;
		}
	});
	find_exceptions(bodies, separated);
	broad_phase_.update(circles_, version, parallel_for, exceptions_);
	has_pair_.assign(circles_.size(), 0);
	for (const BodyPair pair : broad_phase_.pairs()) {
		has_pair_[pair.a] = 1;
		has_pair_[pair.b] = 1;
	}
	if (bounces_) {
		begin_bounces(bodies);
		recall_touches(bodies);
	}
	touched_.assign(broad_phase_.pairs().size(), 0);
	impulses_.assign(broad_phase_.pairs().size(), 0);
	candidates_.assign(broad_phase_.pairs().size(), {});
}

void PairContacts::find_exceptions(const PairBodies &bodies, std::span<const BodyPair> separated) {
	exceptions_.assign(separated.begin(), separated.end());
	for (const auto &[a, b] : bodies.world.collision_exceptions()) {
		const std::uint32_t active_index = active_index_of(bodies, a);
		const std::uint32_t other = active_index_of(bodies, b);
		if (active_index != NOT_ACTIVE && other != NOT_ACTIVE) {
			exceptions_.push_back({ std::min(active_index, other), std::max(active_index, other) });
		}
	}
	std::ranges::sort(exceptions_);
}

void PairContacts::begin_bounces(const PairBodies &bodies) {
	const Vec2 gravity = bodies.world.gravity();
	for (std::uint32_t active_index = 0; active_index < circles_.size(); ++active_index) {
		if (!has_pair_[active_index]) {
			continue;
		}
		SolverBody &body = bodies.solver_bodies[active_index];
		const SoftBodyData &data = bodies.data(active_index);
		const bool falls = body.inverse_mass > 0 && !bodies.asleep[active_index];
		body.acceleration = falls ? data.total_acceleration(gravity) : Vec2{};
		body.pull = data.acceleration() == Vec2{} ? length(gravity) : std::max(length(gravity), length(data.total_acceleration(gravity)));
		if (bodies.asleep[active_index]) { // is not stepped, and so keeps this for the step
			body.mass_center = measure_translation(data).center;
			body.mass_velocity = {};
		}
	}
}

void PairContacts::recall_touches(const PairBodies &bodies) {
	open_.clear();
	for (std::uint32_t active_index = 0; active_index < circles_.size(); ++active_index) {
		for (const PairMemory &memory : bodies.data(active_index).pair_memories()) {
			const std::uint32_t other = active_index_of(bodies, memory.other);
			if (other != NOT_ACTIVE) {
				open_.push_back({ { std::min(active_index, other), std::max(active_index, other) }, memory.touch });
			}
		}
	}
	touches_.assign(pairs().size(), {});
	if (open_.empty()) {
		return;
	}
	const auto first = [](const Open &open) { return open.pair.a; };
	if (!std::ranges::is_sorted(open_, {}, first)) { // bodies have changed places in the world
		std::ranges::sort(open_, {}, &Open::pair);
	}
	open_begins_.assign(circles_.size() + 1, 0);
	for (const Open &open : open_) {
		++open_begins_[open.pair.a + 1];
	}
	std::partial_sum(open_begins_.begin(), open_begins_.end(), open_begins_.begin());
	for (std::size_t i = 0; i < touches_.size(); ++i) {
		const BodyPair pair = pairs()[i];
		for (std::uint32_t k = open_begins_[pair.a]; k < open_begins_[pair.a + 1]; ++k) {
			if (open_[k].pair.b == pair.b) {
				touches_[i] = open_[k].touch;
				break;
			}
		}
	}
}

void PairContacts::begin_substeps(Real h) {
	h_ = h;
	for (PairContactSolver &handling : solvers_) {
		handling.begin_substep(h);
	}
}

void PairContacts::solve(const PairBodies &bodies, const SubstepGroup &group, int substeps_left, const ParallelFor &parallel_for) {
	if (!is_used_) {
		return; // coupled only through a rigid body
	}
	const bool has_many = bodies.solver_bodies.size() > MANY_BODIES;
	for (std::size_t phase = 0; phase < broad_phase_.phase_count(); ++phase) {
		const std::span<const BroadPhase::Group> groups = broad_phase_.groups(phase);
		if (groups.empty()) {
			continue;
		}
		run_slices(parallel_for, groups.size(), GROUPS_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
			PairContactSolver &handling = solvers_[task];
			std::uint64_t all_contacts = 0;
			const std::span<const BodyPair> ours = pairs().first(groups[end - 1].end);
			for (std::uint32_t k = groups[begin].begin; k < ours.size(); ++k) {
				if (has_many) {
					prefetch_pairs(bodies.solver_bodies, ours, k);
				}
				const BodyPair pair = ours[k];
				if (!group.has(pair.a) && !group.has(pair.b)) {
					continue;
				}
				const std::size_t contacts = handling.handle(bodies.solver_bodies[pair.a], bodies.solver_bodies[pair.b], candidates_[k], substeps_left);
				all_contacts += contacts;
				touched_[k] |= char(contacts > 0);
				impulses_[k] += handling.last_impulse();
				if (bounces_) {
					follow_pair_bounce(bodies.solver_bodies[pair.a], bodies.solver_bodies[pair.b], handling.last_push(), touches_[k], h_);
				}
			}
			contacts_[task] += all_contacts;
		});
	}
}

void PairContacts::resist_rolling(const PairBodies &bodies) {
	const std::span<const BodyPair> all = pairs();
	for (std::size_t i = 0; i < all.size(); ++i) {
		const auto [a, b] = all[i];
		if (impulses_[i] > 0 && !bodies.asleep[a] && !bodies.asleep[b]) {
			resist_pair_rolling(bodies.solver_bodies[a], bodies.solver_bodies[b], impulses_[i]);
		}
	}
}

void PairContacts::end_step(const PairBodies &bodies) {
	if (!is_used_ || !bounces_) {
		return;
	}
	for (std::uint32_t active_index = 0; active_index < circles_.size(); ++active_index) {
		bodies.data(active_index).pair_memories().clear();
	}
	const std::span<const BodyPair> all = pairs();
	for (std::size_t i = 0; i < all.size(); ++i) {
		if (touches_[i].touching || touches_[i].missing > 0) {
			bodies.data(all[i].a).pair_memories().push_back({ bodies.world.id_at(bodies.body_indices[all[i].b]), touches_[i] });
		}
	}
}

std::uint64_t PairContacts::contact_count() const {
	return std::accumulate(contacts_.begin(), contacts_.end(), std::uint64_t(0));
}

} // namespace softbody
