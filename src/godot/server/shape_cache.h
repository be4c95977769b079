// SPDX-License-Identifier: MIT
// Bodies made alike share one shape.
#pragma once

#include "core/base/error.h"
#include "core/creator/soft_body_creator.h"

#include <cstdint>
#include <memory>
#include <span>

namespace softbody {

/// `SoftBodyCreator::create_polygon`, or what it returned for the same values while some body still holds that: the core
/// steps bodies of one shape side by side, and a thousand nodes that share a material need one shape when it changes. May
/// be called from any thread. O(hull + springs) where the shape is known.
Result<std::shared_ptr<const SoftBodyShape>> find_or_create_shape(std::span<const Vec2> hull, const StructureOptions &options);
/// How many shapes were built, not found, since the extension was loaded. One with elastic modes takes some milliseconds.
std::int64_t built_shape_count();

} // namespace softbody
