// SPDX-License-Identifier: MIT
// The active bodies of a world: their data for a step, which are awake, and which share a batch.
#include "core/dynamics/active_bodies.h"

#include "core/base/hash.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/model/body_frame.h"
#include "core/model/force_coefficients.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace softbody {

namespace {

// Lanes share inverse masses. XPBD bodies need different times for their passes. A body has its own memory of one-way colliders and
// contacts with itself. A chain is solved by itself.
bool can_share_a_batch(const SoftBodyData &body) {
	return body.is_free() && body.ignored_tags().empty() && body.settings().integrator != Integrator::XPBD &&
			!body.settings().self_collision && body.shape().chain() == nullptr;
}

} // namespace

/// Numbers kinds and families in the order of their first bodies.
class ActiveBodies::KindFinder {
public:
	explicit KindFinder(std::vector<Kind> &kinds) : kinds_(kinds) {}

	// Expected O(families of the shape): a scene may have as many kinds as bodies, by their coefficients.
	std::uint32_t find(const SoftBodyData &body) {
		const bool single = !can_share_a_batch(body);
		const std::uint32_t next = std::uint32_t(kinds_.size());
		if (single) {
			kinds_.push_back({ &body.shape(), &body.settings(), family_count_++, true });
			return next;
		}
		const std::uint64_t key = key_of(body);
		const auto [first, last] = of_key_.equal_range(key);
		for (auto entry = first; entry != last; ++entry) {
			const Kind &kind = kinds_[entry->second];
			if (kind.shape == &body.shape() && *kind.settings == body.settings()) {
				return entry->second;
			}
		}
		of_key_.emplace(key, next);
		kinds_.push_back({ &body.shape(), &body.settings(), family_of(body, next), false });
		return next;
	}

private:
	static std::uint64_t key_of(const SoftBodyData &body) {
		Hash hash;
		hash.add(std::uint64_t(reinterpret_cast<std::uintptr_t>(&body.shape())));
		ForceCoefficients<Real> coefficients;
		for_each_coefficient(coefficients, [&](Real &, Real BodySettings::*setting) { hash.add(body.settings().*setting); });
		return hash.value();
	}
	std::uint32_t family_of(const SoftBodyData &body, std::uint32_t kind) {
		const auto [first, last] = of_shape_.equal_range(&body.shape());
		for (auto entry = first; entry != last; ++entry) {
			if (can_stand_side_by_side(*kinds_[entry->second].settings, body.settings())) {
				return kinds_[entry->second].family;
			}
		}
		of_shape_.emplace(&body.shape(), kind);
		return family_count_++;
	}

	std::vector<Kind> &kinds_;
	std::uint32_t family_count_ = 0;
	std::unordered_multimap<std::uint64_t, std::uint32_t> of_key_; ///< kinds that may share a batch
	std::unordered_multimap<const SoftBodyShape *, std::uint32_t> of_shape_; ///< the first kinds of the families
};

bool ActiveBodies::update(Real dt) {
	const bool is_rearranged = version_ == 0 || arrangement_ != world_.change_counts().arrangement;
	const bool with_contacts = world_.has_environment();
	if (!is_rearranged && dt_ == dt && with_contacts_ == with_contacts) {
		return false;
	}
	version_ += std::uint64_t(is_rearranged);
	arrangement_ = world_.change_counts().arrangement;
	dt_ = dt;
	with_contacts_ = with_contacts;
	solver_bodies_.clear();
	body_indices_.clear();
	inactive_bodies_.clear();
	kind_of_.clear();
	plan_of_.clear();
	states_.clear();
	has_touch_.clear();
	first_hull_point_.clear();
	kinds_.clear();
	plans_.clear();
	pressed_.clear();
	frozen_count_ = 0;
	KindFinder finder(kinds_);
	std::size_t hull_points = 0;
	for (std::uint32_t body_index = 0; body_index < world_.soft_bodies().size(); ++body_index) {
		if (!world_.soft_bodies()[body_index].is_active()) {
			inactive_bodies_.push_back(body_index);
			continue;
		}
		first_hull_point_.push_back(hull_points);
		hull_points += world_.soft_bodies()[body_index].shape().hull_count();
		add_body(body_index, finder, dt);
	}
	before_.resize(hull_points);
	sweep_start_.resize(hull_points);
	for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
		plans_.push_back(plan_near_rest(plans_[kind], *kinds_[kind].shape, *kinds_[kind].settings, dt));
	}
	order_kinds();
	for (const std::uint32_t active_index : pressed_) {
		plan_of_[active_index] = std::uint32_t(plans_.size());
		plans_.push_back(plans_[kind_of_[active_index]]);
	}
	for (std::uint32_t i = 0; i < count(); ++i) {
		const std::size_t hull_count = kinds_[kind_of_[i]].shape->hull_count();
		solver_bodies_[i].implicit_share = plan(i).implicit_share;
		solver_bodies_[i].velocity_leads = integrator_traits(plan(i).integrator).velocity_leads;
		solver_bodies_[i].before = std::span(before_).subspan(first_hull_point_[i], hull_count);
	}
	has_self_collision_ = std::ranges::any_of(kinds_, [](const Kind &kind) { return kind.settings->self_collision; });
	has_monitored_ = std::ranges::any_of(kinds_, [](const Kind &kind) { return kind.settings->contact_monitor; });
	resting_.assign(count(), 0);
	resting_count_ = 0;
	awake_is_current_ = false;
	return true;
}

