// SPDX-License-Identifier: MIT
// Points and springs of the node: polygon, inner points, which points springs join and how strong these are.
//
// A scene file sets properties one after the other, so what must fit the others can be judged only by them all: a
// property refuses what can never be right, and what does not fit now is kept, left out of the body, and told.
#include "godot/nodes/soft_body_2d.h"

#include "core/base/constants.h"
#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "godot/convert.h"
#include "godot/server/shape_cache.h"
#include "godot/server/soft_body_space_2d.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <algorithm>
#include <string>
#include <utility>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

softbody::Status check_inner_points(const PackedVector2Array &p_points) {
	if (p_points.size() > softbody::MAX_HULL_POINTS) {
		return softbody::Error{ "inner_points", std::to_string(p_points.size()) + " points", "must be at most " + std::to_string(softbody::MAX_HULL_POINTS), "remove points" };
	}
	for (int64_t i = 0; i < p_points.size(); i++) {
		if (!p_points[i].is_finite()) {
			return softbody::Error{ "inner_points[" + std::to_string(i) + "]", "non-finite", "must be finite", "check the computation that produced this value" };
		}
	}
	return {};
}

softbody::Status check_springs(const PackedInt32Array &p_springs) {
	if (p_springs.size() % 2 != 0) {
		return softbody::Error{ "springs", std::to_string(p_springs.size()) + " entries", "must be pairs of point indices", "add or remove an entry" };
	}
	std::vector<std::pair<int32_t, int32_t>> pairs;
	for (int64_t i = 0; i < p_springs.size(); i += 2) {
		const auto [a, b] = std::minmax(p_springs[i], p_springs[i + 1]);
		if (a < 0 || a == b) {
			return softbody::Error{ "springs[" + std::to_string(i / 2) + "]", "points " + std::to_string(p_springs[i]) + " and " + std::to_string(p_springs[i + 1]), "must be two different indices >= 0", "choose other points" };
		}
		pairs.push_back({ a, b });
	}
	std::ranges::sort(pairs);
	const auto twice = std::ranges::adjacent_find(pairs);
	if (twice != pairs.end()) {
		return softbody::Error{ "springs", "points " + std::to_string(twice->first) + " and " + std::to_string(twice->second) + " twice", "must join each two points once", "remove one of the two springs" };
	}
	return {};
}

softbody::Status check_scales(const std::string &p_name, const PackedFloat32Array &p_scales, bool p_may_be_zero) {
	for (int64_t i = 0; i < p_scales.size(); i++) {
		const std::string entry = p_name + "[" + std::to_string(i) + "]";
		if (softbody::Status status = p_may_be_zero ? softbody::check_at_least(entry, p_scales[i], 0, "") : softbody::check_above(entry, p_scales[i], 0, "")) {
			return status;
		}
	}
	return {};
}

std::vector<softbody::Real> to_reals(const PackedFloat32Array &p_values) {
	return std::vector<softbody::Real>(p_values.ptr(), p_values.ptr() + p_values.size());
}

// Points placed inside a body of triangles, for two of its hull points: within a percent of R down to half the height, and a
// quarter of the time that eight take.
constexpr int TRIANGLE_POINTS_A_PAIR = 3;

// Removes from the structure the part that was refused, if it can be done without.
bool leave_out(softbody::StructureOptions &r_options, const std::string &p_refused) {
	const auto is_of = [&](const char *p_part) { return p_refused.starts_with(p_part); };
	if (is_of("spring_stiffness_scales")) {
		return !std::exchange(r_options.spring_stiffness_scales, {}).empty();
	}
	if (is_of("spring_damping_scales")) {
		return !std::exchange(r_options.spring_damping_scales, {}).empty();
	}
	if (is_of("spring_length_scales")) {
		return !std::exchange(r_options.spring_length_scales, {}).empty();
	}
	if (is_of("springs") && !p_refused.ends_with("stiffness") && !p_refused.ends_with("damping")) {
		// Factors belong to these springs.
		r_options.spring_stiffness_scales.clear();
		r_options.spring_damping_scales.clear();
		r_options.spring_length_scales.clear();
		return !std::exchange(r_options.springs, {}).empty();
	}
	return false;
}

} // namespace

// Properties.

void SoftBody2D::set_polygon(const PackedVector2Array &p_polygon) {
	change_structure("polygon", polygon_, p_polygon, softbody::check_hull(to_core(p_polygon)));
}

