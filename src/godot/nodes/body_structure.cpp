// SPDX-License-Identifier: MIT
// Points and springs of a node as its user gave them.
#include "godot/nodes/body_structure.h"

#include "core/base/constants.h"
#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "godot/server/shape_cache.h"

#include <algorithm>

using namespace godot;

namespace softbody {

namespace {

// Points placed inside a body of triangles, for two of its hull points: within a percent of R down to half the height, and a
// quarter of the time that eight take.
constexpr int TRIANGLE_POINTS_A_PAIR = 3;

std::vector<Real> to_reals(const PackedFloat32Array &p_values) {
	return std::vector<Real>(p_values.ptr(), p_values.ptr() + p_values.size());
}

} // namespace

Status BodyStructure::check(const std::string &p_name, const PackedVector2Array &p_points) {
	if (p_name == "polygon") {
		return check_hull(to_core(p_points));
	}
	if (p_points.size() > MAX_HULL_POINTS) {
		return Error{ p_name, std::to_string(p_points.size()) + " points", "must be at most " + std::to_string(MAX_HULL_POINTS), "remove points" };
	}
	return check_all_finite(p_name, p_points);
}

Status BodyStructure::check(const std::string &p_name, const PackedFloat32Array &p_scales) {
	const bool may_be_zero = p_name != "spring_length_scales";
	for (int64_t i = 0; i < p_scales.size(); i++) {
		const std::string entry = p_name + "[" + std::to_string(i) + "]";
		if (Status status = may_be_zero ? check_at_least(entry, p_scales[i], 0, "") : check_above(entry, p_scales[i], 0, "")) {
			return status;
		}
	}
	return {};
}

std::vector<Vec2> BodyStructure::rest_points(bool p_reversed) const {
	std::vector<Vec2> points = to_core(hull());
	if (p_reversed) {
		std::reverse(points.begin() + 1, points.end());
	}
	Vec2 sum;
	for (const Vec2 point : points) {
		sum += point;
	}
	const Vec2 middle = sum * (1 / Real(points.size()));
	for (const Vector2 &point : values_.inner_points) {
		points.push_back(to_core(point));
	}
	if (values_.center_point) {
		points.push_back(middle);
	}
	return points;
}

std::shared_ptr<const DrawnOutline> BodyStructure::make_outline(BodyProperties::DetailMode p_mode) const {
	if (p_mode == BodyProperties::DETAIL_MODE_AS_DRAWN) {
		return nullptr;
	}
	SimplifyOptions options;
	options.tolerance = detail_.tolerance;
	options.least_edge = LINEAR_SLOP * PIXELS_PER_METER;
	if (p_mode == BodyProperties::DETAIL_MODE_POINT_COUNT) {
		options.most_points = detail_.point_count;
	}
	if (detail_.weights.size() == values_.polygon.size()) {
		options.weights.assign(detail_.weights.ptr(), detail_.weights.ptr() + detail_.weights.size());
	}
	return DrawnOutline::find_or_make(values_.polygon, options);
}

const DrawnOutline *BodyStructure::outline() const {
	if (!is_outline_known_) {
		outline_ = make_outline(detail_.mode);
		is_outline_known_ = true;
		const bool has_holes = !values_.holes.empty() && !check_holes("holes", values_.holes, to_core(values_.polygon));
		holes_ = has_holes ? std::make_shared<const DrawnHoles>(values_.holes, values_.polygon, hull()) : nullptr;
	}
	return outline_.get();
}

const DrawnHoles *BodyStructure::holes() const {
	outline();
	return holes_.get();
}

const Holes &BodyStructure::holes_in_use() const {
	static const Holes NONE;
	return holes() != nullptr ? values_.holes : NONE;
}

std::shared_ptr<const DrawnOutline> BodyStructure::outline_at_tolerance() const {
	return make_outline(BodyProperties::DETAIL_MODE_AUTOMATIC);
}

Status BodyStructure::check_as_drawn() const {
	if (holes() != nullptr) {
		return Error{ "holes", std::to_string(values_.holes.size()), "must be none for cuts and tears", "clear holes" };
	}
	if (outline() == nullptr) {
		return {};
	}
	return Error{ "detail_mode", std::to_string(hull_count()) + " points simulated of " + std::to_string(polygon_count()) + " drawn", "must be As Drawn for cuts and tears", "set detail_mode to As Drawn" };
}

bool BodyStructure::is_painted() const {
	return !values_.stiffness_scales.is_empty() || !values_.damping_scales.is_empty() || !values_.length_scales.is_empty();
}

StructureOptions BodyStructure::options(const Transform2D &p_scale) const {
	StructureOptions options;
	options.stiffness = 1;
	options.damping = 1;
	options.triangle_points = std::min(TRIANGLE_POINTS_A_PAIR * hull_count() / 2, MAX_HULL_POINTS);
	options.center_point = values_.center_point;
	options.balanced_mass = outline() != nullptr;
	options.inner_points = to_core(p_scale.xform(values_.inner_points));
	for (const std::vector<Vec2> &hole : holes_in_use()) {
		options.holes.push_back(to_core(p_scale.xform(to_godot(std::span<const Vec2>(hole)))));
	}
	for (int64_t i = 0; i + 1 < values_.springs.size(); i += 2) {
		options.springs.push_back({ uint32_t(values_.springs[i]), uint32_t(values_.springs[i + 1]) });
	}
	options.spring_stiffness_scales = to_reals(values_.stiffness_scales);
	options.spring_damping_scales = to_reals(values_.damping_scales);
	options.spring_length_scales = to_reals(values_.length_scales);
	return options;
}

Transform2D BodyStructure::simulated_scale(const Transform2D &p_scale) const {
	if (p_scale.columns[0].length() >= 1 && p_scale.columns[1].length() >= 1) {
		return p_scale; // as nearly always, and asked for in every frame
	}
	Rect2 box(values_.polygon.is_empty() ? Vector2() : values_.polygon[0], Vector2());
	for (const Vector2 &point : values_.polygon) {
		box.expand_to(point);
	}
	Transform2D scale = p_scale;
	for (int axis = 0; axis < 2; axis++) {
		const real_t factor = scale.columns[axis].length();
		const real_t least = MIN(real_t(1), LEAST_WIDTH / box.size[axis]);
		if (factor > 0 && factor < least) {
			scale.columns[axis] *= least / factor;
		}
	}
	return scale;
}

Result<std::shared_ptr<const SoftBodyShape>> BodyStructure::make_shape(std::span<const Vec2> p_hull, Real p_size,
		StructureOptions &r_options, PackedStringArray &r_problems) {
	auto shape = find_or_create_shape(p_hull, r_options, p_size);
	while (!shape && leave_out(r_options, shape.error().name)) {
		r_problems.push_back(to_godot(shape.error()));
		shape = find_or_create_shape(p_hull, r_options, p_size);
	}
	return shape;
}

void BodyStructure::append_warnings(PackedStringArray &r_warnings) const {
	const std::vector<Vec2> hull = to_core(values_.polygon);
	if (!detail_.weights.is_empty() && detail_.weights.size() != values_.polygon.size()) {
		r_warnings.push_back("'detail_weights' has " + String::num_int64(detail_.weights.size()) + " entries and the polygon " + String::num_int64(values_.polygon.size()) + " points, so it is not used. Give it one entry for each point of the polygon, or none.");
	}
	if (!values_.holes.empty()) {
		if (const Status status = check_holes("holes", values_.holes, hull)) {
			r_warnings.push_back("The body has no holes, as they do not fit the polygon: " + to_godot(*status) + ".");
		}
	}
	for (int64_t i = 0; i < values_.inner_points.size(); i++) {
		if (!point_in_polygon(to_core(values_.inner_points[i]), hull)) {
			r_warnings.push_back("inner_points[" + String::num_int64(i) + "] lies outside the polygon: it is part of the body, but touches nothing. Move it inside.");
		}
	}
}

} // namespace softbody
