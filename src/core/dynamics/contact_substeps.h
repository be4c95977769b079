// SPDX-License-Identifier: MIT
// Number of contact substeps for each body in a step.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/island_substeps.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Couplings of bodies with one another, and with dynamic rigid bodies.
struct Couplings {
	std::span<const BodyPair> pairs; ///< bodies that may touch
	std::span<const BodyPair> joined;
	/// Active indices of bodies near a dynamic rigid body, or joined to one, including frozen bodies. These form one
	/// island: dynamic rigid bodies all move in the same substeps.
	std::span<const std::uint32_t> beside_dynamic;
};

/// Chooses the number of contact substeps. A point that moves through several force substeps between two contact solves
/// trembles. So each body gets as many contact substeps as force substeps, up to MAX_CONTACT_SUBSTEPS, which keeps one
/// very stiff body from slowing its whole island.
class ContactSubsteps {
public:
	/// Chooses the number for the `coupled` bodies, at least `least` for each. O(coupled bodies), or O(bodies +
	/// couplings) if they do not all take one number.
	void choose(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled, const Couplings &couplings, int least);
	/// Number for each body, by active index.
	const IslandSubsteps &island_substeps() const { return island_substeps_; }
	/// Number of substeps in which the dynamic rigid bodies move; 0 if no soft body is near.
	int of_rigid_bodies() const { return of_rigid_bodies_; }

private:
	IslandSubsteps island_substeps_;
	int of_rigid_bodies_ = 0;
};

} // namespace softbody
