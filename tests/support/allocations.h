// SPDX-License-Identifier: MIT
// How much memory is taken, counted at the one place that all containers ask.
#pragma once

#include <cstddef>

namespace softbody::testing {

/// Bytes that `operator new` has handed out and not got back. Over-aligned objects are not counted.
std::size_t allocated_bytes();

} // namespace softbody::testing
