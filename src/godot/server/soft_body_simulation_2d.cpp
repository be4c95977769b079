// SPDX-License-Identifier: MIT
// The singleton that steps every soft body once a physics tick.
#include "godot/server/soft_body_simulation_2d.h"

#include "godot/convert.h"
#include "godot/server/shape_cache.h"
#include "godot/surroundings/hull_proxy.h"
#include "godot/surroundings/hull_query.h"

#include <godot_cpp/classes/os.hpp>
#include <godot_cpp/classes/performance.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/classes/project_settings.hpp>
#include <godot_cpp/classes/rendering_server.hpp>
#include <godot_cpp/classes/time.hpp>
#include <godot_cpp/classes/window.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/variant/callable_method_pointer.hpp>

#include <algorithm>

namespace godot {

namespace {

SoftBodySimulation2D *singleton = nullptr;

// Name in the debugger's list of monitors.
const char *const AWAKE_MONITOR = "SoftBody2D/Awake Bodies";
const char *const CONTACT_MONITOR = "SoftBody2D/Contacts";
const char *const STEP_MONITOR = "SoftBody2D/Step (usec)";

// Time that the engine's physics thread gets to end its step before the first call of a tick [us]. Godot waits for ever if
// such a call meets the thread between telling that the step is done and clearing its queue (godotengine/godot#120941).
constexpr int32_t PHYSICS_THREAD_PAUSE = 100;

} // namespace

SoftBodySimulation2D *SoftBodySimulation2D::get_singleton() {
	return singleton;
}

SoftBodySimulation2D::SoftBodySimulation2D() {
	if (singleton == nullptr) {
		singleton = this;
	}
}

SoftBodySimulation2D::~SoftBodySimulation2D() {
	if (Performance *performance = Performance::get_singleton()) {
		for (const char *monitor : { AWAKE_MONITOR, CONTACT_MONITOR, STEP_MONITOR }) {
			if (performance->has_custom_monitor(monitor)) {
				performance->remove_custom_monitor(monitor);
			}
		}
	}
	if (singleton == this) {
		singleton = nullptr;
	}
}

softbody::SoftBodySpace2D &SoftBodySimulation2D::space_of(const CanvasItem *p_node) {
	watch(p_node->get_tree());
	if (!settings_known_) {
		read_settings();
		ProjectSettings::get_singleton()->connect("settings_changed", callable_mp(this, &SoftBodySimulation2D::read_settings));
	}
	const RID rid = p_node->get_world_2d()->get_space();
	if (softbody::SoftBodySpace2D *found = find_space(rid)) {
		return *found;
	}
	spaces_.push_back({ rid, std::make_unique<softbody::SoftBodySpace2D>(rid, threads_.parallel_for()) });
	spaces_.back().content->apply_settings(settings_);
	spaces_.back().content->set_reporting_islands(reports_islands_);
	return *spaces_.back().content;
}

softbody::SoftBodySpace2D *SoftBodySimulation2D::find_space(const RID &p_space) const {
	const auto found = std::find_if(spaces_.begin(), spaces_.end(), [&](const Space &p_each) { return p_each.rid == p_space; });
	return found != spaces_.end() ? found->content.get() : nullptr;
}

void SoftBodySimulation2D::drop_empty_spaces() {
	if (!stepping_) {
		std::erase_if(spaces_, [](const Space &p_space) { return p_space.content->is_empty(); });
	}
}

void SoftBodySimulation2D::read_settings() {
	settings_ = softbody::read_step_settings();
	settings_known_ = true;
	threads_.set_thread_count(settings_.threads);
	budget_.set_limit(settings_.budget_ms);
	for (Space &space : spaces_) {
		space.content->apply_settings(settings_);
	}
}

void SoftBodySimulation2D::add_monitors() {
	Performance *performance = Performance::get_singleton();
	if (!performance->has_custom_monitor(AWAKE_MONITOR)) {
		performance->add_custom_monitor(AWAKE_MONITOR, callable_mp(this, &SoftBodySimulation2D::get_awake_body_count));
		performance->add_custom_monitor(CONTACT_MONITOR, callable_mp(this, &SoftBodySimulation2D::get_contact_count));
		performance->add_custom_monitor(STEP_MONITOR, callable_mp(this, &SoftBodySimulation2D::get_last_step_usec));
	}
}

void SoftBodySimulation2D::watch(SceneTree *p_tree) {
	if (watched_tree_ == p_tree->get_instance_id()) {
		return;
	}
	watched_tree_ = p_tree->get_instance_id();
	p_tree->connect("physics_frame", callable_mp(this, &SoftBodySimulation2D::step_all));
	add_monitors();
	p_tree->connect("process_frame", callable_mp(this, &SoftBodySimulation2D::draw_idle_frame));
	// After every _process, so that bodies are drawn at their places in this frame.
	RenderingServer *rendering = RenderingServer::get_singleton();
	const Callable draw = callable_mp(this, &SoftBodySimulation2D::draw_frame);
	if (!rendering->is_connected("frame_pre_draw", draw)) {
		rendering->connect("frame_pre_draw", draw);
	}
}

void SoftBodySimulation2D::step_all() {
	const SceneTree *tree = Object::cast_to<SceneTree>(ObjectDB::get_instance(watched_tree_));
	if (tree == nullptr || spaces_.empty() || stepping_) {
		return;
	}
	const double delta = tree->get_root()->get_physics_process_delta_time();
	if (!(delta > 0)) {
		return; // Engine.time_scale is 0
	}
	if (settings_.has_physics_thread) {
		OS::get_singleton()->delay_usec(PHYSICS_THREAD_PAUSE);
	}
	late_work_.take_one();
	const uint64_t start = Time::get_singleton()->get_ticks_usec();
	step_spaces(delta);
	last_step_usec_ = double(Time::get_singleton()->get_ticks_usec() - start);
	budget_.note_step(last_step_usec_ / 1000);
	total_step_usec_ += last_step_usec_;
	counted_steps_++;
	tick_count_++;
	signals_.emit(); // last: listeners may free nodes, and with them spaces
}

// Moving nodes runs code of the user, which may add nodes or free them, in other spaces too.
void SoftBodySimulation2D::step_spaces(double p_delta) {
	stepping_ = true;
	const size_t count = spaces_.size(); // spaces added meanwhile wait for the next tick
	for (size_t i = 0; i < count; i++) {
		if (is_automatic_stepping(spaces_[i].rid)) {
			spaces_[i].content->apply_budget(budget_.levels());
			spaces_[i].content->step(p_delta, threads_, signals_, profile_);
		}
	}
	stepping_ = false;
	drop_empty_spaces();
}

void SoftBodySimulation2D::draw_frame() {
	if (spaces_.empty()) {
		return;
	}
	const uint64_t start = Time::get_singleton()->get_ticks_usec();
	drawing_.begin();
	last_drawn_count_ = 0;
	for (Space &space : spaces_) {
		last_drawn_count_ += space.content->draw(drawing_);
	}
	last_drawing_usec_ = double(Time::get_singleton()->get_ticks_usec() - start);
}

// In low-processor mode the engine draws a frame only on request.
void SoftBodySimulation2D::draw_idle_frame() {
	if (OS::get_singleton()->is_in_low_processor_usage_mode()) {
		draw_frame();
	}
}

// The sum of `p_count(space)` over all spaces.
template <class Count>
int64_t SoftBodySimulation2D::count_in_spaces(const Count &p_count) const {
	int64_t count = 0;
	for (const Space &space : spaces_) {
		count += int64_t(p_count(*space.content));
	}
	return count;
}

int64_t SoftBodySimulation2D::get_body_count() const {
	return count_in_spaces([](softbody::SoftBodySpace2D &r_space) { return r_space.nodes().count(); });
}

int64_t SoftBodySimulation2D::get_awake_body_count() const {
	return count_in_spaces([](const softbody::SoftBodySpace2D &p_space) { return p_space.awake_body_count(); });
}

int64_t SoftBodySimulation2D::get_contact_count() const {
	return count_in_spaces([](const softbody::SoftBodySpace2D &p_space) { return p_space.contact_count(); });
}

int64_t SoftBodySimulation2D::get_rigid_flight_count() const {
	return count_in_spaces([](const softbody::SoftBodySpace2D &p_space) { return p_space.flying_body_count(); });
}

Dictionary SoftBodySimulation2D::get_budget_report() const {
	const softbody::BudgetLevels levels = budget_.levels();
	Dictionary report;
	report["budget_ms"] = budget_.limit();
	report["step_ms"] = last_step_usec_ / 1000;
	report["reason"] = budget_.reason();
	report["levels_down"] = budget_.depth();
	report["rigid_flight"] = levels.rigid_flight;
	report["paused_share"] = levels.paused_share;
	report["paused_bodies"] = count_in_spaces([](const softbody::SoftBodySpace2D &p_space) { return p_space.paused_body_count(); });
	return report;
}

int64_t SoftBodySimulation2D::get_built_shape_count() const {
	return softbody::built_shape_count();
}

// Means since the last reset [µs a tick].
Dictionary SoftBodySimulation2D::get_step_profile() const {
	const double steps = double(std::max<int64_t>(1, counted_steps_));
	Dictionary result;
	result["nodes"] = profile_.nodes / steps;
	result["prepare"] = profile_.prepare / steps;
	result["surroundings"] = profile_.surroundings / steps;
	result["simulate"] = profile_.simulate / steps;
	result["finish"] = profile_.finish / steps;
	result["proxies"] = profile_.proxies / steps;
	return result;
}

double SoftBodySimulation2D::get_mean_step_usec() const {
	return counted_steps_ > 0 ? total_step_usec_ / double(counted_steps_) : 0.0;
}

void SoftBodySimulation2D::reset_statistics() {
	tick_count_ = 0;
	counted_steps_ = 0;
	total_step_usec_ = 0;
	last_step_usec_ = 0;
	profile_ = {};
	last_drawing_usec_ = 0;
}

double SoftBodySimulation2D::measure_max_penetration() const {
	double deepest = 0;
	for (const Space &space : spaces_) {
		space.content->nodes().for_each(
				[&](const softbody::SteppedNode &p_node) { deepest = std::max(deepest, p_node.get_penetration()); });
	}
	return deepest;
}

void SoftBodySimulation2D::set_reporting_islands(bool p_reports) {
	reports_islands_ = p_reports;
	for (Space &space : spaces_) {
		space.content->set_reporting_islands(p_reports);
	}
}

TypedArray<Dictionary> SoftBodySimulation2D::get_islands() const {
	TypedArray<Dictionary> islands;
	if (!reports_islands_) {
		return islands; // those of the last step may be from before
	}
	for (const Space &space : spaces_) {
		space.content->list_islands(islands);
	}
	return islands;
}

TypedArray<Node2D> SoftBodySimulation2D::intersect_shape(const Ref<PhysicsShapeQueryParameters2D> &p_parameters, const Ref<World2D> &p_world) const {
	TypedArray<Node2D> found;
	ERR_FAIL_COND_V_MSG(p_parameters.is_null(), found, "SoftBodySimulation2D.intersect_shape: the parameters must not be null.");
	const RID shape = p_parameters->get_shape_rid();
	ERR_FAIL_COND_V_MSG(!shape.is_valid(), found, "SoftBodySimulation2D.intersect_shape: the parameters have no shape; set shape or shape_rid.");
	const SceneTree *tree = Object::cast_to<SceneTree>(ObjectDB::get_instance(watched_tree_));
	if (p_world.is_null() && tree == nullptr) {
		return found; // there has been no soft body yet
	}
	const RID rid = (p_world.is_valid() ? p_world : tree->get_root()->get_world_2d())->get_space();
	softbody::SoftBodySpace2D *space = find_space(rid);
	if (space == nullptr) {
		return found;
	}
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	const softbody::HullQuery query(softbody::translate_shape(server->shape_get_type(shape), server->shape_get_data(shape), p_parameters->get_transform()),
			softbody::Real(std::max(0.0, double(p_parameters->get_margin()))));
	const TypedArray<RID> excluded = p_parameters->get_exclude();
	const softbody::WorldData &world = space->world();
	space->nodes().for_each([&](softbody::SteppedNode &r_node) {
		const softbody::SoftBodyData *body = world.find(r_node.get_body_id());
		if (body == nullptr || (body->settings().collision_layer & p_parameters->get_collision_mask()) == 0 ||
				!query.overlaps(body->hull()) || (!excluded.is_empty() && excluded.has(r_node.proxy().rid()))) {
			return;
		}
		found.push_back(Object::cast_to<Node2D>(ObjectDB::get_instance(r_node.instance_id())));
	});
	return found;
}

void SoftBodySimulation2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("intersect_shape", "parameters", "world"), &SoftBodySimulation2D::intersect_shape, DEFVAL(Variant()));
	bind_state_methods();
	ClassDB::bind_method(D_METHOD("get_body_count"), &SoftBodySimulation2D::get_body_count);
	ClassDB::bind_method(D_METHOD("get_awake_body_count"), &SoftBodySimulation2D::get_awake_body_count);
	ClassDB::bind_method(D_METHOD("get_contact_count"), &SoftBodySimulation2D::get_contact_count);
	ClassDB::bind_method(D_METHOD("get_rigid_flight_count"), &SoftBodySimulation2D::get_rigid_flight_count);
	ClassDB::bind_method(D_METHOD("get_budget_report"), &SoftBodySimulation2D::get_budget_report);
	ClassDB::bind_method(D_METHOD("get_built_shape_count"), &SoftBodySimulation2D::get_built_shape_count);
	ClassDB::bind_method(D_METHOD("get_thread_count"), &SoftBodySimulation2D::get_thread_count);
	ClassDB::bind_method(D_METHOD("get_step_profile"), &SoftBodySimulation2D::get_step_profile);
	ClassDB::bind_method(D_METHOD("get_tick_count"), &SoftBodySimulation2D::get_tick_count);
	ClassDB::bind_method(D_METHOD("get_last_step_usec"), &SoftBodySimulation2D::get_last_step_usec);
	ClassDB::bind_method(D_METHOD("get_mean_step_usec"), &SoftBodySimulation2D::get_mean_step_usec);
	ClassDB::bind_method(D_METHOD("get_last_drawing_usec"), &SoftBodySimulation2D::get_last_drawing_usec);
	ClassDB::bind_method(D_METHOD("get_last_drawn_count"), &SoftBodySimulation2D::get_last_drawn_count);
	ClassDB::bind_method(D_METHOD("reset_statistics"), &SoftBodySimulation2D::reset_statistics);
	ClassDB::bind_method(D_METHOD("measure_max_penetration"), &SoftBodySimulation2D::measure_max_penetration);
	ClassDB::bind_method(D_METHOD("set_reporting_islands", "enabled"), &SoftBodySimulation2D::set_reporting_islands);
	ClassDB::bind_method(D_METHOD("is_reporting_islands"), &SoftBodySimulation2D::is_reporting_islands);
	ClassDB::bind_method(D_METHOD("get_islands"), &SoftBodySimulation2D::get_islands);
}

} // namespace godot
