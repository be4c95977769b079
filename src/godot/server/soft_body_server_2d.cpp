// SPDX-License-Identifier: MIT
// The singleton that steps every soft body once a physics tick.
#include "godot/server/soft_body_server_2d.h"

#include "godot/nodes/soft_body_2d.h"

#include <godot_cpp/classes/time.hpp>
#include <godot_cpp/classes/window.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/variant/callable_method_pointer.hpp>

#include <algorithm>

namespace godot {

static SoftBodyServer2D *singleton = nullptr;

SoftBodyServer2D *SoftBodyServer2D::get_singleton() {
	return singleton;
}

SoftBodyServer2D::SoftBodyServer2D() {
	if (singleton == nullptr) {
		singleton = this;
	}
}

SoftBodyServer2D::~SoftBodyServer2D() {
	if (singleton == this) {
		singleton = nullptr;
	}
}

softbody::SoftBodySpace2D *SoftBodyServer2D::add_body(SoftBody2D *p_node) {
	watch(p_node->get_tree());
	const RID rid = p_node->get_world_2d()->get_space();
	auto found = std::find_if(spaces_.begin(), spaces_.end(), [&](const Space &p_space) { return p_space.rid == rid; });
	if (found == spaces_.end()) {
		spaces_.push_back({ rid, std::make_unique<softbody::SoftBodySpace2D>(rid) });
		found = spaces_.end() - 1;
	}
	found->content->add(p_node);
	return found->content.get();
}

void SoftBodyServer2D::remove_body(SoftBody2D *p_node) {
	for (Space &space : spaces_) {
		space.content->remove(p_node);
	}
	std::erase_if(spaces_, [](const Space &p_space) { return p_space.content->is_empty(); });
}

void SoftBodyServer2D::watch(SceneTree *p_tree) {
	if (watched_tree_ == p_tree->get_instance_id()) {
		return;
	}
	watched_tree_ = p_tree->get_instance_id();
	p_tree->connect("physics_frame", callable_mp(this, &SoftBodyServer2D::step));
}

void SoftBodyServer2D::step() {
	const SceneTree *tree = Object::cast_to<SceneTree>(ObjectDB::get_instance(watched_tree_));
	if (tree == nullptr || spaces_.empty()) {
		return;
	}
	const double delta = tree->get_root()->get_physics_process_delta_time();
	if (!(delta > 0)) {
		return; // Engine.time_scale is 0
	}
	const uint64_t start = Time::get_singleton()->get_ticks_usec();
	for (Space &space : spaces_) {
		space.content->step(delta);
	}
	last_step_usec_ = double(Time::get_singleton()->get_ticks_usec() - start);
	total_step_usec_ += last_step_usec_;
	counted_steps_++;
	tick_count_++;
}

int64_t SoftBodyServer2D::get_body_count() const {
	int64_t count = 0;
	for (const Space &space : spaces_) {
		count += int64_t(space.content->nodes().size());
	}
	return count;
}

int64_t SoftBodyServer2D::get_tick_count() const {
	return tick_count_;
}

double SoftBodyServer2D::get_last_step_usec() const {
	return last_step_usec_;
}

double SoftBodyServer2D::get_mean_step_usec() const {
	return counted_steps_ > 0 ? total_step_usec_ / double(counted_steps_) : 0.0;
}

void SoftBodyServer2D::reset_statistics() {
	tick_count_ = 0;
	counted_steps_ = 0;
	total_step_usec_ = 0;
	last_step_usec_ = 0;
}

double SoftBodyServer2D::measure_max_penetration() const {
	double deepest = 0;
	for (const Space &space : spaces_) {
		for (const SoftBody2D *node : space.content->nodes()) {
			deepest = std::max(deepest, node->get_penetration());
		}
	}
	return deepest;
}

void SoftBodyServer2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("get_body_count"), &SoftBodyServer2D::get_body_count);
	ClassDB::bind_method(D_METHOD("get_tick_count"), &SoftBodyServer2D::get_tick_count);
	ClassDB::bind_method(D_METHOD("get_last_step_usec"), &SoftBodyServer2D::get_last_step_usec);
	ClassDB::bind_method(D_METHOD("get_mean_step_usec"), &SoftBodyServer2D::get_mean_step_usec);
	ClassDB::bind_method(D_METHOD("reset_statistics"), &SoftBodyServer2D::reset_statistics);
	ClassDB::bind_method(D_METHOD("measure_max_penetration"), &SoftBodyServer2D::measure_max_penetration);
}

} // namespace godot
