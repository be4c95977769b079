// SPDX-License-Identifier: MIT
// The node: its life in the tree and its agreement with the body in the core.
#include "godot/nodes/soft_body_2d.h"

#include "core/creator/body_tear.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "godot/convert.h"
#include "godot/nodes/engine_joints.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/scene_tree.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/math.hpp>

#include <cmath>
#include <utility>
#include <vector>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

constexpr double SCALE_TOLERANCE = 1e-4; // largest change of its scale for which the body is moved, not made anew

} // namespace

SoftBody2D::SoftBody2D() {
	structure_.exchange<&softbody::BodyStructure::Values::polygon>(make_default_polygon());
	update_topology();
	set_notify_transform(true);
}

SoftBody2D::~SoftBody2D() {
	leave_space();
}

String SoftBody2D::describe() const {
	String text = "SoftBody2D '" + String(get_name()) + "'";
	if (is_inside_tree()) {
		text += " (" + String(get_path()) + ")";
	}
	return text;
}

// Life in the tree.

// Builds the body anew in its rest shape at the node's transform, which other points or another scale need.
void SoftBody2D::rebuild_body(bool p_keeps_motion) {
	first_dents_ = get_dents();
	const bool had_body = body() != nullptr;
	if (p_keeps_motion && body() != nullptr) {
		const softbody::BodyFrame motion = softbody::measure_frame(*body());
		first_linear_velocity_ = to_godot(motion.velocity);
		first_angular_velocity_ = motion.angular_velocity;
	}
	if (space_ == nullptr) {
		stored_body_.reset();
		update_topology();
		return;
	}
	const Transform2D transform = get_global_transform();
	const auto design = make_design(transform);
	if (!accept("shape", design ? softbody::Status() : softbody::Status(design.error()))) {
		return;
	}
	const auto settings = make_settings(design.value());
	if (!accept("settings", settings ? softbody::Status() : softbody::Status(settings.error()))) {
		return;
	}
	auto fresh = softbody::SoftBodyData::create(design.value().shape, settings.value(), softbody::to_core_pose(transform));
	if (!accept("transform", fresh ? softbody::Status() : softbody::Status(fresh.error()))) {
		return;
	}
	built_scale_ = softbody::scale_and_skew(transform);
	design_ = design.value();
	polygon_reversed_ = design_->is_reversed;
	if (!had_body || std::size_t(first_dents_.size()) == fresh.value().point_count()) { // dents of other points are forgotten
		accept("dents", apply_dents(fresh.value(), first_dents_));
	}
	first_dents_.clear();
	space_->world().remove_soft_body(body_id_);
	body_id_ = space_->add_body(*this, std::move(fresh.value()));
	apply_pins();
	pins_.forget_places(); // their places in the frames of their targets are those of the new shape
	proxy_.forget_shape();
	apply_exceptions();
	known_transform_ = transform;
	lock_rotation();
	start_first_motion();
	apply_freeze();
	interpolation_.end();
	update_topology();
}

void SoftBody2D::enter_space() {
	if (Engine::get_singleton()->is_editor_hint()) {
		return;
	}
#ifdef DEBUG_ENABLED
	softbody::watch_engine_joints(get_tree());
#endif
	space_ = &SoftBodySimulation2D::get_singleton()->space_of(this);
	space_->add(*this);
	view_ = SoftBodySimulation2D::get_singleton()->drawing().add(get_viewport());
	note_mirror();
	bool sleeps = sleeping_;
	if (stored_body_) {
		sleeps = stored_body_->is_asleep(); // put to sleep since it left
		body_id_ = space_->add_body(*this, std::move(*stored_body_));
		stored_body_.reset();
		apply_exceptions();
		apply_freeze();
		take_over_transform();
	} else {
		rebuild_body(false);
	}
	if (sleeps) {
		set_sleeping(true);
	}
	if (get_tree()->is_debugging_collisions_hint()) {
		debug_drawing_ = std::make_unique<softbody::DebugDrawing>(get_canvas_item());
	}
	update_proxy_presence();
}

void SoftBody2D::leave_space() {
	if (space_ == nullptr) {
		return;
	}
	proxy_.leave();
	if (softbody::SoftBodyData *found = body()) {
		stored_body_ = std::make_unique<softbody::SoftBodyData>(std::move(*found));
		space_->world().remove_soft_body(body_id_);
		stored_body_->wake(); // what it slept on is not where it comes back to
	}
	space_->remove(*this);
	space_ = nullptr;
	body_id_ = {};
	interpolation_.end();
	SoftBodySimulation2D::get_singleton()->drawing().remove(view_);
	view_ = nullptr;
	unseen_frames_ = 0; // a body that comes in is shown to a frame first
	debug_drawing_.reset();
	contacts_.clear(); // what it touched is kept: the body may come back
	SoftBodySimulation2D::get_singleton()->drop_empty_spaces(); // last
}

