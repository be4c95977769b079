// SPDX-License-Identifier: MIT
// What most tests include, for GCC, which reads it once for all of them (SConstruct). No file includes it: each names what it uses.
// Nothing of tests itself: some give the same names to things of their own.

#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <functional>
#include <string>
#include <vector>