void SoftBody2D::set_center_point(bool p_center_point) {
	if (center_point_ != p_center_point) {
		change_structure("center_point", center_point_, p_center_point, {});
	}
}

void SoftBody2D::set_inner_points(const PackedVector2Array &p_points) {
	change_structure("inner_points", inner_points_, p_points, check_inner_points(p_points));
}

void SoftBody2D::set_springs(const PackedInt32Array &p_springs) {
	change_structure("springs", springs_, p_springs, check_springs(p_springs));
}

void SoftBody2D::set_spring_stiffness_scales(const PackedFloat32Array &p_scales) {
	change_structure("spring_stiffness_scales", spring_stiffness_scales_, p_scales, check_scales("spring_stiffness_scales", p_scales, true));
}

void SoftBody2D::set_spring_damping_scales(const PackedFloat32Array &p_scales) {
	change_structure("spring_damping_scales", spring_damping_scales_, p_scales, check_scales("spring_damping_scales", p_scales, true));
}

void SoftBody2D::set_spring_length_scales(const PackedFloat32Array &p_scales) {
	change_structure("spring_length_scales", spring_length_scales_, p_scales, check_scales("spring_length_scales", p_scales, false));
}

// What keeps the points lets the body go on as it is deformed; other points make another body.
template <class Value>
bool SoftBody2D::change_structure(const StringName &p_property, Value &r_member, const Value &p_value, const softbody::Status &p_status) {
	if (!accept(p_property, p_status)) {
		return false;
	}
	const Value old = std::exchange(r_member, p_value);
	design_.reset();
	if (!accept_shape(p_property)) {
		r_member = old;
		return false;
	}
	const void *member = &r_member;
	if (member == &polygon_ || member == &center_point_ || member == &inner_points_) {
		rebuild_body(true);
	} else {
		apply_shape();
	}
	update_configuration_warnings();
	return true;
}

// From properties to the core.

softbody::Result<SoftBody2D::Design> SoftBody2D::make_design(const Transform2D &p_transform, bool p_is_draft) const {
	const Transform2D scale = softbody::scale_and_skew(p_transform);
	const std::vector<softbody::Vec2> hull = to_core(scale.xform(polygon_));
	const double area = softbody::signed_area(hull);
	Design made;
	made.scale = scale;
	made.area = std::abs(area);
	made.mass = mass_of_area(made.area);
	made.is_reversed = area < 0;
	made.wanted = choose_model();
	made.used = made.wanted;

	softbody::StructureOptions options;
	options.mass = softbody::Real(made.mass);
	options.stiffness = 1;
	options.damping = 1;
	options.elastic = !p_is_draft && made.used.model == ELASTIC_MODEL_MODES;
	options.elastic_triangles = !p_is_draft && made.used.model == ELASTIC_MODEL_TRIANGLES;
	options.triangle_points = std::min(TRIANGLE_POINTS_A_PAIR * int(hull.size()) / 2, softbody::MAX_HULL_POINTS);
	options.center_point = center_point_;
	options.inner_points = to_core(scale.xform(inner_points_));
	for (int64_t i = 0; i + 1 < springs_.size(); i += 2) {
		options.springs.push_back({ uint32_t(springs_[i]), uint32_t(springs_[i + 1]) });
	}
	options.spring_stiffness_scales = to_reals(spring_stiffness_scales_);
	options.spring_damping_scales = to_reals(spring_damping_scales_);
	options.spring_length_scales = to_reals(spring_length_scales_);
	for (;;) {
		auto shape = softbody::find_or_create_shape(hull, options);
		if (!shape && leave_out(options, shape.error().name)) {
			made.problems.push_back(to_godot(shape.error()));
			continue;
		}
		const bool is_solid = options.elastic || options.elastic_triangles;
		if (!shape && !is_solid) {
			return shape.error();
		}
		softbody::Status problem = shape ? softbody::Status() : softbody::Status(shape.error());
		if (shape) {
			made.shape = shape.value();
			made.has_deep_dents = softbody::has_deep_dents(hull);
			problem = check_elasticity(made);
		}
		if (!problem) {
			return made;
		}
		made.model_problem = problem;
		made.problems.push_back(to_godot(*problem));
		made.used = { ELASTIC_MODEL_NETWORK, "unfit" };
		if (!is_solid) {
			return made;
		}
		options.elastic = false;
		options.elastic_triangles = false;
	}
}

Transform2D SoftBody2D::design_transform() const {
	if (body() != nullptr) {
		return built_scale_;
	}
	const Transform2D transform = is_inside_tree() ? get_global_transform() : get_transform();
	return transform.is_finite() && transform.determinant() != 0 ? transform : Transform2D();
}

