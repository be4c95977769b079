// SPDX-License-Identifier: MIT
// All soft bodies of one physics space.
#include "godot/server/soft_body_space_2d.h"

#include "godot/convert.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/nodes/soft_body_joint_2d.h"
#include "godot/server/body_signals.h"
#include "godot/surroundings/hull_proxy.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/classes/time.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <algorithm>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

// Most bodies with dents that are shown to the engine with them without need. The others are shown without dents.
constexpr int MAX_DETAILED_PROXIES = 16;

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

} // namespace

TickProfile &TickProfile::operator+=(const TickProfile &p_other) {
	prepare += p_other.prepare;
	surroundings += p_other.surroundings;
	simulate += p_other.simulate;
	finish += p_other.finish;
	proxies += p_other.proxies;
	return *this;
}

SoftBodySpace2D::SoftBodySpace2D(const RID &p_space, ParallelFor p_parallel_for) :
		space_(p_space), simulator_(world_, std::move(p_parallel_for)), reader_(p_space) {
	world_.set_length_unit(PIXELS_PER_METER); // tolerances of the core scale with it
	read_gravity(); // a first step that brought it would wake bodies that start asleep
}

void SoftBodySpace2D::apply_settings(const StepSettings &p_settings) {
	world_.set_contact_substeps(p_settings.contact_substeps);
	world_.set_sleeping(p_settings.can_sleep);
	if (default_substeps_ != p_settings.substeps) {
		default_substeps_ = p_settings.substeps;
		for_nodes([](SoftBody2D &r_node) { r_node.note_project_settings(); });
	}
}

void SoftBodySpace2D::add(SoftBody2D *p_node) {
	p_node->set_space_index(nodes_.size());
	nodes_.push_back(p_node);
	body_count_++;
}

// During a step the other nodes keep their places.
void SoftBodySpace2D::remove(SoftBody2D *p_node) {
	const size_t index = p_node->get_space_index();
	if (index >= nodes_.size() || nodes_[index] != p_node) {
		return; // of another space
	}
	body_count_--;
	nodes_[index] = nullptr;
	if (!stepping_) {
		nodes_[index] = nodes_.back();
		nodes_.pop_back();
		if (index < nodes_.size()) {
			nodes_[index]->set_space_index(index);
		}
	}
}

void SoftBodySpace2D::add_joint(SoftBodyJoint2D *p_node) {
	joints_.push_back(p_node);
}

void SoftBodySpace2D::remove_joint(SoftBodyJoint2D *p_node) {
	std::erase(joints_, p_node);
}

void SoftBodySpace2D::collect_broken_joints(const StepReport &p_report, BodySignals &r_signals) {
	for (SoftBodyJoint2D *joint : joints_) {
		if (std::ranges::find(p_report.broken_joints, joint->get_joint_id()) != p_report.broken_joints.end()) {
			joint->note_break();
			r_signals.add_broken(joint->get_instance_id());
		}
	}
}

void SoftBodySpace2D::close_gaps() {
	std::erase(nodes_, nullptr);
	for (size_t i = 0; i < nodes_.size(); i++) {
		nodes_[i]->set_space_index(i);
	}
}

void SoftBodySpace2D::read_gravity() {
	space_effects_ = read_space_effects(space_);
	if (const Status status = world_.set_gravity(space_effects_.gravity)) {
		ERR_PRINT_ONCE("SoftBody2D keeps the last gravity: " + to_godot(status->message()));
	}
}

void SoftBodySpace2D::read_environment(double p_delta) {
	PhysicsDirectSpaceState2D *state = PhysicsServer2D::get_singleton()->space_get_direct_state(space_);
	ERR_FAIL_NULL_MSG(state, "SoftBody2D: the physics space cannot be read now; this tick has the surroundings of the last.");
	reader_.read(state, joined_, p_delta, world_);
	tell_proxies();
}

void SoftBodySpace2D::step(double p_delta, BodySignals &r_signals) {
	Stopwatch watch;
	read_gravity();
	stepping_ = true;
	for_nodes([](SoftBody2D &r_node) { r_node.prepare_step(); });
	joined_.clear();
	for (SoftBodyJoint2D *joint : joints_) {
		joint->prepare_step();
		if (const RID rigid_body = joint->get_rigid_body(); rigid_body.is_valid()) {
			joined_.push_back(rigid_body);
		}
	}
	tick_++;
	for_nodes([&](SoftBody2D &r_node) { r_node.feel_areas(space_effects_, tick_); });
	profile_.prepare = watch.lap();
	read_environment(p_delta);
	profile_.surroundings = watch.lap();
	const StepReport report = simulator_.simulate(Real(p_delta));
	reader_.give_back(world_, p_delta);
	profile_.simulate = watch.lap();
	contact_count_ = int64_t(report.contacts + report.pair_contacts + report.self_contacts);
	awake_body_count_ = count_awake();
	for (const BodyId id : report.reset_bodies) {
		if (SoftBody2D *node = node_of(id)) {
			node->note_failure(r_signals);
		}
	}
	for_nodes([](SoftBody2D &r_node) { r_node.finish_step(); });
	profile_.finish = watch.lap();
	move_proxies();
	reader_.keep_asleep();
	profile_.proxies = watch.lap();
	stepping_ = false;
	close_gaps();
	if (!report.broken_joints.empty()) {
		collect_broken_joints(report, r_signals);
	}
	collect_signals(r_signals);
	profile_.finish += watch.lap();
}

void SoftBodySpace2D::tell_proxies() {
	if (!reader_.has_moving()) {
		return;
	}
	const SoftBodyData *first = world_.soft_bodies().data();
	for_nodes([&](SoftBody2D &r_node) {
		if (const SoftBodyData *body = world_.find(r_node.get_body_id())) {
			reader_.tell(std::size_t(body - first), r_node.proxy());
		}
	});
}

void SoftBodySpace2D::move_proxies() {
	RID changed;
	int detailed = 0;
	for_nodes([&](SoftBody2D &r_node) { detailed += int(r_node.proxy().is_detailed()); });
	for_nodes([&](SoftBody2D &r_node) {
		detailed -= int(r_node.proxy().is_detailed());
		if (r_node.follow_with_proxy(detailed < MAX_DETAILED_PROXIES)) {
			changed = r_node.get_rid();
		}
		detailed += int(r_node.proxy().is_detailed());
	});
	if (changed.is_valid()) {
		flush_hull_proxies(changed);
	}
}

int64_t SoftBodySpace2D::count_awake() const {
	return std::ranges::count_if(world_.soft_bodies(), [](const SoftBodyData &p_body) {
		return p_body.is_active() && !p_body.is_asleep() && !p_body.is_frozen();
	});
}

SoftBody2D *SoftBodySpace2D::node_of(BodyId p_id) const {
	const auto found = std::find_if(nodes_.begin(), nodes_.end(),
			[p_id](const SoftBody2D *p_node) { return p_node != nullptr && p_node->get_body_id() == p_id; });
	return found == nodes_.end() ? nullptr : *found;
}

} // namespace softbody
