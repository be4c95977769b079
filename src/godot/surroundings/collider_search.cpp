// SPDX-License-Identifier: MIT
// Finds bodies of the engine near soft bodies that are not known yet.
#include "godot/surroundings/collider_search.h"

#include "core/collision/environment_contact_solver.h"
#include "godot/convert.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/variant/dictionary.hpp>

#include <algorithm>

using namespace godot;

namespace softbody {

namespace {

// Bodies in a group. More: the rectangles of neighbors overlap less, but each fits its bodies less closely.
constexpr std::size_t GROUP_SIZE = 64;

// Width up to which bodies are one group, whatever is between them [px]. Larger: more is read that nothing touches.
// Smaller: few bodies in a wide level cost a query each.
constexpr Real GROUP_WIDTH = 2048;

// A group is not divided below this width [px].
constexpr Real LEAST_WIDTH = 16;

// Distance beyond its group's bodies that a query covers [px]: bodies that fly at up to 60 times this a second are
// known before they hit, half of that if all bodies of the group sleep.
constexpr Real MARGIN = 128;

// Most sleeping bodies that are asked for in one tick, and the longest time between two queries [ticks]. Rarer: what
// appears beside a sleeping body is noticed later. The margin grows with that time.
constexpr std::size_t ASLEEP_A_TICK = 1024;
constexpr std::size_t LEAST_INTERVAL = 2;
constexpr std::size_t MOST_INTERVAL = 8;

// Sleeping groups share a query while its rectangle is not larger than theirs, by this factor.
constexpr Real WASTE = Real(1.25);

// Distance from all groups, beyond their margins, at which a body is forgotten [px]. Smaller: bodies that go to and fro
// are read again and again.
constexpr Real NEAR_MARGIN = 512;

// Ticks after which groups are made anew as their bodies have moved apart.
constexpr int64_t REGROUP_INTERVAL = 16;

// Cost of a needless answer over that of a body on the list.
constexpr int64_t NEEDLESS_COST = 6;

// Ticks between two counts of all shapes around a group. Shorter: where shapes are many is known sooner, for 0.1 to 0.5
// ms each in full levels.
constexpr int64_t CROWD_INTERVAL = 64;

// The engine tests 2048 shapes in a query. At most this many known shapes leave room to find others.
constexpr int64_t KNOWN_SHAPES = 1024;
constexpr int32_t FEW_RESULTS = 32;
constexpr int32_t MANY_RESULTS = 1024;
constexpr int MAX_SPLITS = 4;

// The box that a body may reach in one step [px]: its fastest point plus gravity, and a margin for points that springs
// accelerate.
Aabb reach_of(const SoftBodyData &p_body, Vec2 p_gravity, Real p_delta) {
	const Aabb box = sweep_box(p_body.hull(), p_body.velocities(), p_delta);
	return box.grown(length(p_gravity) * p_delta * p_delta + p_body.shape().radius() / 2);
}

} // namespace

ColliderSearch::ColliderSearch() {
	query_shape_ = PhysicsServer2D::get_singleton()->rectangle_shape_create();
	query_.instantiate();
	query_->set_shape_rid(query_shape_);
	query_->set_collide_with_areas(false);
}

ColliderSearch::~ColliderSearch() {
	query_.unref();
	if (PhysicsServer2D *server = PhysicsServer2D::get_singleton()) {
		server->free_rid(query_shape_);
	}
}

// Commands wait in a queue. A question that the server's thread answers comes after them.
void ColliderSearch::await_server() const {
	PhysicsServer2D::get_singleton()->shape_get_type(query_shape_);
}

void ColliderSearch::follow(const WorldData &p_world, std::span<const uint32_t> p_changed, double p_delta) {
	const std::size_t count = p_world.soft_bodies().size();
	const bool is_rearranged = arrangement_ != p_world.change_counts().arrangement;
	bool is_changed = count != followed_.size();
	bool is_moving = false;
	followed_.resize(count);
	arrangement_ = p_world.change_counts().arrangement;
	if (is_rearranged) {
		for (std::size_t row = 0; row < count; row++) {
			is_changed |= follow(p_world, row, Real(p_delta), is_moving);
		}
	} else {
		for (const uint32_t row : p_changed) {
			is_changed |= follow(p_world, row, Real(p_delta), is_moving);
		}
	}
	tick_++;
	is_regrouped_ = is_changed || (is_moving && tick_ - regrouped_ >= REGROUP_INTERVAL);
	if (is_regrouped_) {
		regroup();
	}
	measure_groups();
}

// True if the row has another body than before, or one that has begun or ceased to collide.
bool ColliderSearch::follow(const WorldData &p_world, std::size_t p_row, Real p_delta, bool &r_is_moving) {
	const SoftBodyData &body = p_world.soft_bodies()[p_row];
	Followed &followed = followed_[p_row];
	const bool is_new = !(followed.id == p_world.id_at(p_row));
	const uint32_t mask = body.is_active() ? body.settings().collision_mask : 0;
	const bool is_changed = is_new || (mask == 0) != (followed.mask == 0);
	followed.id = p_world.id_at(p_row);
	if (!is_changed && followed.mask == mask && (mask == 0 || (followed.asleep && body.is_asleep()))) {
		return false;
	}
	followed.mask = mask;
	followed.asleep = body.is_asleep();
	if (followed.group != NO_GROUP) {
		groups_[followed.group].is_current = false;
	}
	if (mask == 0) {
		return is_changed;
	}
	const Aabb reach = reach_of(body, p_world.gravity(), p_delta);
	if (is_finite(reach.max - reach.min)) { // otherwise the step resets the body, near its place
		followed.reach = reach;
	}
	r_is_moving |= !followed.asleep;
	return is_changed;
}

void ColliderSearch::regroup() {
	regrouped_ = tick_;
	groups_.clear();
	order_.clear();
	for (std::size_t i = 0; i < followed_.size(); i++) {
		Followed &followed = followed_[i];
		followed.group = NO_GROUP;
		if (followed.mask != 0) {
			order_.emplace_back(followed.reach.center(), uint32_t(i));
		}
	}
	divide(0, order_.size());
}

// Halves the longer side, so that distant bodies are soon separated.
void ColliderSearch::divide(std::size_t p_begin, std::size_t p_end) {
	if (p_begin == p_end) {
		return;
	}
	Aabb box;
	for (std::size_t i = p_begin; i < p_end; i++) {
		box.include(order_[i].first);
	}
	const Vec2 size = box.max - box.min;
	const Real width = std::max(size.x, size.y);
	if ((p_end - p_begin > GROUP_SIZE && width > LEAST_WIDTH) || width > GROUP_WIDTH) {
		const bool along_x = size.x >= size.y;
		const Real middle = along_x ? (box.min.x + box.max.x) / 2 : (box.min.y + box.max.y) / 2;
		const auto begin = order_.begin();
		const auto half = std::partition(begin + std::ptrdiff_t(p_begin), begin + std::ptrdiff_t(p_end),
				[&](const auto &p_body) { return (along_x ? p_body.first.x : p_body.first.y) < middle; });
		const std::size_t split = std::size_t(half - begin);
		if (split > p_begin && split < p_end) { // false where coordinates are too coarse to separate
			divide(p_begin, split);
			divide(split, p_end);
			return;
		}
	}
	for (std::size_t i = p_begin; i < p_end; i++) {
		followed_[order_[i].second].group = uint32_t(groups_.size());
	}
	Group group;
	group.begin = p_begin;
	group.end = p_end;
	groups_.push_back(group);
}

void ColliderSearch::measure_groups() {
	asleep_count_ = 0;
	for (Group &group : groups_) {
		if (!group.is_current) {
			group.is_current = true;
			group.box = {};
			group.mask = 0;
			group.asleep = true;
			for (std::size_t i = group.begin; i < group.end; i++) {
				const Followed &followed = followed_[order_[i].second];
				group.box.include(followed.reach);
				group.mask |= followed.mask;
				group.asleep &= followed.asleep;
			}
			group.box = group.box.grown(MARGIN);
		}
		asleep_count_ += group.asleep ? group.end - group.begin : 0;
	}
}

void ColliderSearch::clear_counts() {
	for (Group &group : groups_) {
		group.shapes = 0;
	}
}

void ColliderSearch::count_shapes(const Aabb &p_box, int64_t p_count) {
	for (Group &group : groups_) {
		if (group.box.overlaps(p_box)) {
			group.shapes += p_count;
		}
	}
}

bool ColliderSearch::is_near(const Aabb &p_box) const {
	const Aabb box = p_box.grown(NEAR_MARGIN);
	return std::ranges::any_of(groups_, [&](const Group &p_group) { return p_group.box.overlaps(box); });
}

bool ColliderSearch::is_list_due(int64_t p_known) const {
	const int64_t size = p_known + int64_t(hull_proxy_count());
	const int64_t changes = int64_t(hull_proxies_made() - listed_proxies_);
	return !is_list_valid_ || NEEDLESS_COST * needless_ > size || (changes > 8 && changes * 8 > size);
}

void ColliderSearch::exclude(TypedArray<RID> p_known) {
	append_hull_proxies(p_known);
	query_->set_exclude(p_known);
	is_list_valid_ = true;
	needless_ = 0;
	listed_proxies_ = hull_proxies_made();
}

void ColliderSearch::query(PhysicsDirectSpaceState2D *p_state, const Aabb &p_box, int p_splits, int p_depth,
		std::vector<FoundShape> &r_found) {
	const Vec2 center = p_box.center();
	if (p_splits == 0) {
		PhysicsServer2D::get_singleton()->shape_set_data(query_shape_, to_godot(p_box.half_size()));
		await_server(); // The query reads the shape at once.
		query_->set_transform(transform_to(center));
		TypedArray<Dictionary> hits = p_state->intersect_shape(query_, FEW_RESULTS);
		if (hits.size() >= FEW_RESULTS) {
			hits = p_state->intersect_shape(query_, MANY_RESULTS);
		}
		if (hits.size() < MANY_RESULTS || p_depth >= MAX_SPLITS) {
			for (int64_t i = 0; i < hits.size(); i++) {
				const Dictionary hit = hits[i];
				r_found.push_back({ hit["rid"], int32_t(hit["shape"]) });
			}
			return;
		}
	}
	const int splits = std::max(0, p_splits - 1);
	query(p_state, { p_box.min, center }, splits, p_depth + 1, r_found);
	query(p_state, { { center.x, p_box.min.y }, { p_box.max.x, center.y } }, splits, p_depth + 1, r_found);
	query(p_state, { { p_box.min.x, center.y }, { center.x, p_box.max.y } }, splits, p_depth + 1, r_found);
	query(p_state, { center, p_box.max }, splits, p_depth + 1, r_found);
}

int64_t ColliderSearch::interval() const {
	return int64_t(std::clamp(asleep_count_ / ASLEEP_A_TICK, LEAST_INTERVAL, MOST_INTERVAL));
}

std::size_t ColliderSearch::end_of_run(std::size_t p_begin, Aabb &r_box) const {
	const auto area = [](const Aabb &p_box) { return (p_box.max.x - p_box.min.x) * (p_box.max.y - p_box.min.y); };
	r_box = groups_[p_begin].box;
	Real covered = area(r_box);
	std::size_t end = p_begin + 1;
	for (; groups_[p_begin].asleep && end < groups_.size() && groups_[end].asleep; end++) {
		Aabb box = r_box;
		box.include(groups_[end].box);
		covered += area(groups_[end].box);
		if (area(box) > WASTE * covered || groups_[end].end - groups_[p_begin].begin > ASLEEP_A_TICK) {
			break;
		}
		r_box = box;
	}
	return end;
}

// One count in this many ticks, group by group, and one in each tick where there are many shapes.
void ColliderSearch::watch_crowds(PhysicsDirectSpaceState2D *p_state) {
	if (crowds_.is_done() && !groups_.empty() && tick_ % CROWD_INTERVAL == 1) {
		watched_group_ = watched_group_ + 1 < groups_.size() ? watched_group_ + 1 : 0;
		crowds_.watch(groups_[watched_group_].box);
	}
	crowds_.look(p_state);
}

void ColliderSearch::find(PhysicsDirectSpaceState2D *p_state, std::vector<FoundShape> &r_found) {
	watch_crowds(p_state);
	Aabb box;
	for (std::size_t begin = 0, end = 0; begin < groups_.size(); begin = end) {
		end = end_of_run(begin, box);
		const std::span<Group> run = std::span(groups_).subspan(begin, end - begin);
		if (run.front().asleep) {
			const auto is_due = [&](const Group &p_group) { return tick_ - p_group.asked >= interval(); };
			if (!is_regrouped_ && std::ranges::none_of(run, is_due)) {
				continue;
			}
			box = box.grown(MARGIN * (Real(interval()) / Real(LEAST_INTERVAL) - 1));
		}
		int64_t shapes = 0;
		uint32_t mask = 0;
		for (Group &group : run) {
			group.asked = is_regrouped_ ? tick_ - int64_t(begin) % interval() : tick_; // spreads them over the ticks
			shapes += group.shapes + int64_t(group.end - group.begin);
			mask |= group.mask;
		}
		int splits = crowds_.splits(box, MAX_SPLITS);
		for (shapes >>= 2 * splits; shapes > KNOWN_SHAPES && splits < MAX_SPLITS; splits++) {
			shapes /= 4;
		}
		query_->set_collision_mask(mask);
		query(p_state, box, splits, 0, r_found);
	}
}

} // namespace softbody
