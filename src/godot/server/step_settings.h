// SPDX-License-Identifier: MIT
// The project settings of soft bodies: physics/soft_body_2d/.
#pragma once

#include "core/base/constants.h"
#include "core/base/real.h"

namespace softbody {

/// Settings of all soft bodies of a project. Read when a World2D gets its first soft body, and again when they change.
struct StepSettings {
	int threads = 0; ///< for a step; 0: the machine's, see `StepThreads`
	int contact_substeps = MIN_CONTACT_SUBSTEPS; ///< see `WorldData::contact_substeps`
	int substeps = 0; ///< of bodies with 0 substeps; 0: automatic
	int most_tears = 8; ///< in a tick, of the bodies of a space; the others tear in the next ticks
	bool rigid_flight = false; ///< see `WorldData::has_rigid_flight`
	double budget_ms = 0; ///< of a step, see `StepBudget`; 0: none
	bool can_sleep = true; ///< whether any body may fall asleep
	bool has_physics_thread = false; ///< whether the engine steps its 2D physics on a thread of its own
	Real character_mass = 1; ///< of a CharacterBody2D on soft bodies [kg], >= 0; see `CharacterMotion`
};

/// Registers the settings with the engine and its editor, with their defaults and ranges.
void register_step_settings();
/// The present settings. A value out of its range is reported once and replaced by its default.
StepSettings read_step_settings();

} // namespace softbody