// Rows in the order of families, and of substeps within one.
void ActiveBodies::order_kinds() {
	std::vector<std::uint32_t> order(kinds_.size());
	std::iota(order.begin(), order.end(), 0u);
	const auto rank = [this](std::uint32_t kind) {
		const std::size_t near_rest = kinds_.size() + kind;
		return std::tuple(kinds_[kind].family, plans_[kind].integrator, plans_[kind].substeps, plans_[near_rest].substeps);
	};
	std::ranges::stable_sort(order, {}, rank);
	row_of_kind_.resize(kinds_.size());
	row_count_ = 0;
	for (std::size_t i = 0; i < order.size(); ++i) {
		row_count_ += std::uint32_t(i == 0 || rank(order[i]) != rank(order[i - 1]));
		row_of_kind_[order[i]] = row_count_ - 1;
	}
}

void ActiveBodies::add_body(std::uint32_t body_index, KindFinder &finder, Real dt) {
	SoftBodyData &body = world_.soft_bodies()[body_index];
	const BodySettings &settings = body.settings();
	const std::uint32_t kind = finder.find(body);
	if (kind == plans_.size()) {
		plans_.push_back(plan_substeps(body, dt, with_contacts_));
	}
	if (settings.pressure_stiffness > 0) {
		pressed_.push_back(count());
	}
	frozen_count_ += body.is_frozen();
	body_indices_.push_back(body_index);
	kind_of_.push_back(kind);
	plan_of_.push_back(kind);
	states_.push_back(body.mutable_positions().data());
	has_touch_.push_back(char(body.touch_memory().touching));
	SolverBody &solver_body = solver_bodies_.emplace_back();
	solver_body.positions = body.mutable_positions();
	solver_body.velocities = body.mutable_velocities();
	solver_body.inverse_masses = body.inverse_masses();
	solver_body.inverse_mass = body.is_free() ? 1 / body.shape().total_mass() : Real(0);
	solver_body.width = body.shape().width();
	solver_body.friction = signed_friction(settings.friction, settings.rough);
	solver_body.restitution = signed_restitution(settings.restitution, settings.absorbent);
	solver_body.rolling_resistance = settings.rolling_resistance;
	solver_body.rest_radius = body.shape().radius();
	solver_body.body_index = body_index;
	solver_body.is_monitored = settings.contact_monitor;
}

void ActiveBodies::plan_pressure(Real dt) {
	for (const std::uint32_t active_index : pressed_) {
		if (!is_resting(active_index)) {
			plans_[plan_of_[active_index]] = plan_substeps(data(active_index), dt, with_contacts_);
		}
	}
}

namespace {

bool is_near_rest(const SoftBodyData &body) {
	const BodyFrame frame = measure_frame(body);
	const std::span<const Vec2> rest = body.shape().rest_positions();
	Real farthest = 0;
	for (std::size_t i = 0; i < rest.size(); ++i) {
		farthest = std::max(farthest, length_squared(body.positions()[i] - frame.center - frame.rotation.apply(rest[i])));
	}
	const Real most = CALM_STRAIN * body.shape().radius();
	return farthest <= most * most;
}

} // namespace

