// SPDX-License-Identifier: MIT
// Hands bodies of Godot's physics server to the core.
#include "godot/surroundings/environment_reader.h"

#include "core/model/internal_edges.h"
#include "godot/convert.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <algorithm>
#include <unordered_map>

using namespace godot;

namespace softbody {

namespace {

// Shapes that are read again each tick, a body counting as one more, to notice that one of them, or a material, was changed. More: changes
// are noticed sooner, for about a microsecond each.
constexpr int REREAD_SHAPES = 16;

// Bodies checked each tick for changes. More: changes are noticed sooner, for a fifth of a microsecond each.
constexpr int LOOKS = 160;

// Ticks after which distant bodies are forgotten. Shorter: bodies that go to and fro are read again and again.
constexpr int64_t FORGET_INTERVAL = 64;

// Most bodies kept that are gone but may come back; each is asked for every tick.
constexpr std::size_t MAX_MISSING = 64;

// Largest distance between corners of two tiles that lie edge to edge [px]. Larger: visible gaps are closed. Smaller:
// rounding far from the origin opens seams.
constexpr Real SEAM_TOLERANCE = Real(1) / 16;

} // namespace

EnvironmentReader::~EnvironmentReader() {
	if (PhysicsServer2D::get_singleton() != nullptr) {
		search_.await_server();
		for (auto &[id, body] : bodies_) {
			body.let_go();
		}
	}
}

void EnvironmentReader::read(PhysicsDirectSpaceState2D *p_state, std::span<const uint32_t> p_changed,
		const std::vector<RID> &p_joined, double p_delta, WorldData &r_world) {
	tick_++;
	search_.await_server();
	search_.follow(r_world, p_changed, p_delta);
	take_back();
	take_joined(p_joined);
	take_new(p_state);
	if (tick_ % FORGET_INTERVAL == 0) {
		forget_far(p_joined);
	}
	check_some();
	poll(p_delta, r_world);
	if (!is_handed_over_) {
		hand_over(p_delta, r_world);
	}
	list_moving(p_delta);
}

void EnvironmentReader::list_known() {
	TypedArray<RID> known;
	for (const auto &[id, body] : bodies_) {
		if (body.is_told_by_node()) {
			known.push_back(body.rid());
		}
	}
	search_.exclude(known);
	missing_.clear();
}

// True if the body was not known.
bool EnvironmentReader::add(const RID &p_body) {
	if (!bodies_.try_emplace(p_body.get_id(), p_body, space_, tick_).second) {
		return false;
	}
	note_other_bodies();
	return true;
}

// Bodies came or went.
void EnvironmentReader::note_other_bodies() {
	are_bodies_listed_ = false;
	is_handed_over_ = false; // `movers_` is then made anew
}

void EnvironmentReader::reread(BodyRecord &r_body) {
	is_handed_over_ &= !r_body.reread(seen_since());
}

void EnvironmentReader::take_new(PhysicsDirectSpaceState2D *p_state) {
	if (search_.is_list_due(int64_t(bodies_.size()))) {
		list_known();
	}
	if (search_.is_regrouped() || !are_bodies_listed_) {
		count_shapes();
	}
	found_.clear();
	search_.find(p_state, found_);
	int64_t needless = 0;
	for (const FoundShape &found : found_) {
		if (is_hull_proxy(found.body)) {
			needless++;
			continue;
		}
		const bool is_new = add(found.body);
		BodyRecord &body = bodies_.find(found.body.get_id())->second;
		needless += int64_t(!is_new && body.is_told_by_node());
		body.note_seen(found.shape, tick_);
		if (!body.is_told_by_node() && body.has_other_shapes(seen_since())) {
			reread(body);
		}
	}
	search_.note_needless(needless);
}

// A body on the list of known bodies is not found. A body that left the space may come back before the list is renewed.
void EnvironmentReader::take_back() {
	std::erase_if(missing_, [&](const RID &p_body) {
		const bool is_back = BodyRecord::is_in_space(p_body, space_);
		if (is_back) {
			add(p_body);
		}
		return is_back;
	});
}

void EnvironmentReader::take_joined(const std::vector<RID> &p_joined) {
	for (const RID &body : p_joined) {
		if (!bodies_.contains(body.get_id()) && BodyRecord::is_in_space(body, space_)) {
			add(body);
		}
	}
}

void EnvironmentReader::forget_far(const std::vector<RID> &p_joined) {
	const std::size_t count = bodies_.size();
	std::erase_if(bodies_, [&](const auto &p_entry) {
		const BodyRecord &body = p_entry.second;
		return !search_.is_near(body.bounds()) && std::ranges::find(p_joined, body.rid()) == p_joined.end();
	});
	if (bodies_.size() != count) {
		note_other_bodies();
		search_.forget_list();
	}
}

void EnvironmentReader::count_shapes() {
	search_.clear_counts();
	for (const auto &[id, body] : bodies_) {
		search_.count_shapes(body.bounds(), int64_t(body.shapes().size()));
	}
}

void EnvironmentReader::list_bodies() {
	leaders_.clear();
	followers_.clear();
	std::unordered_map<uint64_t, std::size_t> leader_of;
	for (auto &[id, body] : bodies_) {
		const auto [entry, is_first] = leader_of.try_emplace(body.object_id(), leaders_.size());
		if (!is_first && body.is_tile()) {
			followers_[entry->second].push_back(&body);
		} else {
			leaders_.push_back(&body);
			followers_.emplace_back();
		}
	}
	are_bodies_listed_ = true;
}

// Drops bodies that are gone and calls `p_check(body)` for those that are not, from the id `r_from` on and after the last
// body from the first, until they have cost `p_budget`. The check returns its cost.
template <class Check>
void EnvironmentReader::check_in_turn(int64_t &r_from, int p_budget, const Check &p_check) {
	auto next = bodies_.lower_bound(r_from);
	for (std::size_t i = 0; i < bodies_.size() && p_budget > 0; i++, ++next) {
		if (next == bodies_.end()) {
			next = bodies_.begin();
		}
		if (next->second.is_there()) {
			p_budget -= p_check(next->second);
		} else {
			p_budget--;
			gone_.push_back(next->second.rid());
		}
	}
	r_from = next == bodies_.end() ? 0 : next->first;
	drop_gone();
}

// Many bodies are asked for what is cheap to ask, as those of one TileMapLayer usually come and go together; few are read
// again.
void EnvironmentReader::check_some() {
	check_in_turn(look_from_, LOOKS, [&](BodyRecord &r_body) {
		if (r_body.has_other_shapes(seen_since())) {
			reread(r_body);
		}
		return 1;
	});
	check_in_turn(reread_from_, REREAD_SHAPES, [&](BodyRecord &r_body) {
		reread(r_body);
		return 1 + int(r_body.shapes().size());
	});
}

void EnvironmentReader::drop_gone() {
	for (const RID &body : gone_) {
		bodies_.erase(body.get_id());
		missing_.push_back(body);
		note_other_bodies();
	}
	gone_.clear();
	if (missing_.size() > MAX_MISSING) {
		search_.forget_list();
	}
}

BodyChange EnvironmentReader::poll(BodyRecord &r_body, double p_delta) {
	const BodyChange change = r_body.poll(p_delta);
	is_handed_over_ &= change != BodyChange::REBUILT && change != BodyChange::GONE;
	if (change == BodyChange::GONE) {
		gone_.push_back(r_body.rid());
	}
	return change;
}

void EnvironmentReader::poll(double p_delta, WorldData &r_world) {
	if (!are_bodies_listed_) {
		list_bodies();
	}
	for (std::size_t i = 0; i < leaders_.size(); i++) {
		if (poll(*leaders_[i], p_delta) == BodyChange::NONE) {
			continue;
		}
		for (BodyRecord *follower : followers_[i]) {
			poll(*follower, p_delta);
		}
	}
	drop_gone();
	if (!are_bodies_listed_) {
		list_bodies();
	}
	if (!is_handed_over_) {
		return; // all of them are handed over in any case
	}
	for (const BodyRecord *body : movers_) {
		r_world.set_rigid_body(body->rigid_index, body->rigid_body());
	}
}

void EnvironmentReader::list_moving(double p_delta) {
	moving_.clear();
	for (BodyRecord *body : leaders_) {
		if (body->mode() == PhysicsServer2D::BODY_MODE_STATIC) {
			continue;
		}
		Aabb box = body->bounds();
		if (CharacterMotion *character = body->character()) {
			character->begin_tick();
			box = box.grown(length(body->rigid_body().linear_velocity) * Real(p_delta)); // known before it lands
		}
		moving_.push_back({ body, box });
	}
	moving_near_.resize(search_.group_count());
	rows_near_moving_.clear();
	for (std::size_t group = 0; group < moving_near_.size(); group++) {
		moving_near_[group].clear();
		for (uint32_t i = 0; i < moving_.size(); i++) {
			if (moving_[i].box.overlaps(search_.group_box(group))) {
				moving_near_[group].push_back(i);
			}
		}
		if (!moving_near_[group].empty()) {
			search_.append_rows(group, rows_near_moving_);
		}
	}
}

void EnvironmentReader::begin_rides(Real p_mass, double p_delta, WorldData &r_world) {
	for (const Moving &moving : moving_) {
		if (moving.body->character() == nullptr) {
			continue;
		}
		const BodyChange change = moving.body->ride(p_mass, p_delta);
		if (change == BodyChange::MOVED && moving.body->rigid_index != NO_RIGID_BODY) {
			r_world.set_rigid_body(moving.body->rigid_index, moving.body->rigid_body());
		}
		is_handed_over_ &= change != BodyChange::REBUILT;
	}
}

void EnvironmentReader::end_rides(const WorldData &p_world, double p_delta) {
	for (const Moving &moving : moving_) {
		CharacterMotion *character = moving.body->character();
		if (character != nullptr && character->acts() && moving.body->rigid_index != NO_RIGID_BODY) {
			const uint32_t index = moving.body->rigid_index;
			character->end_step(p_world.rigid_bodies()[index], p_world.reactions()[index], Real(p_delta));
		}
	}
}

void EnvironmentReader::give_back_impulses(const WorldData &p_world, double p_delta) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	for (BodyRecord *body : movers_) {
		if (!body->is_rigid()) {
			continue;
		}
		const Reaction reaction = body->take_reaction(p_world.reactions()[body->rigid_index], p_delta);
		if (reaction.impulse != Vec2{}) {
			server->body_apply_central_impulse(body->rid(), to_godot(reaction.impulse));
		}
		if (reaction.angular_impulse != 0) {
			server->body_apply_torque_impulse(body->rid(), reaction.angular_impulse);
		}
	}
}

