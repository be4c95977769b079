// SPDX-License-Identifier: MIT
// What the contact substeps of each island buy: the contact error that a step leaves.
#pragma once

#include "core/collision/pair_contacts.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/contact_substeps.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Bodies that touch one another or are joined, directly or through others, with the error of their contacts at the end
/// of a step. A body that touches no other is an island of its own.
struct IslandReport {
	BodyId first; ///< the first of its bodies in the order of the world, resting ones included
	std::uint32_t bodies = 0; ///< number of its bodies that the step has moved
	int contact_substeps = 0; ///< in which its contacts were solved; the force substeps of a body that meets no other
	Real overlap = 0; ///< of the deepest two bodies in each other (`measure_overlap`) [length]
	Real penetration = 0; ///< of its deepest body in borders and colliders (`measure_penetration`) [length]
	BodyId deepest; ///< the body with the largest of both; `first` if both are 0
};

/// Input of `report_islands`, by active index: the bodies of a step that has ended.
struct SteppedBodies {
	const WorldData &world;
	const ActiveBodies &bodies;
	std::span<const std::uint32_t> free; ///< those that meet no other body
	std::span<const std::uint32_t> coupled; ///< those that take contact substeps
	const IslandSubsteps &substeps; ///< of the coupled ones
	std::span<const BodyPair> pairs; ///< that may have touched
	std::span<const char> touched; ///< for each pair, whether it has
	std::span<const BodyPair> joined;
	std::span<const std::uint32_t> beside_dynamic; ///< these form one island, as in `Couplings`
};

/// Measures every island with a body that moved, in the order of their first bodies. O(bodies + points of touching pairs squared + points ×
/// colliders): for a display or a bench, more than a step itself may take.
std::vector<IslandReport> report_islands(const SteppedBodies &stepped);

} // namespace softbody
