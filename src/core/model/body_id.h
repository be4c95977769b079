// SPDX-License-Identifier: MIT
// The id of a body.
#pragma once

#include <compare>
#include <cstdint>

namespace softbody {

/// Refers to a body as long as it lives. After its removal the id refers to nothing, even when its place is used again.
struct BodyId {
	std::uint32_t index = UINT32_MAX;
	std::uint32_t generation = 0;
	friend auto operator<=>(BodyId a, BodyId b) = default;
};

} // namespace softbody