void ActiveBodies::plan_near_rest_shapes(std::span<const std::uint32_t> listed, const ParallelFor &parallel_for) {
	constexpr std::size_t BODIES_A_TASK = 64;
	const std::uint32_t kinds = std::uint32_t(kinds_.size());
	run_slices(parallel_for, listed.size(), BODIES_A_TASK, [&](std::size_t, std::size_t begin, std::size_t end) {
		for (const std::uint32_t i : listed.subspan(begin, end - begin)) {
			const std::uint32_t kind = kind_of_[i];
			if (plan_of_[i] < 2 * kinds && plans_[kind].substeps != plans_[kinds + kind].substeps) {
				plan_of_[i] = is_near_rest(data(i)) ? kinds + kind : kind;
			}
		}
	});
}

std::span<const std::uint32_t> ActiveBodies::awake() {
	if (!awake_is_current_) {
		awake_is_current_ = true;
		starts_.assign(row_count_ + 1, 0);
		for (std::uint32_t i = 0; i < count(); ++i) {
			starts_[row_of_kind_[kind_of_[i]] + 1] += std::uint32_t(!is_resting(i));
		}
		for (std::size_t row = 1; row < starts_.size(); ++row) {
			starts_[row] += starts_[row - 1];
		}
		awake_.resize(count() - resting_count_);
		for (std::uint32_t i = 0; i < count(); ++i) {
			if (!is_resting(i)) {
				awake_[starts_[row_of_kind_[kind_of_[i]]]++] = i;
			}
		}
	}
	return awake_;
}

void ActiveBodies::set_resting(std::uint32_t active_index, bool resting) {
	resting_count_ += std::size_t(resting) - std::size_t(resting_[active_index]);
	resting_[active_index] = resting;
	awake_is_current_ = false;
	if (!resting) {
		return;
	}
	SoftBodyData &body = data(active_index);
	body.touch_memory() = {};
	has_touch_[active_index] = 0;
	body.pair_memories().clear();
	std::ranges::fill(body.mutable_velocities(), Vec2{});
	std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	solver_bodies_[active_index].begin_step();
	solver_bodies_[active_index].measure_extent();
}

bool ActiveBodies::is_alike(std::uint32_t a, std::uint32_t b, int parts) const {
	if (plan_of_[a] == plan_of_[b]) {
		return true; // one plan belongs to one kind
	}
	const SubstepPlan &plan_a = plan(a);
	const SubstepPlan &plan_b = plan(b);
	// Plans of XPBD differ in more than substeps.
	return kinds_[kind_of_[a]].family == kinds_[kind_of_[b]].family && plan_a.integrator == plan_b.integrator &&
			plan_a.integrator != Integrator::XPBD && substeps_in_slice(plan_a, parts) == substeps_in_slice(plan_b, parts);
}

Batch ActiveBodies::batch_at(std::span<const std::uint32_t> list, int parts) const {
	const Kind &kind = kinds_[kind_of_[list[0]]];
	const std::size_t most = kind.single ? 1 : std::min(list.size(), WIDE_WIDTH);
	std::size_t alike = 1;
	while (alike < most && is_alike(list[0], list[alike], parts)) {
		++alike;
	}
	Batch batch;
	batch.shape = kind.shape;
	batch.settings = kind.settings;
	batch.plan = &plan(list[0]);
	batch.count = std::uint32_t(alike < PACK_WIDTH ? 1 : alike / PACK_WIDTH * PACK_WIDTH);
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		batch.active_indices[lane] = list[lane];
		batch.body_indices[lane] = body_indices_[list[lane]];
		batch.states[lane] = states_[list[lane]];
		batch.own_settings[lane] = kinds_[kind_of_[list[lane]]].settings;
		batch.are_unlike = batch.are_unlike || batch.own_settings[lane] != batch.settings;
	}
	return batch;
}

void ActiveBodies::prefetch(std::span<const std::uint32_t> list, std::size_t bodies, StatePrefetch &prefetch) const {
	for (std::size_t i = 0; i < std::min(list.size(), bodies); ++i) {
		prefetch.add(states_[list[i]], kinds_[kind_of_[list[0]]].shape->point_count());
	}
}

} // namespace softbody
