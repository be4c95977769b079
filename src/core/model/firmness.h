// SPDX-License-Identifier: MIT
// How firm a body is made for its weight.
#pragma once

namespace softbody {

/// Weight over radius [force/length] up to which a material is as firm as its Young's modulus says. A disk of 1 kg and
/// 50 px under 980 px/s² has 19.6, and so has one of 0.5 m under 9.8 m/s². Larger: large and heavy bodies sag more.
/// Smaller: small bodies are firmer than their material.
inline constexpr double LIGHT_LOAD = 20;

/// Least E R / (m g) of a body that is kept firm [1]. A disk of 2 loses a sixth of its height, on its own, and
/// does not fold. Larger: soft materials look alike. Smaller: soft bodies in a pile are pressed to their limits.
inline constexpr double LEAST_FIRM_STRENGTH = 2;

/// Largest Young's modulus that a body is given for its weight [force/length]. Sums of moduli stay finite.
inline constexpr double MOST_FIRM_MODULUS = 1e30;

/// Weight of a body over the radius of a disk of its area [force/length]: what Young's modulus is compared with.
/// `area` [length²] > 0; of `gravity` [length/s²] the size counts.
double load_of(double mass, double gravity, double area);

/// What makes a body firm enough for its weight.
struct Firmness {
	/// Factor on Young's modulus [1], >= 1. Up to LIGHT_LOAD it is exactly 1, unless `is_least`.
	double factor = 1;
	/// Factor by which a load above LIGHT_LOAD multiplies every material alike [1], >= 1. A body of any size and weight
	/// then sags like a light one of that material.
	double for_load = 1;
	/// Whether the material is too soft even so, and LEAST_FIRM_STRENGTH decides instead of Young's modulus.
	bool is_least = false;
};

/// The firmness of a body with that load and Young's modulus [force/length], both > 0 or the load 0.
Firmness firmness_for(double load, double youngs_modulus);

} // namespace softbody
