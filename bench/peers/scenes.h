// SPDX-License-Identifier: MIT
// Piles as games have them.
#pragma once

#include "../pile_scene.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace bench {

/// Equal bodies; each body of its own stiffness; equal ones that bounce a little; every fifth a rigid disk.
inline constexpr std::array<std::string_view, 4> PILE_KINDS = { "equal", "mixed", "bounce", "rigid" };

/// A pile of one of these kinds, ten bodies high.
PileScene pile_of(std::string_view kind, std::size_t bodies);

} // namespace bench
