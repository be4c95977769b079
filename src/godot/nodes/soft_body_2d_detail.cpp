// SPDX-License-Identifier: MIT
// What is simulated for the polygon that is drawn: what scripts and the editor are told of it.
#include "godot/nodes/soft_body_2d.h"

#include "core/creator/simplify_outline.h"
#include "godot/convert.h"

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
	return report;
}

} // namespace godot
