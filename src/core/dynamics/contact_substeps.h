// SPDX-License-Identifier: MIT
// Who takes contact substeps in a step, and how many.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/island_substeps.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// What bodies have to do with one another, and with rigid bodies that they push back.
struct Couplings {
	std::span<const BodyPair> pairs; ///< who may touch
	std::span<const BodyPair> joined;
	/// Rows near a dynamic rigid body, or joined to one, frozen ones too. These are one island: rigid bodies move in the
	/// same substeps for all.
	std::span<const std::uint32_t> beside_dynamic;
};

/// A point that moves through several force substeps between two looks at its contacts trembles: each body gets as many looks
/// as it has force substeps, up to a bound (MAX_CONTACT_SUBSTEPS) that keeps one very stiff body from slowing its whole island.
class ContactSubsteps {
public:
	/// Chooses for the `coupled` bodies: at least `least` for each. O(coupled bodies), and where they do not all take the same
	/// number O(bodies + couplings).
	void choose(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled, const Couplings &couplings, int least);
	/// Of the bodies by active index.
	const IslandSubsteps &island_substeps() const { return island_substeps_; }
	/// In how many the dynamic rigid bodies move; 0: nobody is near.
	int of_rigid_bodies() const { return of_rigid_bodies_; }

private:
	IslandSubsteps island_substeps_;
	int of_rigid_bodies_ = 0;
};

} // namespace softbody
