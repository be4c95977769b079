// SPDX-License-Identifier: MIT
// The test program of the core: doctest's own main.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
