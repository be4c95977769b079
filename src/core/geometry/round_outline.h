// SPDX-License-Identifier: MIT
// The round outline that the straight edges of a polygon stand for.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"

#include <span>
#include <vector>

namespace softbody {

/// Tangent of half the angle by which an outline turns from the edge vector `before` to `after`; negative inwards.
template <class T>
T half_turn(BasicVec2<T> before, BasicVec2<T> after) {
	return cross(before, after) / (sqrt(length_squared(before) * length_squared(after)) + dot(before, after));
}

/// How far a smooth outline through the corners of a polygon bulges out from the middle of each edge [length], edge i
/// from corner i to the next. An edge is round where both its corners turn outwards by at most MOST_ROUND_HALF_TURN
/// and both adjacent edges are about as long; its bulge is that of a circle's arc with the smaller turn. Other edges
/// are straight: 0. The outline has positive winding. O(corners).
std::vector<Real> edge_bulges(std::span<const Vec2> outline);

/// An edge from `a` to `b` with the adjacent corners of a deformed outline.
template <class T>
struct OutlineEdge {
	BasicVec2<T> before, a, b, after;
};

/// Present bulge of a round edge [length]: that of an arc with the smaller of its turns, between 0 where the outline is
/// pressed flat and the bulge `at_rest`.
template <class T>
T present_bulge(const OutlineEdge<T> &edge, Real at_rest) {
	const BasicVec2<T> chord = edge.b - edge.a;
	// tan(turn / 4) is tan(turn / 2) / 2 up to 2 % for round edges.
	const T turn = lesser(half_turn(edge.a - edge.before, chord), half_turn(chord, edge.after - edge.b));
	return lesser(T(at_rest), greater(sqrt(length_squared(chord)) * turn * T(Real(0.25)), T(0)));
}

/// Height of a round edge above its chord at the share `t` of its length [length]: a parabola. Its slope at the ends is
/// that of the arc up to the third power of the turn.
template <class T>
T height_of_bulge(T t, T bulge) {
	return T(4) * bulge * t * (T(1) - t);
}

/// Share of its length at which a round edge lies deepest behind a line. Its ends lie at the signed distances `at_a` and
/// `at_b` in front of the line [length]. Outside of 0..1 an end is deepest. `bulge` is > 0.
template <class T>
T deepest_share(T at_a, T at_b, T bulge) {
	return T(Real(0.5)) + (at_a - at_b) / (T(8) * bulge);
}

} // namespace softbody