const SoftBody2D::Design *SoftBody2D::design() const {
	const Transform2D transform = design_transform();
	if (design_ && design_->scale != softbody::scale_and_skew(transform) && body() == nullptr) {
		design_.reset();
	}
	if (!design_) {
		if (auto made = make_design(transform)) {
			design_ = std::move(made.value());
		}
	}
	return design_ ? &*design_ : nullptr;
}

// Later than the setters, which are called one after the other: what still does not fit when the body is stepped is meant.
void SoftBody2D::tell_structure_problems() {
	if (!design_ || design_->problems == told_problems_) {
		return;
	}
	told_problems_ = design_->problems;
	if (!told_problems_.is_empty()) {
		ERR_PRINT(describe() + ": left out of the body: " + String("; ").join(told_problems_) + ".");
	}
}

// Springs.

const softbody::Spring2D *SoftBody2D::find_spring(int p_index) const {
	const Design *found = design();
	const int count = found != nullptr ? int(found->shape->springs().size()) : 0;
	ERR_FAIL_COND_V_MSG(p_index < 0 || p_index >= count, nullptr, describe() + ": spring index " + itos(p_index) + " must be at least 0 and below " + itos(count) + ".");
	return &found->shape->springs()[std::size_t(p_index)];
}

int SoftBody2D::get_spring_count() const {
	const Design *found = design();
	return found != nullptr ? int(found->shape->springs().size()) : 0;
}

Vector2i SoftBody2D::get_spring_points(int p_index) const {
	const softbody::Spring2D *spring = find_spring(p_index);
	if (spring == nullptr) {
		return Vector2i(-1, -1);
	}
	return Vector2i(public_index(spring->a, design_->is_reversed), public_index(spring->b, design_->is_reversed));
}

PackedInt32Array SoftBody2D::get_all_springs() const {
	PackedInt32Array all;
	if (const Design *found = design()) {
		all.resize(int64_t(2 * found->shape->springs().size()));
		int32_t *write = all.ptrw();
		for (const softbody::Spring2D &spring : found->shape->springs()) {
			*write++ = public_index(spring.a, found->is_reversed);
			*write++ = public_index(spring.b, found->is_reversed);
		}
	}
	return all;
}

// By which the stiffness and the damping of the shape's springs are multiplied. 0 where springs take no part.
std::pair<double, double> SoftBody2D::spring_scales() const {
	const Design *found = design();
	const auto settings = found != nullptr ? make_settings(*found) : softbody::Result<softbody::BodySettings>(softbody::Error{});
	if (!settings) {
		return { 0, 0 };
	}
	return { double(settings.value().spring_stiffness_scale), double(settings.value().spring_damping_scale) };
}

double SoftBody2D::get_spring_stiffness(int p_index) const {
	const softbody::Spring2D *spring = find_spring(p_index);
	return spring != nullptr ? double(spring->stiffness) * spring_scales().first : 0.0;
}

double SoftBody2D::get_spring_damping(int p_index) const {
	const softbody::Spring2D *spring = find_spring(p_index);
	return spring != nullptr ? double(spring->damping) * spring_scales().second : 0.0;
}

double SoftBody2D::get_spring_rest_length(int p_index) const {
	const softbody::Spring2D *spring = find_spring(p_index);
	return spring != nullptr ? double(spring->rest_length) : 0.0;
}

double SoftBody2D::get_spring_length(int p_index) const {
	const softbody::SoftBodyData *found = followed_body();
	const softbody::Spring2D *spring = find_spring(p_index);
	if (spring == nullptr) {
		return 0;
	}
	const std::span<const softbody::Vec2> points = found != nullptr ? found->positions() : design_->shape->rest_positions();
	return double(length(points[spring->b] - points[spring->a]));
}

double SoftBody2D::get_spring_strain(int p_index) const {
	const double rest_length = get_spring_rest_length(p_index);
	return rest_length > 0 ? get_spring_length(p_index) / rest_length - 1 : 0.0;
}

void SoftBody2D::set_scale_of_spring(const StringName &p_property, PackedFloat32Array &r_scales, int p_index, double p_scale, bool p_may_be_zero) {
	if (find_spring(p_index) == nullptr) {
		return;
	}
	PackedFloat32Array scales = r_scales;
	if (scales.size() != get_spring_count()) {
		scales.resize(get_spring_count());
		scales.fill(1);
	}
	scales.set(p_index, float(p_scale));
	change_structure(p_property, r_scales, scales, check_scales(std::string(String(p_property).utf8().get_data()), scales, p_may_be_zero));
}

