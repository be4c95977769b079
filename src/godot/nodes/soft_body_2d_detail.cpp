// SPDX-License-Identifier: MIT
// What is simulated for the polygon that is drawn: what scripts and the editor are told of it, and how it changes while it moves.
#include "godot/nodes/soft_body_2d.h"

#include "core/creator/simplify_outline.h"
#include "core/geometry/circle.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "godot/convert.h"

#include <cstddef>
#include <span>
#include <vector>

using softbody::Vec2;

namespace godot {

Dictionary SoftBody2D::get_detail_report() const {
	const softbody::DrawnOutline *outline = structure_.outline();
	Dictionary report;
	report["points_drawn"] = structure_.polygon_count();
	report["points_simulated"] = structure_.hull_count();
	report["outline_error"] = outline != nullptr ? outline->error() : 0.0;
	report["outline_error_px"] = outline != nullptr ? outline->error() * softbody::radius_of_area(softbody::to_core(get_polygon())) : 0.0;
	const auto at_tolerance = structure_.outline_at_tolerance();
	report["points_at_tolerance"] = at_tolerance != nullptr ? int(at_tolerance->hull().size()) : structure_.polygon_count();
	const softbody::SoftBodyData *found = body();
	if (found == nullptr || space_ == nullptr || !found->is_active()) {
		report["level"] = "paused";
	} else if (found->is_asleep() || found->is_frozen()) {
		report["level"] = "asleep";
	} else {
		report["level"] = space_->simulator().has_flown(body_id_) ? "rigid" : "full";
	}
	return report;
}

softbody::DrawnMotion SoftBody2D::drawn_motion() const {
	softbody::DrawnMotion motion;
	const softbody::SoftBodyData *found = followed_body();
	if (found == nullptr || space_ == nullptr) {
		return motion;
	}
	const std::size_t drawn = std::size_t(structure_.polygon_count());
	const std::size_t hull = std::size_t(structure_.hull_count());
	const std::size_t count = std::size_t(structure_.point_count());
	const auto split = [&](std::span<const Vec2> p_values, std::vector<Vec2> &r_outline, std::vector<Vec2> &r_inner) {
		if (const softbody::DrawnOutline *outline = structure_.outline()) {
			const std::span<const Vec2> followed = outline->follow(p_values, order());
			r_outline.assign(followed.begin(), followed.begin() + std::ptrdiff_t(drawn));
		} else {
			for (std::size_t i = 0; i < drawn; i++) {
				r_outline.push_back(p_values[core_index(int(i))]);
			}
		}
		if (p_values.size() == count) { // a body of triangles has other points inside
			r_inner.assign(p_values.begin() + std::ptrdiff_t(hull), p_values.end());
		}
	};
	split(found->positions(), motion.outline, motion.inner);
	split(found->velocities(), motion.outline_velocities, motion.inner_velocities);
	const softbody::BodyFrame frame = softbody::measure_frame(*found);
	motion.velocity = frame.velocity;
	motion.angular_velocity = frame.angular_velocity;
	return motion;
}

// The new body has been made in its rest shape. It is put where the old one was drawn, and then has the old one's velocity and
// spin: its points share the mass in another way. A body of triangles stays in its rest shape, as its inner points are others.
void SoftBody2D::take_over_motion(const softbody::DrawnMotion &p_motion) {
	softbody::SoftBodyData *found = body();
	const std::size_t hull = std::size_t(structure_.hull_count());
	if (found == nullptr || p_motion.outline.size() != std::size_t(structure_.polygon_count()) || found->point_count() != hull + p_motion.inner.size()) {
		return;
	}
	const softbody::DrawnOutline *outline = structure_.outline();
	const std::vector<Vec2> positions = outline != nullptr ? outline->fit(p_motion.outline) : p_motion.outline;
	const std::vector<Vec2> velocities = outline != nullptr ? outline->fit(p_motion.outline_velocities) : p_motion.outline_velocities;
	for (std::size_t i = 0; i < hull; i++) {
		found->set_point(uint32_t(core_index(int(i))), positions[i], velocities[i]);
	}
	for (std::size_t i = 0; i < p_motion.inner.size(); i++) {
		found->set_point(uint32_t(hull + i), p_motion.inner[i], p_motion.inner_velocities[i]);
	}
	if (structure_.values().center_point) { // it belongs in the middle of the hull's points, which are others now
		found->set_point(uint32_t(found->point_count() - 1), softbody::mean_of(positions), softbody::mean_of(velocities));
	}
	softbody::set_linear_velocity(*found, p_motion.velocity);
	softbody::set_angular_velocity(*found, p_motion.angular_velocity);
	follow_body();
}

} // namespace godot
