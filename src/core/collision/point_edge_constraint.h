// SPDX-License-Identifier: MIT
// The constraint between a point and a hull edge, shared by contacts and joints.
#pragma once

#include "core/base/constants.h"
#include "core/base/vec2.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace softbody {

/// A place on a body's hull: a point (`a == b`, `t` 0), or a place on the edge from `a` to `b`.
struct HullPlace {
	std::size_t a = 0;
	std::size_t b = 0;
	Real t = 0; ///< share of b, 0..1
};

inline std::uint32_t nearest_point(const HullPlace &place) {
	return std::uint32_t(place.t < Real(0.5) ? place.a : place.b);
}

/// A place on a hull, ready for impulses. The ends of the edge share an impulse by how near they are to the place.
struct PointOnEdge {
	std::size_t a = 0;
	std::size_t b = 0;
	Real share_a = 1;
	Real share_b = 0;
	Real inverse_mass_a = 0; ///< share times inverse mass: velocity change of end a per impulse at the place [1/mass]
	Real inverse_mass_b = 0;
	Real inverse_mass = 0; ///< of the place [1/mass]; 0 if it is pinned

	PointOnEdge() = default;
	/// An impulse J at the place changes the velocities of the ends by J w_a (1-t) and J w_b t, and so that of the
	/// place by J w with w = w_a (1-t)² + w_b t². A change d at the place takes J = d / w. Beside a pinned or very
	/// heavy end b, w goes to 0 with the share s = 1-t of end a, which would move by d w_a s / w = d / s. With w at
	/// least L w_a it moves by at most d s / max(s², L) <= d / sqrt(L), where L is LEAST_EDGE_INVERSE_MASS. The rest of
	/// the change is left to the next substep. The bound matters only if the masses of the ends differ 24 times and
	/// more.
	PointOnEdge(const HullPlace &place, std::span<const Real> inverse_masses) :
			a(place.a), b(place.b), share_a(1 - place.t), share_b(place.t), inverse_mass_a(inverse_masses[a] * share_a),
			inverse_mass_b(inverse_masses[b] * share_b),
			inverse_mass(std::max(inverse_mass_a * share_a + inverse_mass_b * share_b,
					LEAST_EDGE_INVERSE_MASS * std::max(inverse_masses[a], inverse_masses[b]))) {}

	/// Position or velocity of the place, from those of the ends.
	Vec2 between(Vec2 at_a, Vec2 at_b) const { return at_a * share_a + at_b * share_b; }
	Vec2 of(std::span<const Vec2> points) const { return between(points[a], points[b]); }
	/// Changes the position or velocity of the place by `by`, through an impulse at the place. Exact if the place is a
	/// point.
	void change(std::span<Vec2> points, Vec2 by) const {
		points[a] += by * (inverse_mass_a / inverse_mass);
		points[b] += by * (inverse_mass_b / inverse_mass);
	}
	/// Adds the effect of an impulse at the place to positions or velocities.
	void push(std::span<Vec2> points, Vec2 impulse) const {
		points[a] += impulse * inverse_mass_a;
		points[b] += impulse * inverse_mass_b;
	}
};

inline Vec2 position_of(const HullPlace &place, std::span<const Vec2> positions) {
	return positions[place.a] * (1 - place.t) + positions[place.b] * place.t;
}

/// A hull point against a place on an edge, of another body or of the point's own body.
struct PointAgainstEdge {
	std::size_t point = 0;
	Real point_inverse_mass = 0;
	PointOnEdge edge;

	/// Inverse mass of the distance between point and edge [1/mass]: impulses J on the point and -J on the edge change
	/// its speed by J times this.
	Real inverse_mass() const { return point_inverse_mass + edge.inverse_mass; }
	/// Adds an impulse on the point and its opposite on the edge, so that linear and angular momentum stay.
	void part(std::span<Vec2> of_point, std::span<Vec2> of_edge, Vec2 impulse) const {
		of_point[point] += impulse * point_inverse_mass;
		of_edge[edge.a] -= impulse * edge.inverse_mass_a;
		of_edge[edge.b] -= impulse * edge.inverse_mass_b;
	}
};

/// The value nearest to `x` in -most..most. Argument order matters: NaN gives -most, which is 0 where nothing presses.
template <class T>
T within(T most, T x) {
	return greater(lesser(most, x), -most);
}

/// Rebound speed of a place with restitution that approached with `approach` [length/s]; 0 below the threshold.
template <class T>
T rebound_speed(T approach, Real restitution, Real threshold) {
	return select(approach > T(threshold), approach * T(restitution), T(0));
}

/// Changes that a contact makes at its place.
template <class T>
struct ContactChange {
	BasicVec2<T> position; ///< [length]
	BasicVec2<T> velocity; ///< [length/s]
};

/// Changes of a contact: `push` [length] and `normal_change` [length/s] along the normal, and friction along the
/// tangent. Friction takes what Coulomb's law allows, |Δv_t| <= friction |Δv_n|, together with the way slid in the
/// substep `h` [s], so that a body at rest on a slope does not creep. `relative` is the velocity of the place relative
/// to the other side.
template <class T>
ContactChange<T> contact_change(BasicVec2<T> relative, BasicVec2<T> normal, T push, T normal_change, Real friction, Real h) {
	const BasicVec2<T> tangent = perpendicular(normal);
	const BasicVec2<T> brake = tangent * within(T(friction) * normal_change, -dot(relative, tangent));
	return { normal * push + brake * T(h), normal * normal_change + brake };
}

/// Remembers the approach speed of a whole body [length/s], if it is above `threshold`. `Touch` has `touching`, `ended`, `missing`
/// and `approach`. While the body is slower than the threshold it forgets the speed over BOUNCE_MEMORY: a turning point passes within
/// a substep or two, and a body at rest stays slow. What it remembers falls to 0 below the threshold.
template <class Touch>
void remember_approach(Touch &touch, Real approach, Real threshold, Real h) {
	if (touch.ended) { // in this step: the touch goes on
		touch.ended = false;
		touch.missing = 0;
	} else if (!touch.touching) {
		touch.approach = 0;
		touch.missing = 0;
	} else if (std::abs(approach) <= threshold) {
		touch.approach *= std::max(Real(0), 1 - h / BOUNCE_MEMORY);
	}
	touch.approach = std::max(touch.approach, approach);
	touch.approach = touch.approach > threshold ? touch.approach : Real(0);
	touch.touching = true;
}

/// Ends a touch whose sides part with the speed `leaving` [length/s], and notes what is missing of the bounce. Between
/// two contacts of one touch, while they still approach, it does nothing.
template <class Touch>
void end_touch(Touch &touch, Real restitution, Real leaving, Real threshold) {
	if (!(leaving > 0)) {
		return;
	}
	const Real missing = restitution * touch.approach - leaving;
	touch.missing = touch.approach > threshold && missing > 0 ? missing : Real(0);
	touch.ended = true;
	touch.touching = false;
}

} // namespace softbody
