// SPDX-License-Identifier: MIT
// Solves a contact with an immovable surface.
#include "core/collision/surface_constraint.h"

#include "core/base/constants.h"
#include "core/collision/surface_constraint_lanes.h"

#include <algorithm>
#include <cmath>

namespace softbody {

Real combined_friction(const BodySettings &settings, const Surface &surface) {
	return combine_friction(signed_friction(settings.friction, settings.rough), signed_friction(surface.friction, surface.rough));
}

Real combined_restitution(const BodySettings &settings, const Surface &surface) {
	return std::clamp(signed_restitution(settings.restitution, settings.absorbent) +
					signed_restitution(surface.restitution, surface.absorbent),
			Real(0), Real(1));
}

SurfaceImpulse solve_surface_contact(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface, Real bounce_threshold,
		Real h) {
	const PointOnEdge place(contact.place, body.inverse_masses());
	if (!(place.inverse_mass > 0)) {
		return {}; // pinned
	}
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const Vec2 relative = place.of(v) - surface.velocity_at(place.of(x));
	const Real approach = -dot(relative, contact.normal);
	const Real restitution = bounces_by_points(body.shape(), body.settings()) ? combined_restitution(body.settings(), surface) : Real(0);
	const Real normal_change = approach > 0 ? approach + rebound_speed(approach, restitution, bounce_threshold) : Real(0);
	const ContactChange<Real> change = contact_change(relative, contact.normal, contact.depth, normal_change,
			combined_friction(body.settings(), surface), h);
	place.change(x, change.position);
	place.change(v, change.velocity);
	return { normal_change / place.inverse_mass, dot(change.velocity, perpendicular(contact.normal)) / place.inverse_mass };
}

void follow_bounce(TouchMemory &touch, const ContactLoad &load, Vec2 velocity, Real mass, Real bounce_threshold, Real h) {
	touch.work += double(load.work);
	if (load.normal_impulse > 0) {
		const Real size = length(load.impulse);
		if (!(size > 0)) {
			return; // squeezed from both sides: no direction to bounce to
		}
		touch.normal = load.impulse * (1 / size);
		touch.surface_velocity = load.surface_velocity * (1 / load.normal_impulse);
		touch.restitution = load.restitution / load.normal_impulse;
		// The approach includes what this substep's contacts have just removed.
		const Vec2 before = velocity - load.impulse * (1 / mass) - touch.surface_velocity;
		remember_approach(touch, -dot(before, touch.normal), bounce_threshold, h);
		return;
	}
	const Real leaving = dot(velocity - touch.surface_velocity, touch.normal);
	end_touch(touch, touch.restitution, leaving, bounce_threshold);
}

void follow_bounce(SoftBodyData &body, const ContactLoad &load, Real bounce_threshold, Real h) {
	if (is_followed(body.touch_memory(), load)) {
		follow_bounce(body.touch_memory(), load, measure_translation(body).velocity, body.shape().total_mass(), bounce_threshold, h);
	}
}

template void solve_border<Real>(const BodyLanes<Real> &, const Border &, Real, Real, ContactLoad &,
		std::span<BasicPointSolution<Real>>);
template void resist_rolling<Real>(const BodyLanes<Real> &, const ContactLoad &);

} // namespace softbody
