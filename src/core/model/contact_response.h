// SPDX-License-Identifier: MIT
// Ways to keep soft bodies apart.
#pragma once

namespace softbody {

/// The response where two soft bodies overlap.
enum class ContactResponse {
	/// Points and edges are moved apart and lose their approach, with friction (see `solve_pair_contact`). The default.
	POSITION_BASED,
	/// The thesis's separation force, for comparison only (see `SeparationForce` and docs/accuracy.md).
	SEPARATION_FORCE,
};

} // namespace softbody
