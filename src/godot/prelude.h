// SPDX-License-Identifier: MIT
// What most sources of the extension include, for GCC, which reads it once for all of them (SConstruct). No file includes it: each
// names what it uses.

#include "godot/convert.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/server/soft_body_simulation_2d.h"

#include <algorithm>
#include <cmath>
#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <utility>
#include <vector>
