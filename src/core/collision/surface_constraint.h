// SPDX-License-Identifier: MIT
// Solves a contact with an immovable surface.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/point_edge_constraint.h"
#include "core/model/body_lanes.h"
#include "core/model/soft_body_data.h"
#include "core/model/surroundings.h"

#include <cstdint>
#include <span>

namespace softbody {

/// A contact of a body with the environment, ready to be solved.
struct SurfaceContact {
	HullPlace place;
	Vec2 normal; ///< unit, from the surface into the body
	Real depth = 0; ///< [length], >= 0
};

/// Whether a body with these settings notices the surface, by layer. The body may still ignore its tag, see `notices`.
inline bool is_noticed(const BodySettings &settings, const Surface &surface) {
	return (settings.collision_mask & surface.layer) != 0;
}

/// Whether a body notices a surface of the environment: by layer, and by the tags that the body ignores.
inline bool notices(const SoftBodyData &body, const Surface &surface) {
	return is_noticed(body.settings(), surface) && !body.ignores_tag(surface.tag);
}

/// Friction coefficient and restitution of a body on a surface, by Godot's rule (see `Surface`).
Real combined_friction(const BodySettings &settings, const Surface &surface);
Real combined_restitution(const BodySettings &settings, const Surface &surface);

/// Whether nothing holds the points of a body together. Then each point bounces by itself; other bodies bounce as wholes.
inline bool bounces_by_points(const SoftBodyShape &shape, const BodySettings &settings) {
	return shape.springs().empty() && !(settings.shape_stiffness > 0) && !settings.is_elastic();
}

/// Whether edges of the hull touch as parts of a round outline, see `edge_bulges`. Loose points have no outline.
inline bool has_round_edges(const SoftBodyShape &shape, const BodySettings &settings) {
	return !shape.bulges().empty() && !bounces_by_points(shape, settings);
}

/// Impulse of a contact [mass·length/s].
struct SurfaceImpulse {
	Real normal = 0;
	Real sliding = 0; ///< along the tangent, the normal turned by a quarter
};

/// Solves one contact. The place is moved out of the surface along the normal and loses its approach. If the body
/// `bounces_by_points`, the place gets it back times the restitution, from `bounce_threshold` [length/s] on. Friction takes from the sliding speed what
/// Coulomb's law allows, |Δv_t| <= friction |Δv_n|, together with the way slid in this substep `h` [s], so that a body
/// at rest on a slope does not creep. Moving out changes no velocity: a deep overlap is resolved without a jump. The
/// ends of an edge share all changes by inverse mass. Returns the impulses [mass·length/s], 0 if the place was already
/// leaving or cannot move. O(1).
SurfaceImpulse solve_surface_contact(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface, Real bounce_threshold,
		Real h);

/// Sums over a body's contacts in one substep, for effects on the body as a whole.
template <class T>
struct BasicContactLoad {
	bool is_summed = true; ///< whether more is wanted than the number of contacts
	T contacts = T(0); ///< number of contacts solved
	T normal_impulse = T(0); ///< sum of |J_n| [mass·length/s]
	BasicVec2<T> impulse; ///< sum of J_n n [mass·length/s]
	// Sums of |J_n| times a value of the surface; divided by `normal_impulse` they are weighted means.
	T surface_spin = T(0);
	T restitution = T(0);
	BasicVec2<T> surface_velocity;
	T work = T(0); ///< of moving surfaces, sum of J·u [mass·length²/s²]

	/// Adds a contact with the normal impulse `size` and the sliding impulse `sliding` along the tangent.
	void add(T size, BasicVec2<T> normal, T sliding, BasicVec2<T> place, const Surface &surface, Real combined_restitution) {
		work += dot(normal * size + perpendicular(normal) * sliding, surface.velocity_at(place));
		normal_impulse += size;
		impulse += normal * size;
		surface_spin += size * T(surface.angular_velocity);
		restitution += size * T(combined_restitution);
		surface_velocity += surface.velocity_at(place) * size;
	}
};
using ContactLoad = BasicContactLoad<Real>;

/// Result of a contact at one hull point.
template <class T>
struct BasicPointSolution {
	T depth = T(0); ///< depth of the contact [length]; 0: there was no contact
	T normal_impulse = T(0); ///< [mass·length/s]
};

/// Solves the contacts of all hull points with a border, in the order of the hull, each as `solve_surface_contact`
/// does, and adds them to `load`. A non-empty `solutions` has an entry for each hull point; the entries of points with
/// a contact are set. O(hull points).
template <class T>
void solve_border(const BodyLanes<T> &body, const Border &border, Real bounce_threshold, Real h,
		BasicContactLoad<T> &load, std::span<BasicPointSolution<T>> solutions = {});

/// Applies rolling resistance against the surfaces that the body pressed on: |Δω| <= r R J / I with r the rolling
/// resistance, R the body's radius, J the summed normal impulse, I the current inertia. Changes no linear momentum and
/// never reverses the spin. O(points).
template <class T>
void resist_rolling(const BodyLanes<T> &body, const BasicContactLoad<T> &load);

/// Whether a touch has to be followed through a substep with these contacts.
inline bool is_followed(const TouchMemory &touch, const ContactLoad &load) {
	return touch.touching || load.restitution > 0;
}

/// Follows the touch of a body with bouncing surfaces through a substep of `h` [s]. The body remembers the fastest
/// approach of its center of mass. When it leaves slower than the restitution asks for, the missing speed is noted, and
/// `BounceLedger` gives it at the end of the step. Approaches below `bounce_threshold` [length/s] do not count. While the
/// body is slower than the threshold it forgets the approach, over BOUNCE_MEMORY. `velocity` [length/s] is that of the center of
/// mass after the contacts. Precondition: `is_followed`. O(1).
void follow_bounce(TouchMemory &touch, const ContactLoad &load, Vec2 velocity, Real mass, Real bounce_threshold, Real h);
/// The same for a body that may have nothing to follow. O(points) while it touches.
void follow_bounce(SoftBodyData &body, const ContactLoad &load, Real bounce_threshold, Real h);

} // namespace softbody
