// SPDX-License-Identifier: MIT
// State of the coming frame that all bodies need for drawing.
#include "godot/drawing/drawing_frame.h"

#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/math.hpp>
#include <godot_cpp/core/object.hpp>

#include <algorithm>

using namespace godot;

namespace softbody {

namespace {

constexpr int SUB_VIEWPORT_UPDATE_ONCE = 1; // SubViewport.UPDATE_ONCE

// Largest motion of the view's corners over the canvas.
double way_of_view(const Transform2D &p_before, const Transform2D &p_now, const Rect2 &p_screen) {
	const Transform2D before = p_before.affine_inverse();
	const Transform2D now = p_now.affine_inverse();
	double way = 0;
	const Vector2 right = Vector2(p_screen.size.x, 0);
	for (const Vector2 &corner : { p_screen.position, p_screen.position + right, p_screen.get_end() }) {
		way = MAX(way, double(before.xform(corner).distance_to(now.xform(corner))));
	}
	return way;
}

} // namespace

double present_fraction() {
	return CLAMP(Engine::get_singleton()->get_physics_interpolation_fraction(), 0.0, 1.0);
}

BodyView::BodyView(Viewport *viewport) :
		viewport_(viewport->get_instance_id()), is_sub_viewport_(viewport->is_class("SubViewport")) {}

bool BodyView::is_carried_by(const Node *node) const {
	return std::ranges::find(carriers_, node) != carriers_.end();
}

void BodyView::begin_frame() {
	carriers_.clear();
	Viewport *viewport = Object::cast_to<Viewport>(ObjectDB::get_instance(viewport_));
	if (viewport == nullptr) {
		return;
	}
	const Transform2D canvas_transform = viewport->get_canvas_transform();
	is_unsteady_ = is_sub_viewport_ && int(viewport->get("render_target_update_mode")) == SUB_VIEWPORT_UPDATE_ONCE;
	if (canvas_transform != canvas_transform_) {
		is_unsteady_ = is_unsteady_ ||
				!(way_of_view(canvas_transform_, canvas_transform, viewport->get_visible_rect()) < DrawingFrame::MARGIN / 2);
		canvas_transform_ = canvas_transform;
	}
	// A camera that smooths its way does not move in ticks.
	const Node *camera = Object::cast_to<Node>(static_cast<Object *>(viewport->call("get_camera_2d")));
	if (camera == nullptr || bool(camera->get("position_smoothing_enabled")) || bool(camera->get("top_level"))) {
		return;
	}
	for (const Node *node = camera->get_parent(); node != nullptr; node = node->get_parent()) {
		carriers_.push_back(node);
	}
}

BodyView *DrawingFrame::add(Viewport *viewport) {
	const std::uint64_t id = viewport->get_instance_id();
	auto found = std::ranges::find_if(views_, [id](const auto &p_view) { return p_view->viewport_ == id; });
	if (found == views_.end()) {
		views_.push_back(std::make_unique<BodyView>(viewport));
		found = views_.end() - 1;
	}
	(*found)->users_++;
	return found->get();
}

void DrawingFrame::remove(BodyView *view) {
	view->users_--;
	std::erase_if(views_, [](const auto &p_view) { return p_view->users_ == 0; });
}

void DrawingFrame::begin() {
	fraction_ = present_fraction();
	for (const auto &view : views_) {
		view->begin_frame();
	}
}

} // namespace softbody