void SoftBody2D::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE: {
			unfit_.tell(*this);
			tell_network_once();
			note_enabled();
			skin_.note_tint(softbody::is_tinted(*this));
			enter_space();
		} break;
		case NOTIFICATION_EXIT_TREE: {
			leave_space();
		} break;
		case NOTIFICATION_DISABLED:
		case NOTIFICATION_ENABLED: {
			note_enabled();
		} break;
		case NOTIFICATION_PAUSED:
		case NOTIFICATION_UNPAUSED: {
			note_change();
		} break;
		case NOTIFICATION_WORLD_2D_CHANGED: {
			if (space_ != nullptr) {
				leave_space();
				enter_space();
			}
		} break;
		case NOTIFICATION_TRANSFORM_CHANGED: {
			take_over_transform();
		} break;
		case NOTIFICATION_RESET_PHYSICS_INTERPOLATION: {
			take_over_transform();
			interpolation_.end();
			note_look();
		} break;
		case NOTIFICATION_DRAW: {
			draw();
		} break;
		default:
			break;
	}
}

// Agreement of node and body.

// Where the node belongs so that its hull, as designed, lies on the body's best-fitting frame.
Transform2D SoftBody2D::transform_at(const softbody::BodyFrame &p_frame) const {
	const softbody::Vec2 origin = p_frame.center - p_frame.rotation.apply(body()->shape().origin_offset());
	Transform2D transform = softbody::to_godot(p_frame.rotation) * built_scale_;
	transform.set_origin(to_godot(origin));
	return transform;
}

// The frame of the designed polygon as it is simulated, for a node at that transform.
Transform2D SoftBody2D::simulated_frame(const Transform2D &p_transform) const {
	const Transform2D scale = softbody::scale_and_skew(p_transform);
	return p_transform * (scale.affine_inverse() * structure_.simulated_scale(scale));
}

// A transform that differs from the one the body left behind was set by the user: the body follows.
void SoftBody2D::take_over_transform() {
	if (space_ == nullptr || body() == nullptr) {
		return;
	}
	const Transform2D transform = get_global_transform();
	if (transform == known_transform_) {
		return;
	}
	note_change();
	if (!transform.is_finite() || transform.determinant() == 0) {
		accept("transform", softbody::Error{ "transform", "a scale of zero or a non-finite value", "must be invertible", "set a finite position and a scale other than zero" });
		set_global_transform(known_transform_);
		note_mirror();
		return;
	}
	note_mirror();
	if (softbody::is_same_scale(softbody::scale_and_skew(transform), built_scale_, SCALE_TOLERANCE)) {
		body()->teleport(softbody::to_core_pose(known_transform_), softbody::to_core_pose(transform));
		note_move_by_user(known_transform_, transform);
		known_transform_ = transform;
		lock_rotation();
	} else {
		// Another size is another body: keep how it is deformed and how it moves. A mirrored one goes on in its direction and spin,
		// and its wobble is mirrored.
		const Transform2D back = simulated_frame(known_transform_).affine_inverse();
		const std::vector<softbody::Vec2> positions(body()->positions().begin(), body()->positions().end());
		const std::vector<softbody::Vec2> velocities(body()->velocities().begin(), body()->velocities().end());
		const softbody::BodyFrame motion = softbody::measure_frame(*body());
		const softbody::PointOrder order_before = order();
		const bool grows = Math::abs(transform.determinant()) > Math::abs(known_transform_.determinant());
		rebuild_body(false);
		if (grows) {
			growth_.note_growth();
			body()->pause_damage();
		}
		const Transform2D frame = simulated_frame(transform);
		const bool is_mirrored = order_before.is_reversed != polygon_reversed_;
		for (uint32_t i = 0; i < velocities.size(); i++) {
			const std::size_t before = std::size_t(order_before.mirror(order().mirror(int(i))));
			const Vector2 place = back.xform(to_godot(positions[before]));
			const softbody::Vec2 velocity = is_mirrored ? to_core((frame * back).basis_xform(to_godot(velocities[before]))) : velocities[before];
			body()->set_point(i, to_core(frame.xform(place)), velocity);
		}
		if (is_mirrored) {
			softbody::set_linear_velocity(*body(), motion.velocity);
			softbody::set_angular_velocity(*body(), motion.angular_velocity);
		}
	}
	note_look();
}

// The engine reports a changed transform at the end of the frame. A caller before that gets the body at the node's new place.
const softbody::SoftBodyData *SoftBody2D::followed_body() const {
	const_cast<SoftBody2D *>(this)->take_over_transform();
	return body();
}

// The caller may change it.
softbody::SoftBodyData *SoftBody2D::followed_body() {
	take_over_transform();
	note_change();
	return body();
}

void SoftBody2D::note_change() {
	if (space_ != nullptr) {
		space_->note_change(*this);
	}
}

