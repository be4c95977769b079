// SPDX-License-Identifier: MIT
// Energy of a body, for tests and charts.
#pragma once

#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

/// Energies in [mass·length²/s²]. All are sums over points or springs, evaluated in double.
struct Energy {
	double kinetic = 0;
	double springs = 0; ///< sum of k (|d| - l)² / 2
	double pressure = 0; ///< k_p (A - s A0)² / (2 A0)
	double shape = 0; ///< sum of m k_s/mean(m) |x - goal|² / 2
	double modes = 0; ///< of the elastic modes, see `add_mode_forces`
	double area = 0; ///< K (A - s A0)² / (2 A0), for small changes: `hold_area` hardens
	double triangles = 0; ///< of the elastic triangles, see triangle_lanes.h
	double gravity = 0; ///< -sum of m g·x; 0 at the world's origin
	double total() const { return kinetic + springs + pressure + shape + modes + area + gravity + triangles; }
};

/// Energy of the body with these positions and velocities, one of each for every point. O(points + springs).
Energy measure_energy(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities, Vec2 gravity);
Energy measure_energy(const SoftBodyData &body, Vec2 gravity);

} // namespace softbody
