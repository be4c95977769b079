// SPDX-License-Identifier: MIT
// How soft bodies that touch one another are kept apart.
#pragma once

namespace softbody {

/// What happens where two soft bodies overlap.
enum class ContactResponse {
	/// Points and edges are moved apart and lose their approach, with friction (see `solve_pair_contact`). The default.
	POSITION_BASED,
	/// The thesis's separation force, for comparison only (see `SeparationForce`): it gains energy, lets fast bodies pass
	/// and brings no pile to rest.
	SEPARATION_FORCE,
};

} // namespace softbody
