// SPDX-License-Identifier: MIT
// An elastic material, and the terms of the model that represent it.
#pragma once

#include "core/base/error.h"
#include "core/model/body_settings.h"
#include "core/model/soft_body_shape.h"

#include <cstdint>

namespace softbody {

/// Material of a body: a homogeneous, isotropic solid in plane strain with viscous damping. No value contains a length:
/// equal values mean the same in meters and in pixels, for any outline and any number of points.
struct Material {
	/// Young's modulus E in two dimensions [force/length], > 0: force over thickness and strain. A square pressed from
	/// two sides by a force F loses about F/E of its side.
	Real youngs_modulus = 300;
	/// Poisson's ratio ν [1], 0..MOST_POISSON_RATIO: 0 does not bulge when pressed, 0.45 keeps most of its area, like jelly.
	Real poisson_ratio = Real(0.45);
	/// Damping ratio ζ of the lowest mode [1], >= 0: a wobble loses the share exp(-2πζ) of its height in a period.
	Real damping_ratio = Real(0.15);

	Real shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); } ///< μ [force/length]
	/// K = λ + μ [force/length]
	Real bulk_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio) * (1 - 2 * poisson_ratio)); }

	friend bool operator==(const Material &, const Material &) = default;
};

/// Refuses the first value outside its range, by name.
Status check_material(const Material &material);

/// The terms of the model that represent a material, from cheap to expensive.
enum class ElasticModel : std::uint8_t {
	SPRINGS, ///< the thesis's springs: ν is always 1/3
	SPRINGS_AND_SHAPE, ///< springs with shape matching of DEFAULT_SHAPE_MATCHING: ν is about 0.2
	SPRINGS_SHAPE_AND_AREA, ///< with the area term, which gives the material's ν
	MODES, ///< elastic modes with the area term: E and ν of the material, and the solid's lowest frequency
	TRIANGLES, ///< finite elements: E and ν of the material, also at large deformation
};
inline constexpr int ELASTIC_MODEL_COUNT = 5;

/// Sets the coefficients of the model's terms in `settings`, so that the body resists uniform strain, averaged over its
/// directions, like the material, as far as the model can. Springs and shape matching take up the shear modulus, the
/// area term the rest of the bulk modulus; elastic modes and triangles have both. Triangles whose damping would take
/// too many substeps get a part of it by `shape_damping`, with an equal ratio for the lowest mode. Other terms are
/// switched off; pressure is unchanged. Refuses a bad material, MODES for a shape without modes, TRIANGLES for one
/// without triangles, and springs for a shape without springs of stiffness > 0. O(springs).
Status apply_material(const Material &material, ElasticModel model, const SoftBodyShape &shape, BodySettings &settings);

/// Raw values of a body that is built as a spring network, and named as its values are refused.
struct SpringNetwork {
	double stiffness = 100; ///< of each spring [force/length]
	double damping = 0; ///< of each spring [force·s/length]
	double shape_matching = 0; ///< stiffness of shape matching, as a share of that of the springs [1]
	double shape_damping_ratio = 0; ///< of the pull towards the rest shape [1]
};

/// Sets the coefficients of springs and shape matching in `settings`, for a shape of this mass whose springs have stiffness
/// and damping 1. Other terms are left alone. Refuses what `check_spring_rates` refuses.
Status apply_network(const SpringNetwork &network, double mass, const SoftBodyShape &shape, BodySettings &settings);
/// Refuses, as "stiffness" or "damping", what is fine by itself: rates of springs that leave the range of numbers.
Status check_spring_rates(const BodySettings &settings, const SoftBodyShape &shape);

/// Shear modulus of the shape's springs under uniform strain, averaged over its directions: sum k l² / (8 A)
/// [force/length]. Their bulk modulus is twice that, as in every network of central forces (Cauchy's relation).
double spring_shear_modulus(const SoftBodyShape &shape);

/// How much softer the shape's lowest mode is than that of a disk, at Poisson's ratio 0.45 [1], >= 1: for shapes with holes, whose walls
/// would not carry their weight as a solid does. 1 for shapes without elastic modes or triangles.
double softness_by_holes(const SoftBodyShape &shape);

} // namespace softbody
