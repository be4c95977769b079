// SPDX-License-Identifier: MIT
// The project settings of soft bodies: physics/soft_body_2d/.
#pragma once

#include "core/base/constants.h"

namespace softbody {

/// What holds for every soft body of a project. Read when a World2D gets its first soft body, and again when the settings
/// change.
struct StepSettings {
	int threads = 0; ///< that a step may use; 0: the machine's, see `StepThreads`
	int contact_substeps = MIN_CONTACT_SUBSTEPS; ///< see `WorldData::contact_substeps`
	int substeps = 0; ///< of bodies that leave theirs at 0; 0: automatic
	bool can_sleep = true; ///< whether any body may fall asleep
};

/// Makes the settings known to the engine and its editor, with their defaults and ranges.
void register_step_settings();
/// What they say now. A value out of its range is reported once and replaced by its default.
StepSettings read_step_settings();

} // namespace softbody
