// SPDX-License-Identifier: MIT
// What the parts of a step share.
#pragma once

#include "core/collision/collider_index.h"
#include "core/dynamics/active_bodies.h"
#include "core/model/world_data.h"

namespace softbody {

/// The world as one step sees it. All must outlive the step.
struct StepContext {
	WorldData &world;
	const ColliderIndex &colliders;
	ActiveBodies &bodies;
	bool has_forces = false; ///< whether any body may have external forces or an acceleration of its own
	bool borders_bounce = false; ///< whether any border has restitution
};

/// One of `parts` equal slices of a step; each body takes its share of its substeps in it.
struct TimeSlice {
	Real elapsed = 0; ///< since the step began [s]
	Real duration = 0; ///< [s]
	int parts = 1;
	/// Whether other bodies have yet to push the bodies of the slice: contacts of a body with itself then wait.
	bool is_coupled = false;

	int substeps_of(const SubstepPlan &plan) const { return (plan.substeps + parts - 1) / parts; }
};

} // namespace softbody
