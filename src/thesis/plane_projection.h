// SPDX-License-Identifier: MIT
// Projection of a point on a plane: thesis Alg. 4.4 in its corrected form.
#pragma once

#include "core/geometry/plane.h"

namespace softbody {

/// The closest point of the plane, along the normal. Thesis Alg. 4.4 intersects along the velocity instead, which
/// throws a shallow, fast point far away.
constexpr Vec2 project(const Plane &plane, Vec2 p) {
	return p - plane.normal * signed_distance(plane, p);
}

} // namespace softbody
