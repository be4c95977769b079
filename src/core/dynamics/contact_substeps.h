// SPDX-License-Identifier: MIT
// Number of contact substeps for each body in a step.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/collision/substep_group.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/islands.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Bodies that may touch, or are joined, advance in common substeps: the largest number that one of them needs. A body
/// in another island takes no more than its own island needs, so its motion does not depend on other islands. Bodies
/// are indexed by active index.
class IslandSubsteps {
public:
	/// All bodies take `count` (1..65535) substeps; islands are not needed. O(1).
	void set_common(int count);

	/// Begins with `count` bodies, each alone and without a need. O(count).
	void begin(std::uint32_t count);
	/// Puts two bodies into one island.
	void join(std::uint32_t a, std::uint32_t b) { islands_.join(a, b); }
	/// Sets that a body needs at least `count` (1..65535) substeps. Call it after all `join`.
	void need(std::uint32_t active_index, int count);
	/// Gives every body that has a need the largest need of its island. O(count).
	void finish();

	/// The different numbers of substeps, ascending.
	std::span<const int> counts() const { return counts_; }
	/// Number of substeps of the body; 0 for a body without a need. With a common number, that number.
	int of(std::uint32_t active_index) const { return of_active_.empty() ? counts_[0] : of_active_[active_index]; }
	/// The bodies that take `count` substeps.
	SubstepGroup group(int count) const { return { of_active_, std::uint16_t(count) }; }

private:
	Islands islands_;
	std::vector<std::uint16_t> of_active_; ///< number for each body; empty with a common number
	std::vector<std::uint16_t> needs_; ///< of islands, by island name
	std::vector<std::uint32_t> needing_; ///< active indices of bodies with a need
	std::vector<int> counts_;
};

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