void EnvironmentReader::keep_rigid_bodies_asleep() {
	for (BodyRecord *body : movers_) {
		if (body->is_rigid()) {
			body->keep_asleep();
		}
	}
}

void EnvironmentReader::hand_over_shapes(const BodyRecord &p_body, double p_delta, WorldData &r_world) {
	for (const ShapeRecord &shape : p_body.shapes()) {
		for (Collider collider : shape.translated.colliders) {
			collider.surface = p_body.surface();
			collider.rigid_body = p_body.rigid_index;
			if (!p_body.has_rigid_body()) {
				collider.surface.velocity_origin = to_core(p_body.origin());
			}
			colliders_.push_back(std::move(collider));
		}
		if (shape.translated.border) {
			r_world.add_border(p_body.border_in_world(*shape.translated.border, p_delta));
		}
	}
}

void EnvironmentReader::hand_over(double p_delta, WorldData &r_world) {
	is_handed_over_ = true;
	r_world.clear_environment();
	movers_.clear();
	colliders_.clear();
	for (auto &[id, body] : bodies_) {
		body.rigid_index = NO_RIGID_BODY;
		if (body.has_rigid_body()) {
			const Result<uint32_t> index = r_world.add_rigid_body(body.rigid_body());
			if (!index) {
				ERR_PRINT_ONCE("SoftBody2D ignores a body: " + to_godot(index.error().message()));
				continue;
			}
			body.rigid_index = index.value();
			movers_.push_back(&body);
		}
		hand_over_shapes(body, p_delta, r_world);
	}
	mark_internal_edges(colliders_, SEAM_TOLERANCE);
	for (Collider &collider : colliders_) {
		if (const Status status = r_world.add_collider(std::move(collider))) {
			ERR_PRINT_ONCE("SoftBody2D ignores a collision shape: " + to_godot(status->message()));
		}
	}
}

} // namespace softbody
