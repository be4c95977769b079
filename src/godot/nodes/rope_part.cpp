// SPDX-License-Identifier: MIT
// The values of a rope's node, and what they make of its body.
#include "godot/nodes/rope_part.h"

#include "core/base/constants.h"
#include "core/creator/rope_creator.h"
#include "godot/convert.h"

#include <algorithm>
#include <limits>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

// Lengths of the way from the first point to each.
std::vector<double> ways_of(std::span<const Vec2> p_points) {
	std::vector<double> ways{ 0 };
	for (std::size_t i = 1; i < p_points.size(); ++i) {
		ways.push_back(ways.back() + double(length(p_points[i] - p_points[i - 1])));
	}
	return ways;
}

} // namespace

Result<std::vector<Vec2>> RopePart::points() const {
	std::vector<Vec2> points = to_core(path);
	if (link_count == 0) {
		return points;
	}
	return divide_path(points, link_count + 1);
}

std::vector<Real> RopePart::widths(std::span<const Vec2> p_points) const {
	const std::vector<double> ways = ways_of(p_points);
	std::vector<Real> widths;
	for (const double way : ways) {
		const double share = ways.back() > 0 ? way / ways.back() : 0;
		const double factor = width_curve.is_valid() ? double(width_curve->sample_baked(real_t(share))) : 1.0;
		widths.push_back(Real(std::max(width * factor, LEAST_WIDTH)));
	}
	return widths;
}

Result<BodyStructure::Values> RopePart::structure() const {
	const auto centers = points();
	if (!centers) {
		return centers.error();
	}
	const auto outline = rope_outline(centers.value(), widths(centers.value()));
	if (!outline) {
		return outline.error();
	}
	BodyStructure::Values values;
	values.polygon = to_godot(outline.value());
	values.inner_points = to_godot(centers.value());
	values.center_point = false;
	return values;
}

Result<std::shared_ptr<const SoftBodyShape>> RopePart::make_shape(std::span<const Vec2> p_hull, std::span<const Vec2> p_centers, Real p_size, Real p_mass) {
	auto shape = create_rope_in(p_hull, p_centers, 1);
	return shape ? shape.value()->resized(p_size, p_mass) : shape;
}

void RopePart::apply(BodySettings &r_settings) const {
	constexpr double PIXELS = double(PIXELS_PER_METER); // a newton is a kilogram meter, and not pixel, per second squared
	r_settings.axial_stiffness = stretch_stiffness > 0 ? Real(stretch_stiffness * PIXELS) : std::numeric_limits<Real>::infinity();
	r_settings.bending_stiffness = Real(bend_stiffness * PIXELS * PIXELS * PIXELS);
	r_settings.chain_damping_time = Real(damping);
	r_settings.rest_bend = Real(rest_bend);
	const BodySettings defaults;
	r_settings.spring_stiffness_scale = r_settings.spring_damping_scale = 0;
	r_settings.shape_stiffness = r_settings.shape_damping = 0;
	r_settings.pressure_stiffness = r_settings.yield_strain = 0;
	r_settings.shear_modulus = r_settings.area_stiffness = 0;
	r_settings.least_area = defaults.least_area;
	r_settings.least_stretch = defaults.least_stretch;
	r_settings.most_stretch = defaults.most_stretch;
	r_settings.inflation = 1;
	r_settings.rolling_resistance = 0;
	r_settings.integrator = Integrator::AUTOMATIC;
}

PackedVector2Array RopePart::texture_coordinates(const Ref<Texture2D> &p_texture, const BodyStructure::Values &p_structure) const {
	PackedVector2Array places;
	if (p_texture.is_null()) {
		return places;
	}
	const std::vector<double> ways = ways_of(to_core(p_structure.inner_points));
	const int64_t count = p_structure.inner_points.size();
	const real_t height = real_t(p_texture->get_height());
	places.resize(p_structure.polygon.size());
	for (int64_t i = 0; i < count; i++) {
		const real_t along = real_t(ways[std::size_t(i)] / width) * height;
		places.set(i, Vector2(along, 0));
		places.set(2 * count - 1 - i, Vector2(along, height));
	}
	return places;
}

} // namespace softbody