void SoftBody2D::prepare_step(double p_delta) {
	take_over_transform();
	follow_pin_targets();
	if (softbody::SoftBodyData *found = body()) {
		const bool is_wanted = takes_part() && (!is_off_screen() || (values_.simulate_off_screen && !is_paused));
		const bool sleeps_through_pause = enabled_ && found->is_active() && found->is_asleep() && get_tree()->is_paused();
		found->set_active(is_wanted || sleeps_through_pause); // to take it out and back would wake it
		if (found->is_active() && !found->is_asleep() && !found->is_frozen()) {
			apply_constant_forces();
			hold_rotation(*found, p_delta);
			growth_.begin_step(*found, space_->world().gravity(), softbody::Real(p_delta));
		}
	}
	tell_structure_problems();
}

bool SoftBody2D::may_pause() const {
	const softbody::SoftBodyData *found = body();
	const bool is_moved = found != nullptr && (is_paused || (found->is_active() && !found->is_asleep() && !found->is_frozen()));
	return is_moved && values_.simulate_off_screen && !values_.important && is_off_screen();
}

void SoftBody2D::finish_step() {
	softbody::SoftBodyData *found = body();
	if (found == nullptr) {
		return;
	}
	// A body that has just stopped or fallen asleep is where its last step left it.
	has_stopped_ = moving_;
	const Transform2D before = known_transform_;
	moving_ = found->is_active() && !found->is_asleep() && !found->is_frozen();
	if (moving_ || has_stopped_) {
		undo_turn(*found);
		growth_.end_step(*found);
		follow_body();
	}
	const bool may_tear = moving_ && material_.values().tear_stretch > 0 && found->takes_damage();
	if (may_tear && softbody::is_overstretched(*found, softbody::Real(most_bearable_strain()))) {
		space_->note_overstretched(*this);
	}
	if (moving_) {
		interpolation_.begin(before);
	} else {
		interpolation_.end();
	}
}

// What must be asked for again in every tick keeps it busy. A body that has just stopped is busy for one tick more, in
// which its surroundings are read as those of a body at rest.
bool SoftBody2D::is_idle() const {
	const softbody::SoftBodyData *found = body();
	if (found == nullptr) {
		return true;
	}
	if (moving_ || has_stopped_) {
		return false;
	}
	const bool has_pin_targets = !pins_.points().is_empty() && !pins_.targets().is_empty();
	const bool is_asked = values_.contact_monitor || has_pin_targets || !values_.simulate_off_screen || is_paused ||
			(!enabled_ && values_.disable_mode != DISABLE_MODE_REMOVE);
	const bool has_felt_areas = !found->is_active() || (knows_areas_ && (engine_steps_ > 1 || !proxy_.is_in_space()));
	return !is_asked && has_felt_areas && proxy_.is_still();
}

// A negative scale of x is lost when a transform is set: it reads back as one of y and half a turn. A script that sets `scale.x` to
// -1 in every tick, as sprites are turned, would mirror the body in every tick. The engine takes the
// transform apart to tell a scale, so it is asked only where the user may have changed it.
void SoftBody2D::note_mirror() {
	is_mirrored_x_ = get_scale().x < 0;
}

void SoftBody2D::place_node(const Transform2D &p_transform) {
	if (!is_mirrored_x_) {
		set_global_transform(p_transform);
		return;
	}
	const Transform2D before = get_transform();
	const CanvasItem *parent = is_set_as_top_level() ? nullptr : Object::cast_to<CanvasItem>(get_parent());
	const Transform2D after = parent != nullptr ? parent->get_global_transform().affine_inverse() * p_transform : p_transform;
	const softbody::Rotation from = softbody::rotation_of(before), to = softbody::rotation_of(after);
	const softbody::Rotation turn = { from.c * to.c + from.s * to.s, from.c * to.s - from.s * to.c };
	const Transform2D turned = softbody::to_godot(turn) * before;
	if (!softbody::is_same_scale(turned, after, SCALE_TOLERANCE)) { // under a skewed parent, a rotation is more than a rotation
		set_global_transform(p_transform);
		is_mirrored_x_ = false;
		return;
	}
	set_position(after.get_origin());
	set_rotation(real_t(std::remainder(double(get_rotation()) + double(turn.angle()), Math_TAU)));
}

void SoftBody2D::follow_body() {
	if (space_ == nullptr) {
		return; // the first step in the tree does it
	}
	softbody::SoftBodyData &moved = *body();
	const softbody::BodyFrame frame = softbody::measure_frame(moved);
	moved.set_rotation_memory(frame.rotation); // for a body that may collapse later
	place_node(transform_at(frame));
	// Read back rather than remembered: under a transformed parent it may differ in the last digit,
	// and such a digit must not look like a move by the user.
	known_transform_ = get_global_transform();
	note_look();
}

} // namespace godot