void SoftBody2D::set_spring_stiffness_scale(int p_index, double p_scale) {
	set_scale_of_spring("spring_stiffness_scales", spring_stiffness_scales_, p_index, p_scale, true);
}

void SoftBody2D::set_spring_damping_scale(int p_index, double p_scale) {
	set_scale_of_spring("spring_damping_scales", spring_damping_scales_, p_index, p_scale, true);
}

void SoftBody2D::set_spring_length_scale(int p_index, double p_scale) {
	set_scale_of_spring("spring_length_scales", spring_length_scales_, p_index, p_scale, false);
}

void SoftBody2D::bind_polygon() {
	ClassDB::bind_method(D_METHOD("set_polygon", "polygon"), &SoftBody2D::set_polygon);
	ClassDB::bind_method(D_METHOD("get_polygon"), &SoftBody2D::get_polygon);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("get_polygon_problem", "polygon"), &SoftBody2D::get_polygon_problem);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_circle_polygon", "radius", "point_count"), &SoftBody2D::make_circle_polygon);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_box_polygon", "size", "spacing"), &SoftBody2D::make_box_polygon);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_capsule_polygon", "radius", "height", "spacing"), &SoftBody2D::make_capsule_polygon);
}

void SoftBody2D::bind_structure() {
	ClassDB::bind_method(D_METHOD("set_center_point", "center_point"), &SoftBody2D::set_center_point);
	ClassDB::bind_method(D_METHOD("has_center_point"), &SoftBody2D::has_center_point);
	ClassDB::bind_method(D_METHOD("set_inner_points", "points"), &SoftBody2D::set_inner_points);
	ClassDB::bind_method(D_METHOD("get_inner_points"), &SoftBody2D::get_inner_points);
}

void SoftBody2D::bind_springs() {
	ClassDB::bind_method(D_METHOD("set_springs", "springs"), &SoftBody2D::set_springs);
	ClassDB::bind_method(D_METHOD("get_springs"), &SoftBody2D::get_springs);
	ClassDB::bind_method(D_METHOD("set_spring_stiffness_scales", "scales"), &SoftBody2D::set_spring_stiffness_scales);
	ClassDB::bind_method(D_METHOD("get_spring_stiffness_scales"), &SoftBody2D::get_spring_stiffness_scales);
	ClassDB::bind_method(D_METHOD("set_spring_damping_scales", "scales"), &SoftBody2D::set_spring_damping_scales);
	ClassDB::bind_method(D_METHOD("get_spring_damping_scales"), &SoftBody2D::get_spring_damping_scales);
	ClassDB::bind_method(D_METHOD("set_spring_length_scales", "scales"), &SoftBody2D::set_spring_length_scales);
	ClassDB::bind_method(D_METHOD("get_spring_length_scales"), &SoftBody2D::get_spring_length_scales);
	ClassDB::bind_method(D_METHOD("get_spring_count"), &SoftBody2D::get_spring_count);
	ClassDB::bind_method(D_METHOD("get_spring_points", "index"), &SoftBody2D::get_spring_points);
	ClassDB::bind_method(D_METHOD("get_all_springs"), &SoftBody2D::get_all_springs);
	ClassDB::bind_method(D_METHOD("get_spring_stiffness", "index"), &SoftBody2D::get_spring_stiffness);
	ClassDB::bind_method(D_METHOD("get_spring_damping", "index"), &SoftBody2D::get_spring_damping);
	ClassDB::bind_method(D_METHOD("get_spring_rest_length", "index"), &SoftBody2D::get_spring_rest_length);
	ClassDB::bind_method(D_METHOD("get_spring_length", "index"), &SoftBody2D::get_spring_length);
	ClassDB::bind_method(D_METHOD("get_spring_strain", "index"), &SoftBody2D::get_spring_strain);
	ClassDB::bind_method(D_METHOD("set_spring_stiffness_scale", "index", "scale"), &SoftBody2D::set_spring_stiffness_scale);
	ClassDB::bind_method(D_METHOD("set_spring_damping_scale", "index", "scale"), &SoftBody2D::set_spring_damping_scale);
	ClassDB::bind_method(D_METHOD("set_spring_length_scale", "index", "scale"), &SoftBody2D::set_spring_length_scale);
}

} // namespace godot
