// SPDX-License-Identifier: MIT
// Context shared by the parts of a step.
#pragma once

#include "core/collision/collider_index.h"
#include "core/dynamics/active_bodies.h"
#include "core/model/world_data.h"

namespace softbody {

class JointSolver;

/// The world during one step. All members must outlive the step.
struct StepContext {
	WorldData &world;
	const ColliderIndex &colliders;
	ActiveBodies &bodies;
	JointSolver &joints; ///< of which bodies read what is fastened to them
	bool has_forces = false; ///< whether any body may have external forces or an acceleration of its own
	bool borders_bounce = false; ///< whether any border has restitution
	bool pairs_bounce = false; ///< whether bodies may bounce off one another
};

/// One of `parts` equal slices of a step. Each body takes its share of its substeps in a slice.
struct TimeSlice {
	Real elapsed = 0; ///< since the step began [s]
	Real duration = 0; ///< [s]
	int parts = 1;
	/// Whether other bodies push the bodies of the slice afterwards. Contacts of a body with itself then wait.
	bool is_coupled = false;

	int substeps_of(const SubstepPlan &plan) const { return substeps_in_slice(plan, parts); }
};

} // namespace softbody
