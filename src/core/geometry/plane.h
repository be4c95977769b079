// SPDX-License-Identifier: MIT
// Point against an infinite plane (a line in 2D): thesis Alg. 4.3 and 4.4 in their corrected form.
#pragma once

#include "core/base/vec2.h"

namespace softbody {

/// A directed line: points on the side to which the unit `normal` points are in front of it.
struct Plane {
	Vec2 position; ///< any point on the line [length]
	Vec2 normal{ 0, 1 }; ///< unit length
};

/// Distance from the plane [length]: positive in front, 0 on it, negative behind.
/// Source: thesis Alg. 4.3, corrected to dot(n, p - b).
constexpr Real signed_distance(const Plane &plane, Vec2 p) {
	return dot(plane.normal, p - plane.position);
}

/// The closest point of the plane, along the normal. Thesis Alg. 4.4 intersects along the velocity
/// instead, which throws a shallow, fast point far away.
constexpr Vec2 project(const Plane &plane, Vec2 p) {
	return p - plane.normal * signed_distance(plane, p);
}

} // namespace softbody
