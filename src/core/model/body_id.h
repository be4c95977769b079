// SPDX-License-Identifier: MIT
// The name of a body.
#pragma once

#include <compare>
#include <cstdint>

namespace softbody {

/// Names a body for as long as it lives; after its removal the id refers to nothing, even when
/// the place is used again.
struct BodyId {
	std::uint32_t index = UINT32_MAX;
	std::uint32_t generation = 0;
	friend auto operator<=>(BodyId a, BodyId b) = default;
};

} // namespace softbody
