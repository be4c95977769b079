// SPDX-License-Identifier: MIT
// Shares one shape among like bodies.
#pragma once

#include "core/base/error.h"
#include "core/creator/soft_body_creator.h"

#include <cstdint>
#include <memory>
#include <span>

namespace softbody {

/// `SoftBodyCreator::create_polygon` of the mass in `options`, enlarged by the factor `size`, or its earlier result for
/// these values while some body still holds it; or while it is among the last 64 built. The core steps bodies of one shape side by side, and a thousand nodes that
/// share a material need one shape when it changes. May be called from any thread. O(hull + springs) for a known shape, and
/// for another size or mass of a known elastic one.
Result<std::shared_ptr<const SoftBodyShape>> find_or_create_shape(std::span<const Vec2> hull, const StructureOptions &options,
		Real size = 1);
/// Number of shapes built, not found, since the extension was loaded.
std::int64_t built_shape_count();

/// Makes the shape of these options with a mass of 1, which takes long with elastic modes, on any thread and without keeping
/// others waiting. While the result is held, the cache makes shapes of other masses and sizes from it. Null if it was refused.
std::shared_ptr<const SoftBodyShape> prepare_shape(std::span<const Vec2> hull, StructureOptions options);

} // namespace softbody
