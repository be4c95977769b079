// SPDX-License-Identifier: MIT
// Entry points of the extension.
#pragma once

#include <godot_cpp/core/class_db.hpp>

void initialize_soft_body_2d_module(godot::ModuleInitializationLevel p_level);
void uninitialize_soft_body_2d_module(godot::ModuleInitializationLevel p_level);
