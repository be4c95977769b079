// SPDX-License-Identifier: MIT
// Who takes contact substeps in a step, and how many.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/island_substeps.h"

#include <cstdint>
#include <optional>
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
	/// Chooses for the bodies of `coupled` batches (BatchState::coupled), at least `least` for each that is coupled. Whoever is in no
	/// island, and goes with none, is left out: its batch is added to `free`. O(bodies of the batches), and where they do not all take
	/// the same number O(bodies + couplings).
	void choose(ActiveBodies &bodies, std::span<const std::uint32_t> coupled, const Couplings &couplings, int least,
			std::vector<std::uint32_t> &free);
	/// Of the bodies by active index.
	const IslandSubsteps &island_substeps() const { return island_substeps_; }
	/// In how many the dynamic rigid bodies move; 0: nobody is near.
	int of_rigid_bodies() const { return of_rigid_bodies_; }

private:
	std::optional<int> common_need(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled, int least) const;
	void find_islands(const ActiveBodies &bodies, std::span<const std::uint32_t> coupled, const Couplings &couplings, int least);
	void leave_free(ActiveBodies &bodies, std::uint32_t batch);

	IslandSubsteps island_substeps_;
	int of_rigid_bodies_ = 0;
};

} // namespace softbody
