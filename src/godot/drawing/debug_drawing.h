// SPDX-License-Identifier: MIT
// Draws a body for Debug → Visible Collision Shapes.
#pragma once

#include "core/dynamics/substep_plan.h"
#include "core/model/contact.h"
#include "core/model/soft_body_data.h"

#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/transform2d.hpp>

#include <span>

namespace softbody {

/// Draws on a canvas item of its own, above the node: the hull as Godot draws shapes, springs in the color of their
/// strain (red is stretched, blue pressed), the center of mass, contacts if the body monitors them, and its stiffness:
/// the bound of its highest frequency over its substeps. Made only while such shapes are visible.
class DebugDrawing {
public:
	/// `parent` is the node's canvas item.
	explicit DebugDrawing(const godot::RID &parent);
	DebugDrawing(const DebugDrawing &) = delete;
	DebugDrawing &operator=(const DebugDrawing &) = delete;
	~DebugDrawing();

	/// Replaces the drawing. `points` are the body's in the node's frame, now at `frame`; `contacts` are this body's.
	void draw(const SoftBodyData &body, std::span<const Vec2> points, const godot::Transform2D &frame,
			std::span<const Contact> contacts, const SubstepPlan &plan);

private:
	void draw_hull(const SoftBodyData &body, std::span<const Vec2> points);
	void draw_springs(const SoftBodyData &body, std::span<const Vec2> points, real_t pixel);
	void draw_contacts(std::span<const Contact> contacts, const godot::Transform2D &frame, real_t pixel);
	void draw_text(const SubstepPlan &plan, const godot::Transform2D &frame, const godot::Vector2 &place);

	godot::RID item_;
};

} // namespace softbody
