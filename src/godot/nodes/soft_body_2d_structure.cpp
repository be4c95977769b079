// SPDX-License-Identifier: MIT
// The shape of the node's body, made of its points and springs; what scripts can ask of springs; start shapes.
#include "godot/nodes/soft_body_2d.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "godot/convert.h"
#include "godot/nodes/rope_part.h"

#include <godot_cpp/core/error_macros.hpp>

#include <cmath>
#include <utility>
#include <vector>

using softbody::to_core;
using softbody::to_godot;

namespace godot {

namespace {

constexpr double DEFAULT_RADIUS = 50; // px
constexpr int DEFAULT_POINTS = 16;

PackedVector2Array polygon_or_error(const softbody::Result<std::vector<softbody::Vec2>> &p_polygon) {
	if (!p_polygon) {
		ERR_FAIL_V_MSG(PackedVector2Array(), "SoftBody2D: " + softbody::to_godot(p_polygon.error()) + ".");
	}
	return softbody::to_godot(p_polygon.value());
}

} // namespace

String SoftBody2D::get_polygon_problem(const PackedVector2Array &p_polygon) {
	const softbody::Status status = softbody::check_hull(softbody::to_core(p_polygon));
	return status ? softbody::to_godot(*status) : String();
}

PackedVector2Array SoftBody2D::make_circle_polygon(double p_radius, int p_point_count) {
	return polygon_or_error(softbody::circle_hull(softbody::Real(p_radius), p_point_count));
}

PackedVector2Array SoftBody2D::make_box_polygon(const Vector2 &p_size, double p_spacing) {
	return polygon_or_error(softbody::box_hull(softbody::to_core(p_size), softbody::Real(p_spacing)));
}

PackedVector2Array SoftBody2D::make_capsule_polygon(double p_radius, double p_height, double p_spacing) {
	return polygon_or_error(softbody::capsule_hull(softbody::Real(p_radius), softbody::Real(p_height), softbody::Real(p_spacing)));
}

PackedVector2Array SoftBody2D::make_default_polygon() {
	static const std::vector<softbody::Vec2> POINTS = softbody::circle_hull(softbody::Real(DEFAULT_RADIUS), DEFAULT_POINTS).value();
	return to_godot(POINTS);
}

// As the area of any other body is computed, so that the default body has the default mass to the bit.
double SoftBody2D::default_area() {
	static const double AREA = std::abs(double(softbody::signed_area(to_core(make_default_polygon()))));
	return AREA;
}

// From properties to the core.

bool SoftBody2D::take_over_structure(const StringName &p_property, bool p_has_other_points) {
	design_.reset();
	if (!accept_shape(p_property)) {
		return false;
	}
	if (p_has_other_points) {
		cuts_.clear();
		rebuild_body(true);
	} else {
		apply_shape();
	}
	update_configuration_warnings();
	return true;
}

softbody::SizedHull SoftBody2D::sized_hull(const Transform2D &p_transform) const {
	const softbody::SizedScale sized(structure_.simulated_scale(softbody::scale_and_skew(p_transform)));
	softbody::SizedHull made{ sized, to_core(sized.rest.xform(structure_.hull())) };
	const double area = softbody::signed_area(made.points) * double(sized.size) * double(sized.size);
	made.area = std::abs(area);
	made.is_reversed = area < 0;
	if (structure_.outline() != nullptr) { // the drawn area decides the mass, to the bit
		made.area = std::abs(double(softbody::signed_area(to_core(sized.rest.xform(get_polygon()))))) * double(sized.size) * double(sized.size);
	}
	for (const std::vector<softbody::Vec2> &hole : structure_.holes_in_use()) {
		made.area -= std::abs(double(softbody::signed_area(to_core(sized.rest.xform(to_godot(std::span<const softbody::Vec2>(hole))))))) * double(sized.size) * double(sized.size);
	}
	return made;
}

softbody::Result<SoftBody2D::Design> SoftBody2D::make_design(const Transform2D &p_transform, bool p_is_draft) const {
	const auto [sized, hull, area, is_reversed] = sized_hull(p_transform);
	Design made;
	made.scale = softbody::scale_and_skew(p_transform);
	made.area = area;
	made.mass = mass_of_area(made.area);
	made.is_reversed = is_reversed;
	made.wanted = choose_model();
	made.used = made.wanted;

	softbody::StructureOptions options = structure_.options(sized.rest);
	made.has_holes = !options.holes.empty();
	if (rope() != nullptr) {
		auto shape = softbody::RopePart::make_shape(hull, options.inner_points, sized.size, softbody::Real(made.mass));
		if (!shape) {
			return shape.error();
		}
		made.shape = shape.value();
		return made;
	}
	options.mass = softbody::Real(made.mass);
	options.elastic = !p_is_draft && made.used.model == ELASTIC_MODEL_MODES;
	options.elastic_triangles = !p_is_draft && made.used.model == ELASTIC_MODEL_TRIANGLES;
	for (;;) {
		auto shape = softbody::BodyStructure::make_shape(hull, sized.size, options, made.problems);
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
	const softbody::PointOrder order = structure_.order(design_->is_reversed);
	return Vector2i(order.mirror(int(spring->a)), order.mirror(int(spring->b)));
}

PackedInt32Array SoftBody2D::get_all_springs() const {
	PackedInt32Array all;
	if (const Design *found = design()) {
		all.resize(int64_t(2 * found->shape->springs().size()));
		int32_t *write = all.ptrw();
		const softbody::PointOrder order = structure_.order(found->is_reversed);
		for (const softbody::Spring2D &spring : found->shape->springs()) {
			*write++ = order.mirror(int(spring.a));
			*write++ = order.mirror(int(spring.b));
		}
	}
	return all;
}

// By which the stiffness and the damping of the shape's springs are multiplied. 0 where springs take no part.
std::pair<double, double> SoftBody2D::spring_scales() const {
	const auto settings = present_settings();
	return settings ? std::pair(double(settings->spring_stiffness_scale), double(settings->spring_damping_scale)) : std::pair(0.0, 0.0);
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

} // namespace godot
