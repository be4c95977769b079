// SPDX-License-Identifier: MIT
// Where an open chain touches the environment, or is about to: for the chain's own solver.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/collider_index.h"
#include "core/collision/contact_log.h"
#include "core/model/soft_body_data.h"

#include <cstdint>
#include <vector>

namespace softbody {

/// A place of a chain near a surface. It lies between two neighboring sections, or in one.
struct ChainContact {
	std::uint32_t section = 0;
	std::uint32_t other = 0; ///< the neighbor, or the same section
	double share = 1; ///< of the first section in the place, 0..1
	Vec2d normal; ///< unit, from the surface to the chain
	Vec2d velocity; ///< of the surface [length/s]
	double gap = 0; ///< [length]; negative inside
	double friction = 0; ///< Coulomb's coefficient [1]
	ContactPoint source; ///< surface and place, for the log of contacts

	// How it is solved, see `ChainSolver`.
	bool presses = false;
	double slip = 0; ///< speed along the surface for which friction is linear [length/s], > 0
	double normal_impulse = 0; ///< on the chain [mass·length/s]
};

/// Finds where a chain is near borders and colliders that do not belong to dynamic bodies. One-way colliders are left out. It owns
/// scratch memory.
class ChainContactFinder {
public:
	/// Places that the surface could reach within `h` [s], `elapsed` [s] after the step began. O(hull points × near colliders).
	void find(const ColliderIndex &surroundings, const SoftBodyData &body, Real elapsed, Real h, std::vector<ChainContact> &contacts);

private:
	std::vector<std::uint32_t> colliders_;
};

} // namespace softbody
