// SPDX-License-Identifier: MIT
// The node: its life in the tree and its agreement with the body in the core.
#include "godot/nodes/soft_body_2d.h"

#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "godot/convert.h"
#include "godot/server/soft_body_server_2d.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/world2d.hpp>
#include <godot_cpp/core/math.hpp>

#include <utility>
#include <vector>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

constexpr double DEFAULT_RADIUS = 50; // px
constexpr int DEFAULT_POINTS = 16;

// A rotation read back from a matrix differs in the last digits; that is no change of scale.
bool same_scale(const Transform2D &p_a, const Transform2D &p_b) {
	const real_t size = p_a.columns[0].length() + p_a.columns[1].length();
	return p_a.columns[0].distance_to(p_b.columns[0]) <= 1e-4 * size &&
			p_a.columns[1].distance_to(p_b.columns[1]) <= 1e-4 * size;
}

} // namespace

SoftBody2D::SoftBody2D() {
	hull_ = make_circle_hull(DEFAULT_RADIUS, DEFAULT_POINTS);
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

// Builds the body anew at the node's transform, at rest. Only another hull or scale needs this.
void SoftBody2D::rebuild_body() {
	if (space_ == nullptr) {
		stored_body_.reset();
		update_topology();
		return;
	}
	const Transform2D transform = get_global_transform();
	const auto shape = make_shape(transform);
	if (!accept("shape", shape ? softbody::Status() : softbody::Status(shape.error()))) {
		return;
	}
	auto fresh = softbody::SoftBodyData::create(shape.value(), make_settings(), softbody::to_core_pose(transform));
	if (!accept("transform", fresh ? softbody::Status() : softbody::Status(fresh.error()))) {
		return;
	}
	built_scale_ = softbody::scale_and_skew(transform);
	hull_reversed_ = (softbody::signed_area(to_core(hull_)) < 0) != (built_scale_.determinant() < 0);
	space_->world().remove_soft_body(body_id_);
	body_id_ = space_->world().add_soft_body(std::move(fresh.value()));
	proxy_.forget_shape();
	known_transform_ = transform;
	current_ = current_pose();
	previous_ = current_;
	update_topology();
}

void SoftBody2D::enter_space() {
	if (Engine::get_singleton()->is_editor_hint()) {
		return;
	}
	space_ = SoftBodyServer2D::get_singleton()->add_body(this);
	if (stored_body_) {
		body_id_ = space_->world().add_soft_body(std::move(*stored_body_));
		stored_body_.reset();
		take_over_transform();
	} else {
		rebuild_body();
	}
	update_proxy_presence();
	set_process_internal(true);
}

void SoftBody2D::leave_space() {
	if (space_ == nullptr) {
		return;
	}
	proxy_.leave();
	if (softbody::SoftBodyData *found = body()) {
		stored_body_ = std::move(*found);
		space_->world().remove_soft_body(body_id_);
	}
	space_ = nullptr;
	body_id_ = {};
	// Last: the server drops a space that has no nodes left.
	SoftBodyServer2D::get_singleton()->remove_body(this);
}

void SoftBody2D::_notification(int p_what) {
	switch (p_what) {
		case NOTIFICATION_ENTER_TREE: {
			enter_space();
		} break;
		case NOTIFICATION_EXIT_TREE: {
			leave_space();
		} break;
		case NOTIFICATION_DISABLED:
		case NOTIFICATION_ENABLED: {
			update_proxy_presence();
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
		case NOTIFICATION_INTERNAL_PROCESS: {
			if (moving_ || redraw_needed_) {
				redraw_needed_ = false;
				queue_redraw();
			}
		} break;
		case NOTIFICATION_DRAW: {
			draw();
		} break;
		default:
			break;
	}
}

void SoftBody2D::reset() {
	rebuild_body();
}

// Agreement of node and body.

// Where the node belongs so that its hull, as designed, lies on the body's best-fitting frame.
Transform2D SoftBody2D::body_transform() const {
	const softbody::SoftBodyData &data = *body();
	const softbody::BodyFrame frame = softbody::measure_frame(data);
	const softbody::Vec2 origin = frame.centre - frame.rotation.apply(data.shape().origin_offset());
	Transform2D transform = Transform2D(frame.rotation.angle(), Vector2()) * built_scale_;
	transform.set_origin(to_godot(origin));
	return transform;
}

SoftBody2D::Pose SoftBody2D::current_pose() const {
	return { known_transform_, known_transform_.affine_inverse().xform(to_godot(body()->positions())) };
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
	if (!transform.is_finite() || transform.determinant() == 0) {
		accept("transform", softbody::Error{ "transform", "a scale of zero or a non-finite value", "must be invertible", "set a finite position and a scale other than zero" });
		set_global_transform(known_transform_);
		return;
	}
	if (same_scale(softbody::scale_and_skew(transform), built_scale_)) {
		body()->teleport(softbody::to_core_pose(known_transform_), softbody::to_core_pose(transform));
		known_transform_ = transform;
		current_ = current_pose();
		previous_ = current_;
	} else {
		// Another size is another body: keep how it is deformed and how it moves.
		const PackedVector2Array deformed = current_pose().local_points;
		const std::vector<softbody::Vec2> velocities(body()->velocities().begin(), body()->velocities().end());
		const bool was_reversed = hull_reversed_;
		rebuild_body();
		if (was_reversed == hull_reversed_) {
			for (uint32_t i = 0; i < velocities.size(); i++) {
				body()->set_point(i, to_core(transform.xform(deformed[i])), velocities[i]);
			}
		}
		current_ = current_pose();
		previous_ = current_;
	}
	redraw_needed_ = true;
}

// The engine reports a changed transform at the end of the frame; whoever asks earlier gets the body
// where the node has been put.
const softbody::SoftBodyData *SoftBody2D::followed_body() const {
	const_cast<SoftBody2D *>(this)->take_over_transform();
	return body();
}

softbody::SoftBodyData *SoftBody2D::followed_body() {
	take_over_transform();
	return body();
}

void SoftBody2D::prepare_step() {
	take_over_transform();
	if (softbody::SoftBodyData *found = body()) {
		found->set_active(can_process());
	}
}

void SoftBody2D::finish_step() {
	if (body() == nullptr) {
		return;
	}
	redraw_needed_ = redraw_needed_ || moving_; // after the last move, draw the end of the interpolation once
	moving_ = body()->is_active();
	previous_ = current_;
	if (moving_) {
		body()->set_rotation_memory(softbody::measure_frame(*body()).rotation); // for a body that may collapse later
		set_global_transform(body_transform());
		// Read back rather than remembered: under a transformed parent it may differ in the last digit,
		// and such a digit must not look like a move by the user.
		known_transform_ = get_global_transform();
		current_ = current_pose();
	}
}

} // namespace godot
