// SPDX-License-Identifier: MIT
// The values of a rope's node, and what they make of its body.
#pragma once

#include "core/base/error.h"
#include "core/model/body_settings.h"
#include "core/model/soft_body_shape.h"
#include "godot/nodes/body_structure.h"

#include <godot_cpp/classes/curve.hpp>
#include <godot_cpp/classes/texture2d.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>

#include <memory>
#include <span>
#include <vector>

namespace softbody {

/// `doc_classes/SoftRope2D.xml` explains each value.
struct RopePart {
	/// Width below which no curve makes a rope [px].
	static constexpr double LEAST_WIDTH = 1;

	godot::PackedVector2Array path; ///< [px of the node]
	int link_count = 24; ///< of equal length; 0: the edges of the path
	double width = 12; ///< [px]
	godot::Ref<godot::Curve> width_curve; ///< factor on the width, over 0..1 of the length; null: 1
	double stretch_stiffness = 0; ///< [N]; 0: keeps its length
	double bend_stiffness = 0; ///< [N·m²]
	double damping = 0.02; ///< [s]
	double rest_bend = 0; ///< [1]

	/// The centerline.
	Result<std::vector<Vec2>> points() const;
	/// Outline and centerline as the polygon and the inner points of a body. Refuses what makes no rope, by the names of these values.
	Result<BodyStructure::Values> structure() const;
	/// The body of that outline, enlarged by the factor.
	static Result<std::shared_ptr<const SoftBodyShape>> make_shape(std::span<const Vec2> p_hull, std::span<const Vec2> p_centers, Real p_size, Real p_mass);
	/// Takes over stiffness and damping, and switches off what holds the shapes of other bodies.
	void apply(BodySettings &r_settings) const;
	/// Texture coordinates of the polygon [px of the texture]: the texture is as high as the rope is wide, and lies along it.
	godot::PackedVector2Array texture_coordinates(const godot::Ref<godot::Texture2D> &p_texture, const BodyStructure::Values &p_structure) const;

private:
	std::vector<Real> widths(std::span<const Vec2> p_points) const;
};

} // namespace softbody
