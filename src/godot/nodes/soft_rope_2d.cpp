// SPDX-License-Identifier: MIT
// The node: a rope, strap or tentacle.
#include "godot/nodes/soft_rope_2d.h"

#include "core/creator/rope_creator.h"
#include "godot/convert.h"
#include "godot/resources/property_binding.h"

#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>

#include <algorithm>
#include <array>
#include <utility>

using softbody::RopePart;

namespace godot {

namespace {

struct KindValues {
	double stretch_stiffness;
	double bend_stiffness;
	double damping;
	double rest_bend;
};

// In the order of `Kind`, without the first. A new rope is 2 m long, 12 px wide, and weighs 0.3 kg.
constexpr std::array<KindValues, 4> KINDS = { {
		{ 0, 0, 0.02, 0 }, // rope
		{ 0, 0.1, 0.05, 0 }, // strap: keeps bends as wide as a hand
		{ 0, 3, 0.1, 1 }, // tentacle: stands out by itself, and bends back to how it was drawn
		{ 20, 0, 0.03, 0 }, // rubber band: a kilogram stretches it by half
} };

KindValues values_of(const RopePart &p_rope) {
	return { p_rope.stretch_stiffness, p_rope.bend_stiffness, p_rope.damping, p_rope.rest_bend };
}

bool is_same(const KindValues &p_a, const KindValues &p_b) {
	return p_a.stretch_stiffness == p_b.stretch_stiffness && p_a.bend_stiffness == p_b.bend_stiffness && p_a.damping == p_b.damping && p_a.rest_bend == p_b.rest_bend;
}

// Properties of SoftBody2D that make the shape of other bodies. A rope has none of them, or they follow from its own.
const char *const OTHER_PROPERTIES[] = { "soft_body_material", "preset", "polygon", "youngs_modulus", "poisson_ratio", "damping_ratio",
	"rolling_resistance", "inflation", "firm_for_weight", "elastic_model", "holes", "detail_mode", "detail_tolerance", "detail_point_count", "detail_weights", "center_point",
	"stiffness", "damping", "shape_matching", "shape_damping_ratio", "pressure", "network_values_set", "least_area", "least_stretch",
	"most_stretch", "yield_strain", "flow_rate", "max_dent", "dent_by", "tear_stretch", "smallest_piece", "integrator", "inner_points",
	"springs", "spring_stiffness_scales", "spring_damping_scales", "spring_length_scales", "dents", "uv", "cut_edges", "cut_width",
	"cut_color", "cut_texture", "pinned_points", "pin_targets" };

} // namespace

SoftRope2D::SoftRope2D() {
	rope_.path.push_back(Vector2());
	rope_.path.push_back(Vector2(0, 200));
	structure_.exchange_all(rope_.structure().value());
	update_topology();
	set_texture_repeat(TEXTURE_REPEAT_ENABLED); // for textures that lie along it
}

SoftRope2D::~SoftRope2D() {
	if (rope_.width_curve.is_valid()) {
		rope_.width_curve->disconnect("changed", own_callable("_remake_for_curve"));
	}
}

String SoftRope2D::describe() const {
	return SoftBody2D::describe().replace("SoftBody2D", "SoftRope2D");
}

bool SoftRope2D::remake(const StringName &p_property, const RopePart &p_before) {
	const auto made = rope_.structure();
	if (!accept(p_property, made ? softbody::Status() : softbody::Status(made.error()))) {
		rope_ = p_before;
		return false;
	}
	const softbody::BodyStructure::Values old = structure_.values();
	structure_.exchange_all(made.value());
	if (!take_over_structure(p_property, true)) {
		structure_.exchange_all(old);
		rope_ = p_before;
		return false;
	}
	pin_ends();
	skin_.change_style();
	remake_skin();
	return true;
}

void SoftRope2D::set_path(const PackedVector2Array &p_path) {
	const RopePart before = rope_;
	rope_.path = p_path;
	remake("path", before);
}

String SoftRope2D::get_path_problem(const PackedVector2Array &p_path) const {
	RopePart tried = rope_;
	tried.path = p_path;
	const auto made = tried.structure();
	return made ? String() : softbody::to_godot(made.error());
}

void SoftRope2D::set_link_count(int p_count) {
	if (accept("link_count", softbody::check_between("link_count", p_count, 0, softbody::MAX_ROPE_POINTS - 1, ""))) {
		const RopePart before = rope_;
		rope_.link_count = p_count;
		remake("link_count", before);
	}
}

void SoftRope2D::set_width(double p_width) {
	if (accept("width", softbody::check_at_least("width", p_width, RopePart::LEAST_WIDTH, "px"))) {
		const RopePart before = rope_;
		rope_.width = p_width;
		remake("width", before);
	}
}

void SoftRope2D::set_width_curve(const Ref<Curve> &p_curve) {
	if (p_curve == rope_.width_curve) {
		return;
	}
	const Callable changed = own_callable("_remake_for_curve");
	const RopePart before = rope_;
	rope_.width_curve = p_curve;
	if (!remake("width_curve", before)) {
		return;
	}
	if (before.width_curve.is_valid()) {
		before.width_curve->disconnect("changed", changed);
	}
	if (p_curve.is_valid()) {
		p_curve->connect("changed", changed);
	}
}

void SoftRope2D::remake_for_curve() {
	remake("width_curve", rope_);
}

template <double RopePart::*VALUE>
void SoftRope2D::set_rope_value(double p_value) {
	struct Rule {
		const char *name;
		double most;
		const char *unit;
	};
	constexpr double FAR = 1e12;
	const Rule rule = VALUE == &RopePart::stretch_stiffness ? Rule{ "stretch_stiffness", FAR, "N" }
			: VALUE == &RopePart::bend_stiffness ? Rule{ "bend_stiffness", FAR, "N·m²" }
			: VALUE == &RopePart::rest_bend ? Rule{ "rest_bend", 1, "" }
											: Rule{ "bend_damping", 1e6, "s" };
	if (!accept(rule.name, softbody::check_between(rule.name, p_value, 0, rule.most, rule.unit))) {
		return;
	}
	rope_.*VALUE = p_value;
	apply_settings();
}

void SoftRope2D::set_kind(Kind p_kind) {
	if (!accept("kind", softbody::check_between("kind", p_kind, KIND_CUSTOM, KIND_RUBBER_BAND, "")) || p_kind == KIND_CUSTOM) {
		return; // as it is
	}
	const KindValues &values = KINDS[std::size_t(p_kind) - 1];
	rope_.stretch_stiffness = values.stretch_stiffness;
	rope_.bend_stiffness = values.bend_stiffness;
	rope_.damping = values.damping;
	rope_.rest_bend = values.rest_bend;
	apply_settings();
	notify_property_list_changed();
}

SoftRope2D::Kind SoftRope2D::get_kind() const {
	const auto found = std::ranges::find_if(KINDS, [&](const KindValues &p_values) { return is_same(p_values, values_of(rope_)); });
	return found != KINDS.end() ? Kind(found - KINDS.begin() + 1) : KIND_CUSTOM;
}

void SoftRope2D::pin_ends() {
	PackedInt32Array points;
	if (pin_start_) {
		points.push_back(get_center_point(0));
	}
	if (pin_end_) {
		points.push_back(get_center_point(get_center_count() - 1));
	}
	set_pinned_points(points);
}

void SoftRope2D::set_pin_start(bool p_pinned) {
	if (p_pinned != pin_start_) {
		pin_start_ = p_pinned;
		set_point_pinned(get_center_point(0), p_pinned, NodePath());
	}
}

void SoftRope2D::set_pin_end(bool p_pinned) {
	if (p_pinned != pin_end_) {
		pin_end_ = p_pinned;
		set_point_pinned(get_center_point(get_center_count() - 1), p_pinned, NodePath());
	}
}

int SoftRope2D::get_center_point(int p_index) const {
	const int count = get_center_count();
	ERR_FAIL_COND_V_MSG(p_index < 0 || p_index >= count, -1, describe() + ": center index " + itos(p_index) + " must be at least 0 and below " + itos(count) + ".");
	return 2 * count + p_index;
}

PackedVector2Array SoftRope2D::get_center_positions() const {
	const int count = get_center_count();
	return get_point_positions().slice(2 * count, 3 * count);
}

double SoftRope2D::get_length() const {
	const PackedVector2Array places = get_center_positions();
	double sum = 0;
	for (int64_t i = 1; i < places.size(); i++) {
		sum += double(places[i].distance_to(places[i - 1]));
	}
	return sum;
}

double SoftRope2D::get_rest_length() const {
	const Design *found = design();
	return found != nullptr && found->shape->chain() != nullptr ? double(found->shape->chain()->total_length()) : 0.0;
}

void SoftRope2D::_validate_property(PropertyInfo &p_property) const {
	if (std::ranges::any_of(OTHER_PROPERTIES, [&](const char *p_name) { return p_property.name == StringName(p_name); })) {
		p_property.usage = PROPERTY_USAGE_NONE;
	}
}

void SoftRope2D::_bind_methods() {
	using softbody::bind_property;
	softbody::bind_enumeration<SoftRope2D>("Kind", { "KIND_CUSTOM", "KIND_ROPE", "KIND_STRAP", "KIND_TENTACLE", "KIND_RUBBER_BAND" });
	bind_property("kind", &SoftRope2D::set_kind, &SoftRope2D::get_kind, PROPERTY_HINT_ENUM, "Custom,Rope,Strap,Tentacle,Rubber Band", nullptr, nullptr, PROPERTY_USAGE_EDITOR);
	bind_property("path", &SoftRope2D::set_path, &SoftRope2D::get_path_points, PROPERTY_HINT_NONE, "suffix:px", "get_path_points");
	bind_property("link_count", &SoftRope2D::set_link_count, &SoftRope2D::get_link_count, PROPERTY_HINT_RANGE, "0,128,1,or_greater", "get_link_count");
	bind_property("width", &SoftRope2D::set_width, &SoftRope2D::get_width, PROPERTY_HINT_RANGE, "1,128,0.1,or_greater,suffix:px");
	bind_property("width_curve", &SoftRope2D::set_width_curve, &SoftRope2D::get_width_curve, PROPERTY_HINT_RESOURCE_TYPE, "Curve");
	bind_property("stretch_stiffness", &SoftRope2D::set_rope_value<&RopePart::stretch_stiffness>, &SoftRope2D::get_rope_value<&RopePart::stretch_stiffness>, PROPERTY_HINT_RANGE, "0,1000,0.1,or_greater,suffix:N");
	bind_property("bend_stiffness", &SoftRope2D::set_rope_value<&RopePart::bend_stiffness>, &SoftRope2D::get_rope_value<&RopePart::bend_stiffness>, PROPERTY_HINT_RANGE, "0,100,0.001,or_greater,exp,suffix:N·m²");
	bind_property("bend_damping", &SoftRope2D::set_rope_value<&RopePart::damping>, &SoftRope2D::get_rope_value<&RopePart::damping>, PROPERTY_HINT_RANGE, "0,1,0.001,or_greater,suffix:s");
	bind_property("rest_bend", &SoftRope2D::set_rope_value<&RopePart::rest_bend>, &SoftRope2D::get_rope_value<&RopePart::rest_bend>, PROPERTY_HINT_RANGE, "0,1,0.01");
	bind_property("pin_start", &SoftRope2D::set_pin_start, &SoftRope2D::is_pin_start, PROPERTY_HINT_NONE, "", "is_pin_start");
	bind_property("pin_end", &SoftRope2D::set_pin_end, &SoftRope2D::is_pin_end, PROPERTY_HINT_NONE, "", "is_pin_end");
	ClassDB::bind_method(D_METHOD("get_center_count"), &SoftRope2D::get_center_count);
	ClassDB::bind_method(D_METHOD("get_center_point", "index"), &SoftRope2D::get_center_point);
	ClassDB::bind_method(D_METHOD("get_center_positions"), &SoftRope2D::get_center_positions);
	ClassDB::bind_method(D_METHOD("get_length"), &SoftRope2D::get_length);
	ClassDB::bind_method(D_METHOD("get_path_problem", "path"), &SoftRope2D::get_path_problem);
	ClassDB::bind_method(D_METHOD("get_rest_length"), &SoftRope2D::get_rest_length);
	ClassDB::bind_method(D_METHOD("_remake_for_curve"), &SoftRope2D::remake_for_curve);
}

} // namespace godot
