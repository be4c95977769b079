// SPDX-License-Identifier: MIT
// Holes of the node's body: for scripts, and what they take from its area.
#include "godot/nodes/soft_body_2d.h"

#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <cmath>
#include <span>
#include <string>
#include <vector>

using softbody::to_core;
using softbody::to_godot;
using softbody::Vec2;

namespace godot {

// Another body, which goes on as the old one was drawn.
void SoftBody2D::set_holes(const TypedArray<PackedVector2Array> &p_holes) {
	const softbody::Holes holes = to_core(p_holes);
	if (rope() != nullptr && !holes.empty()) {
		accept("holes", softbody::Error{ "holes", std::to_string(holes.size()), "must be none for a rope", "leave them out" });
		return;
	}
	if (holes == structure_.values().holes || !accept("holes", softbody::check_holes("holes", holes, to_core(get_polygon())))) {
		return;
	}
	const softbody::DrawnMotion before = drawn_motion();
	const softbody::Holes old = structure_.exchange<&softbody::BodyStructure::Values::holes>(holes);
	if (take_over_structure("holes", true)) {
		take_over_motion(before);
	} else {
		structure_.exchange<&softbody::BodyStructure::Values::holes>(old);
	}
}

String SoftBody2D::get_holes_problem(const TypedArray<PackedVector2Array> &p_holes, const PackedVector2Array &p_polygon) {
	const softbody::Status status = softbody::check_holes("holes", to_core(p_holes), to_core(p_polygon));
	return status ? to_godot(*status) : String();
}

TypedArray<PackedVector2Array> SoftBody2D::get_holes() const {
	return to_godot(structure_.values().holes);
}

TypedArray<PackedVector2Array> SoftBody2D::get_interpolated_holes(double p_fraction) const {
	const softbody::DrawnHoles *holes = structure_.holes();
	if (!check_fraction(p_fraction) || followed_body() == nullptr || space_ == nullptr || holes == nullptr) {
		return TypedArray<PackedVector2Array>();
	}
	const Transform2D frame = interpolation_.frame(known_transform_, p_fraction);
	TypedArray<PackedVector2Array> placed;
	for (const std::vector<Vec2> &hole : holes->follow(local_points(p_fraction), order())) {
		placed.push_back(frame.xform(to_godot(std::span<const Vec2>(hole))));
	}
	return placed;
}

// What is drawn of points in the node's frame: the outline, and then the holes wound against it.
std::span<const Vec2> SoftBody2D::with_holes(std::span<const Vec2> p_outline, std::span<const Vec2> p_points) const {
	static std::vector<Vec2> drawn;
	drawn.assign(p_outline.begin(), p_outline.end());
	structure_.holes()->append(p_points, order(), structure_.outline() == nullptr && polygon_reversed_, drawn);
	return drawn;
}

bool SoftBody2D::has_point(const Vector2 &p_global_position) const {
	const softbody::SoftBodyData *found = followed_body();
	if (found == nullptr || !softbody::point_in_polygon(to_core(p_global_position), found->hull())) {
		return false;
	}
	if (structure_.holes() == nullptr) {
		return true;
	}
	const Vector2 local = interpolation_.frame(known_transform_, 1).affine_inverse().xform(p_global_position);
	for (const std::vector<Vec2> &hole : structure_.holes()->follow(local_points(1), order())) {
		if (softbody::point_in_polygon(to_core(local), hole)) {
			return false;
		}
	}
	return true;
}

// Holes follow in the node's frame, where they were drawn.
double SoftBody2D::area_of_holes() const {
	return structure_.holes() != nullptr ? structure_.holes()->area(local_points(1), order()) * std::abs(double(built_scale_.determinant())) : 0.0;
}

double SoftBody2D::get_area() const {
	const softbody::SoftBodyData *found = followed_body();
	if (found == nullptr) {
		return get_rest_area();
	}
	return double(softbody::signed_area(found->hull())) - area_of_holes();
}

double SoftBody2D::get_rest_area() const {
	const softbody::SoftBodyData *found = followed_body();
	if (found == nullptr) {
		return softbody::area_moments(to_core(get_polygon()), structure_.holes_in_use()).area;
	}
	const double inside = double(found->shape().rest_area());
	if (structure_.holes() == nullptr) {
		return inside;
	}
	const Transform2D to_node = structure_.simulated_scale(built_scale_).affine_inverse();
	std::vector<Vec2> rest; // dented, it may be
	for (const Vec2 place : found->shape().rest_positions()) {
		rest.push_back(to_core(to_node.xform(to_godot(place))));
	}
	return inside - structure_.holes()->area(rest, order()) / std::abs(double(to_node.determinant()));
}

} // namespace godot
