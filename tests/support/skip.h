// SPDX-License-Identifier: MIT
// Test cases that cannot be done everywhere.
#pragma once

#include "core/base/real.h"

#include <doctest/doctest.h>

/// Leaves a test case out of the program in double precision, where what it tests does not exist.
#define SINGLE_PRECISION_ONLY doctest::skip(sizeof(softbody::Real) != sizeof(float))

/// Ends a test case that has nothing to compare on this machine, and says why. It counts as skipped: scripts/test.sh looks for the
/// message, as doctest itself has no such result. Stands before the first claim of a test case, outside of its functions and
/// subcases.
#define SKIP_TEST(reason)            \
	do {                             \
		MESSAGE("skipped: " reason); \
		return;                      \
	} while (false)
