// SPDX-License-Identifier: MIT
// Finds bodies of the engine near soft bodies that are not known yet.
#include "godot/surroundings/collider_search.h"

#include "core/collision/environment_contact_solver.h"
#include "godot/convert.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/typed_array.hpp>

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

// Distance from all groups, beyond their margins, at which a body is forgotten [px]. Smaller: bodies that go to and fro
// are read again and again.
constexpr Real NEAR_MARGIN = 512;

// Ticks after which groups are made anew as their bodies have moved apart.
constexpr int64_t REGROUP_INTERVAL = 16;

// Cost of a needless answer over that of a body on the list.
constexpr int64_t NEEDLESS_COST = 6;

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

void ColliderSearch::follow(const WorldData &p_world, double p_delta) {
	const std::span<const SoftBodyData> bodies = p_world.soft_bodies();
	bool is_changed = bodies.size() != followed_.size();
	bool is_moving = false;
	followed_.resize(bodies.size());
	for (std::size_t i = 0; i < bodies.size(); i++) {
		const SoftBodyData &body = bodies[i];
		Followed &followed = followed_[i];
		const bool is_new = !(followed.id == p_world.id_at(i));
		const uint32_t mask = body.is_active() ? body.settings().collision_mask : 0;
		is_changed |= is_new || (mask == 0) != (followed.mask == 0);
		followed.id = p_world.id_at(i);
		followed.mask = mask;
		if (mask == 0 || (!is_new && followed.asleep && body.is_asleep())) {
			continue;
		}
		followed.asleep = body.is_asleep();
		const Aabb reach = reach_of(body, p_world.gravity(), Real(p_delta));
		if (is_finite(reach.max - reach.min)) { // otherwise the step resets the body, near its place
			followed.reach = reach;
		}
		is_moving |= !followed.asleep;
	}
	tick_++;
	is_regrouped_ = is_changed || (is_moving && tick_ - regrouped_ >= REGROUP_INTERVAL);
	if (is_regrouped_) {
		regroup();
	}
	measure_groups();
}

void ColliderSearch::regroup() {
	regrouped_ = tick_;
	groups_.clear();
	order_.clear();
	for (std::size_t i = 0; i < followed_.size(); i++) {
		Followed &followed = followed_[i];
		followed.group = NO_GROUP;
		if (followed.mask != 0) {
			order_.emplace_back((followed.reach.min + followed.reach.max) * Real(0.5), uint32_t(i));
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
	for (Group &group : groups_) {
		group.box = {};
		group.mask = 0;
		group.asleep = true;
		for (std::size_t i = group.begin; i < group.end; i++) {
			const Followed &followed = followed_[order_[i].second];
			group.box.include(followed.reach.min);
			group.box.include(followed.reach.max);
			group.mask |= followed.mask;
			group.asleep &= followed.asleep;
		}
		group.box = group.box.grown(MARGIN);
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

void ColliderSearch::exclude(const std::vector<RID> &p_known) {
	TypedArray<RID> list;
	for (const RID &body : p_known) {
		list.push_back(body);
	}
	append_hull_proxies(list);
	query_->set_exclude(list);
	is_list_valid_ = true;
	needless_ = 0;
	listed_proxies_ = hull_proxies_made();
}

void ColliderSearch::query(PhysicsDirectSpaceState2D *p_state, const Aabb &p_box, int p_splits, int p_depth,
		std::vector<FoundShape> &r_found) {
	const Vector2 middle = to_godot((p_box.max + p_box.min) * Real(0.5));
	if (p_splits == 0) {
		PhysicsServer2D::get_singleton()->shape_set_data(query_shape_, to_godot((p_box.max - p_box.min) * Real(0.5)));
		query_->set_transform(Transform2D(0, middle));
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
	const Vec2 center = to_core(middle);
	const int splits = std::max(0, p_splits - 1);
	query(p_state, { p_box.min, center }, splits, p_depth + 1, r_found);
	query(p_state, { { center.x, p_box.min.y }, { p_box.max.x, center.y } }, splits, p_depth + 1, r_found);
	query(p_state, { { p_box.min.x, center.y }, { center.x, p_box.max.y } }, splits, p_depth + 1, r_found);
	query(p_state, { center, p_box.max }, splits, p_depth + 1, r_found);
}

void ColliderSearch::find(PhysicsDirectSpaceState2D *p_state, std::vector<FoundShape> &r_found) {
	for (std::size_t i = 0; i < groups_.size(); i++) {
		const Group &group = groups_[i];
		if (group.asleep && (tick_ + int64_t(i)) % 2 != 0 && !is_regrouped_) {
			continue;
		}
		int splits = 0;
		for (int64_t shapes = group.shapes + int64_t(group.end - group.begin); shapes > KNOWN_SHAPES && splits < MAX_SPLITS; splits++) {
			shapes /= 4;
		}
		query_->set_collision_mask(group.mask);
		query(p_state, group.box, splits, 0, r_found);
	}
}

} // namespace softbody
