// SPDX-License-Identifier: MIT
// All soft bodies of one physics space.
#include "godot/server/soft_body_space_2d.h"

#include "core/base/hash.h"
#include "core/geometry/aabb.h"
#include "godot/convert.h"
#include "godot/server/step_signals.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/classes/time.hpp>
#include <godot_cpp/core/object.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

using namespace godot;

namespace softbody {

namespace {

// Overlap of a rigid body with a frozen soft one from which on the engine moves it out [px]. Smaller: the engine, which
// leaves 0.3 px, would begin again and again.
constexpr Real FROZEN_OVERLAP = Real(0.5);

// Most bodies with dents that are shown to the engine with them without need. The others are shown without dents.
constexpr int MAX_DETAILED_PROXIES = 16;

// A body at rest looks once in so many ticks whether the areas around it have changed.
constexpr std::size_t LOOK_INTERVAL = 16;
// Most bodies that look in one tick; more bodies look more seldom. More: changes are noticed sooner, for about a
// microsecond each.
constexpr std::size_t LOOKS = 64;
// The same after one of them has found a change: that change may be everywhere.
constexpr std::size_t URGENT_LOOKS = 1024;

// Time since creation or the last query [µs].
class Stopwatch {
public:
	double lap() {
		const uint64_t now = Time::get_singleton()->get_ticks_usec();
		return double(now - std::exchange(start_, now));
	}

private:
	uint64_t start_ = Time::get_singleton()->get_ticks_usec();
};

// Records of one body, in a list that is sorted by bodies.
template <class Record>
std::span<const Record> of_body(std::span<const Record> p_list, BodyId p_body) {
	const auto found = std::ranges::equal_range(p_list, p_body.index, {}, [](const Record &p_record) { return p_record.body.index; });
	return found.empty() || found.front().body != p_body ? std::span<const Record>() : std::span<const Record>(found);
}

} // namespace

SoftBodySpace2D::SoftBodySpace2D(const RID &p_space, ParallelFor p_parallel_for) :
		space_(p_space), simulator_(world_, std::move(p_parallel_for)), reader_(p_space) {
	world_.set_length_unit(PIXELS_PER_METER); // tolerances of the core scale with it
	read_gravity(); // a first step that brought it would wake bodies that start asleep
}

void SoftBodySpace2D::apply_settings(const StepSettings &p_settings) {
	world_.set_contact_substeps(p_settings.contact_substeps);
	world_.set_sleeping(p_settings.can_sleep);
	has_rigid_flight_ = p_settings.rigid_flight;
	character_mass_ = p_settings.character_mass;
	most_tears_ = p_settings.most_tears;
	if (default_substeps_ != p_settings.substeps) {
		default_substeps_ = p_settings.substeps;
		nodes_.for_each([](SteppedNode &r_node) { r_node.note_project_settings(); });
	}
}

void SoftBodySpace2D::remove(SteppedNode &r_node) {
	nodes_.remove(r_node);
	busy_.remove(r_node);
	near_moving_.remove(r_node);
	undrawn_.remove(r_node);
	paused_.remove(r_node);
	r_node.is_paused = false;
	detailed_count_ -= int(std::exchange(r_node.is_counted_detailed, false));
}

BodyId SoftBodySpace2D::add_body(SteppedNode &r_node, SoftBodyData p_body) {
	const BodyId body = world_.add_soft_body(std::move(p_body));
	owners_.resize(std::max<std::size_t>(owners_.size(), body.index + 1));
	owners_[body.index] = { body, &r_node };
	busy_.add(r_node);
	return body;
}

int64_t SoftBodySpace2D::draw(const DrawingFrame &p_frame) {
	int64_t count = 0;
	undrawn_.for_each([&](SteppedNode &r_node) {
		count += int64_t(r_node.draw_frame(p_frame));
		if (r_node.is_drawn()) {
			undrawn_.remove(r_node);
		}
	});
	return count;
}

SteppedNode *SoftBodySpace2D::node_of(BodyId p_body) const {
	const bool is_there = p_body.index < owners_.size() && owners_[p_body.index].body == p_body && world_.find(p_body) != nullptr;
	return is_there ? owners_[p_body.index].node : nullptr;
}

void SoftBodySpace2D::list_islands(TypedArray<Dictionary> &r_islands) const {
	const auto object_of = [this](BodyId p_body) -> Object * {
		const SteppedNode *node = node_of(p_body); // null if it has left since
		return node == nullptr ? nullptr : ObjectDB::get_instance(node->instance_id());
	};
	for (const IslandReport &island : islands_) {
		Dictionary told;
		told["first"] = object_of(island.first);
		told["bodies"] = island.bodies;
		told["contact_substeps"] = island.contact_substeps;
		told["overlap"] = island.overlap;
		told["penetration"] = island.penetration;
		told["deepest"] = object_of(island.deepest);
		r_islands.push_back(told);
	}
}

// Whatever steps the space, tick or game, and however often between two ticks of the engine: what fluids do follows from where bodies
// and fluids are, and from nothing that the engine remembers.
void SoftBodySpace2D::push_by_fluids(double p_delta) {
	const bool was_restored = std::exchange(seen_restores_, world_.change_counts().restores) != seen_restores_;
	const bool had_fluids = std::exchange(had_fluids_, !fluids_.empty());
	if (fluids_.empty() && !had_fluids && !was_restored) {
		return;
	}
	busy_.for_each([](SteppedNode &r_node) { r_node.take_over_transform(); });
	std::vector<SteppedFluid *> filled;
	std::ranges::copy_if(fluids_, std::back_inserter(filled), [](SteppedFluid *fluid) { return fluid->look(); });
	nodes_.for_each([&](SteppedNode &r_node) {
		SoftBodyData *body = world_.find(r_node.get_body_id());
		if (body == nullptr || !body->is_active() || body->is_frozen()) {
			return;
		}
		const Aabb box = bounding_box(body->hull());
		uint64_t around = 0;
		for (const SteppedFluid *fluid : filled) {
			around += fluid->reaches(*body, box) ? mixed(fluid->number()) : 0;
		}
		if (body->fluids() != around) {
			body->set_fluids(around);
			busy_.add(r_node);
		}
		for (SteppedFluid *fluid : filled) {
			if ((fluid->flows() || !body->is_asleep()) && fluid->reaches(*body, box)) {
				fluid->push(r_node, p_delta);
			}
		}
	});
}

void SoftBodySpace2D::prepare_joints() {
	joined_.clear();
	for (SteppedJoint *joint : joints_) {
		joint->prepare_step();
		if (const RID rigid_body = joint->get_rigid_body(); rigid_body.is_valid()) {
			joined_.push_back(rigid_body);
		}
	}
}

void SoftBodySpace2D::collect_broken_joints(const StepReport &p_report, StepSignals &r_signals) {
	for (SteppedJoint *joint : joints_) {
		if (std::ranges::find(p_report.broken_joints, joint->get_joint_id()) != p_report.broken_joints.end()) {
			joint->note_break(r_signals);
		}
	}
}

void SoftBodySpace2D::read_gravity() {
	space_effects_ = read_space_effects(space_);
	if (const Status status = world_.set_gravity(space_effects_.gravity)) {
		ERR_PRINT_ONCE("SoftBody2D keeps the last gravity: " + to_godot(status->message()));
	}
}

// Nodes at rest look in turn. A look takes two ticks: the engine works out effects of areas for what has moved, so the
// proxy is stirred in one tick and asked in the next.
void SoftBodySpace2D::feel_areas() {
	const uint64_t frame = Engine::get_singleton()->get_physics_frames();
	const bool has_stepped = std::exchange(last_frame_, frame) != frame;
	busy_.for_each([&](SteppedNode &r_node) { r_node.feel_areas(space_effects_, has_stepped); });
	for (const BodyId body : stirred_) {
		SteppedNode *node = node_of(body);
		if (node == nullptr || busy_.contains(*node)) {
			continue;
		}
		node->feel_areas(space_effects_, has_stepped);
		if (!world_.find(body)->is_asleep()) { // something has changed, perhaps not only here
			busy_.add(*node);
			urgent_looks_ = nodes_.count();
		}
	}
	stirred_.clear();
	const std::size_t count = nodes_.count();
	look_credit_ += std::min(count, LOOKS * LOOK_INTERVAL);
	std::size_t looks = look_credit_ / LOOK_INTERVAL;
	look_credit_ %= LOOK_INTERVAL;
	if (urgent_looks_ > 0) {
		looks = std::min(URGENT_LOOKS, urgent_looks_);
		urgent_looks_ -= looks;
	}
	for (std::size_t i = 0; i < looks; i++) {
		next_look_ = next_look_ + 1 < count ? next_look_ + 1 : 0;
		SteppedNode &node = nodes_[next_look_];
		const SoftBodyData *body = world_.find(node.get_body_id());
		if (!busy_.contains(node) && body != nullptr && body->is_asleep()) {
			node.stir_proxy();
			stirred_.push_back(node.get_body_id());
		}
	}
}

void SoftBodySpace2D::read_environment(double p_delta) {
	PhysicsDirectSpaceState2D *state = PhysicsServer2D::get_singleton()->space_get_direct_state(space_);
	ERR_FAIL_NULL_MSG(state, "SoftBody2D: the physics space cannot be read now; this tick has the surroundings of the last.");
	busy_rows_.clear();
	const SoftBodyData *first = world_.soft_bodies().data();
	busy_.for_each([&](SteppedNode &r_node) {
		if (const SoftBodyData *body = world_.find(r_node.get_body_id())) {
			busy_rows_.push_back(uint32_t(body - first));
		}
	});
	reader_.read(state, busy_rows_, joined_, p_delta, world_);
	tell_proxies();
}

void SoftBodySpace2D::step(double p_delta, StepThreads &p_threads, StepSignals &r_signals, TickProfile &r_profile) {
	Stopwatch watch;
	read_gravity();
	world_.set_rigid_flight(has_rigid_flight_ || budget_.rigid_flight);
	pause_unseen();
	push_by_fluids(p_delta);
	busy_.for_each([p_delta](SteppedNode &r_node) { r_node.prepare_step(p_delta); });
	prepare_joints();
	feel_areas();
	r_profile.prepare += watch.lap();
	r_profile.nodes += double(busy_.count());
	read_environment(p_delta);
	if (!r_signals.is_quiet()) {
		reader_.begin_rides(character_mass_, p_delta, world_);
	}
	r_profile.surroundings += watch.lap();
	StepReport report = simulator_.simulate(Real(p_delta));
	// A physics server with a thread of its own may be running a helper on it, and would answer only after that.
	p_threads.end_step();
	if (!r_signals.is_quiet()) {
		reader_.give_back_impulses(world_, p_delta);
		reader_.end_rides(world_, p_delta);
	}
	r_profile.simulate += watch.lap();
	contact_count_ = int64_t(report.contacts + report.pair_contacts + report.self_contacts);
	flying_count_ = int64_t(report.flying_bodies);
	islands_ = std::move(report.islands);
	simulator_.list_awake(awake_);
	for (const BodyId body : awake_) {
		if (SteppedNode *node = node_of(body)) {
			busy_.add(*node);
		}
	}
	for (const BodyId body : report.reset_bodies) {
		if (SteppedNode *node = node_of(body)) {
			node->note_failure(r_signals);
		}
	}
	for (const BodyId body : report.dented_bodies) {
		if (SteppedNode *node = node_of(body)) {
			node->note_dent(r_signals);
		}
	}
	overstretched_.clear();
	busy_.for_each([](SteppedNode &r_node) { r_node.finish_step(); });
	r_profile.finish += watch.lap();
	tell_riders();
	move_proxies();
	reader_.keep_rigid_bodies_asleep();
	r_profile.proxies += watch.lap();
	if (!report.broken_joints.empty()) {
		collect_broken_joints(report, r_signals);
	}
	collect_signals(r_signals);
	tear_overstretched(r_signals);
	let_idle();
	r_profile.finish += watch.lap();
}

// A proxy is told of moving bodies near it while there are any, and once more after that, of none.
void SoftBodySpace2D::tell_proxies() {
	for (const uint32_t row : reader_.rows_near_moving()) {
		if (SteppedNode *node = node_of(world_.id_at(row))) {
			near_moving_.add(*node);
		}
	}
	const SoftBodyData *first = world_.soft_bodies().data();
	for (std::size_t i = near_moving_.count(); i-- > 0;) {
		SteppedNode &node = near_moving_[i];
		HullProxy &proxy = node.proxy();
		const SoftBodyData *body = world_.find(node.get_body_id());
		const bool was_pressed = proxy.is_pressed();
		bool is_near = false;
		proxy.begin_near();
		if (body != nullptr) {
			reader_.for_moving_near(std::size_t(body - first), [&](BodyRecord &r_near) {
				// The core moves hulls out of overlaps; what is inside a frozen one is left to the engine.
				if (!body->is_frozen() || !r_near.is_rigid() || !r_near.reaches_in(body->hull(), FROZEN_OVERLAP)) {
					proxy.note_near(r_near.rid(), r_near.mode());
				}
				if (r_near.character() != nullptr && proxy.is_in_space() && r_near.meets_layer(body->settings().collision_layer)) {
					r_near.character()->note_near(*body, r_near.bounds(), proxy.is_hard());
				}
				is_near = true;
			});
		}
		proxy.end_near();
		if (proxy.is_pressed() != was_pressed) {
			busy_.add(node);
		}
		if (!is_near) {
			proxy.set_riders({});
			near_moving_.remove(node);
		}
	}
}

// Proxies show characters what the step has made of both.
void SoftBodySpace2D::tell_riders() {
	const SoftBodyData *first = world_.soft_bodies().data();
	for (std::size_t i = 0; i < near_moving_.count(); i++) {
		SteppedNode &node = near_moving_[i];
		riders_.clear();
		if (const SoftBodyData *body = world_.find(node.get_body_id())) {
			reader_.for_moving_near(std::size_t(body - first), [&](BodyRecord &r_near) {
				if (r_near.character() != nullptr && r_near.character()->acts()) {
					riders_.push_back(r_near.character()->rider(r_near.bounds()));
				}
			});
		}
		if (node.proxy().set_riders(riders_)) {
			busy_.add(node);
		}
	}
}

void SoftBodySpace2D::move_proxies() {
	RID changed;
	RID moved;
	busy_.for_each([&](SteppedNode &r_node) {
		detailed_count_ -= int(r_node.is_counted_detailed);
		if (r_node.follow_with_proxy(detailed_count_ < MAX_DETAILED_PROXIES)) {
			changed = r_node.proxy().rid();
		}
		if (r_node.proxy().is_in_space()) {
			moved = r_node.proxy().rid();
		}
		r_node.is_counted_detailed = r_node.proxy().is_detailed();
		detailed_count_ += int(r_node.is_counted_detailed);
	});
	if (changed.is_valid()) {
		flush_hull_proxies(changed);
	}
	if (moved.is_valid()) {
		await_hull_proxies(moved);
	}
}

void SoftBodySpace2D::collect_signals(StepSignals &r_signals) {
	std::vector<uint64_t> colliders;
	const auto id_of = [&](const ContactOther &p_other) -> uint64_t { // 0 for a surface without an object
		if (p_other.kind != ContactOther::Kind::SOFT_BODY) {
			return p_other.tag;
		}
		const SteppedNode *node = node_of(p_other.body);
		return node != nullptr ? node->instance_id() : 0;
	};
	busy_.for_each([&](SteppedNode &r_node) {
		r_node.take_sleep(r_signals);
		if (!r_node.watches_contacts()) {
			return;
		}
		const std::span<const Contact> contacts = of_body(simulator_.contacts(), r_node.get_body_id());
		colliders.clear();
		for (const Contact &contact : contacts) {
			colliders.push_back(id_of(contact.other));
		}
		std::vector<uint64_t> touched;
		for (const Touch &touch : of_body(simulator_.touches(), r_node.get_body_id())) {
			touched.push_back(id_of(touch.other));
		}
		r_node.take_contacts(contacts, colliders, std::move(touched), r_signals);
	});
}

void SoftBodySpace2D::apply_budget(const BudgetLevels &p_levels) {
	budget_ = p_levels;
}

// Of bodies that nobody sees none costs anything on the screen, so those of the most points go first. They come back in the reverse order, and
// at once when they are seen.
void SoftBodySpace2D::pause_unseen() {
	if (budget_.paused_share == 0 && paused_.count() == 0) {
		return;
	}
	paused_.for_each([&](SteppedNode &r_node) {
		if (!r_node.may_pause()) { // it was seen, or the user made it important
			r_node.is_paused = false;
			paused_.remove(r_node);
		}
	});
	pausable_.clear();
	busy_.for_each([&](SteppedNode &r_node) {
		if (!r_node.is_paused && r_node.may_pause()) {
			pausable_.push_back(&r_node);
		}
	});
	const std::size_t wanted = std::size_t(std::ceil(budget_.paused_share * double(paused_.count() + pausable_.size())));
	while (paused_.count() > wanted) {
		SteppedNode &node = paused_[paused_.count() - 1];
		node.is_paused = false;
		paused_.remove(node);
		busy_.add(node);
	}
	if (paused_.count() >= wanted) {
		return;
	}
	const auto points = [this](const SteppedNode *p_node) { return world_.find(p_node->get_body_id())->point_count(); };
	std::ranges::stable_sort(pausable_, std::ranges::greater{}, points);
	for (std::size_t i = 0; paused_.count() < wanted && i < pausable_.size(); ++i) {
		pausable_[i]->is_paused = true;
		paused_.add(*pausable_[i]);
	}
}

// Turn by turn: one that cannot be torn, as it would leave too little, does not keep the others waiting.
void SoftBodySpace2D::tear_overstretched(StepSignals &r_signals) {
	const std::size_t count = std::min(overstretched_.size(), std::size_t(most_tears_));
	for (std::size_t i = 0; i < count; ++i) {
		overstretched_[std::size_t(turn_to_tear_++ % overstretched_.size())]->tear(r_signals);
	}
}

void SoftBodySpace2D::let_idle() {
	busy_.for_each([&](SteppedNode &r_node) {
		if (r_node.is_idle()) {
			busy_.remove(r_node);
		}
	});
}

} // namespace softbody
