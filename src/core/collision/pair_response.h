// SPDX-License-Identifier: MIT
// What a contact of a hull point with another body's hull edge does to the three points.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/polygon.h"

#include <cstdint>
#include <span>

namespace softbody {

/// What contacts between bodies need of a body. A view that stays valid until bodies are rearranged.
struct TouchingBody {
	Aabb box; ///< of the hull, as `measure_extent` found it
	Vec2 centre; ///< of a circle around the hull
	Real radius = 0; ///< of that circle [length]
	std::span<Vec2> hull;
	std::span<Vec2> velocities; ///< of all points, the hull's first
	std::span<const Real> inverse_masses;
	Real friction = 0;
	Real restitution = 0;

	/// Measures box and circle. O(hull points).
	void measure_extent();
};

/// A hull point of one body inside another, ready to be answered.
struct PairContact {
	std::uint32_t point = 0; ///< of the first body
	std::uint32_t edge_start = 0; ///< hull points of the second body
	std::uint32_t edge_end = 0;
	Real t = 0; ///< place on the edge, 0..1
	Vec2 normal; ///< unit, out of the second body
	Real depth = 0; ///< [length], >= 0
};

/// Answers one contact between two bodies: moves point and edge apart along the normal, takes from their approach
/// what brought them so deep within this substep `h` [s], or returns it times the restitution if faster than
/// `bounce_threshold` [length/s], and takes from the sliding speed what Coulomb's law allows, with the way slid.
/// Moving apart gives no velocity: bodies that start inside one another part without a jump.
/// All changes are shared out by inverse mass, with impulses equal and opposite in one place, so that linear and
/// angular momentum stay. Friction: the smaller coefficient; restitution: the sum, at most 1 (as Godot combines them).
/// Moves at most `longest_push` [length] at once. Returns the normal impulse [mass·length/s]. O(1).
Real answer_pair_contact(TouchingBody &body, TouchingBody &other, const PairContact &contact, Real bounce_threshold,
		Real longest_push, Real h);

} // namespace softbody
