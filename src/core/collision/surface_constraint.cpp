// SPDX-License-Identifier: MIT
// What a contact with an immovable surface does to the points of a body.
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

Real solve_surface_contact(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface, Real bounce_threshold,
		Real h) {
	const auto [a, b, t] = contact.place;
	const Real share_a = 1 - t;
	const Real share_b = a == b ? Real(0) : t;
	const Real inverse_mass_a = body.inverse_masses()[a] * share_a;
	const Real inverse_mass_b = body.inverse_masses()[b] * share_b;
	// An impulse J at the place moves it by J w with w = w_a (1-t)² + w_b t²; dividing by w turns the
	// wanted change at the place into the changes of its end points.
	// Beside a pinned or very heavy end the exact w goes to 0 and would throw the other end away; the floor
	// leaves such a contact partly unsolved, for the next substep.
	const Real largest = std::max(body.inverse_masses()[a], body.inverse_masses()[b]);
	const Real inverse_mass = std::max(inverse_mass_a * share_a + inverse_mass_b * share_b, LEAST_EDGE_INVERSE_MASS * largest);
	if (!(inverse_mass > 0)) {
		return 0; // pinned
	}
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const Vec2 place = x[a] * share_a + x[b] * share_b;
	const Vec2 relative = v[a] * share_a + v[b] * share_b - surface.velocity_at(place);
	Vec2 shift = contact.normal * contact.depth;
	Vec2 velocity_change;
	Real normal_change = 0;

	const Real approach = -dot(relative, contact.normal);
	if (approach > 0) {
		const Real friction = combined_friction(body.settings(), surface);
		const Real restitution = combined_restitution(body.settings(), surface);
		normal_change = approach * (approach > bounce_threshold ? 1 + restitution : Real(1));
		const Vec2 slide = relative + contact.normal * approach;
		const Real slide_speed = length(slide);
		velocity_change = contact.normal * normal_change;
		if (slide_speed > 0) {
			const Vec2 brake = slide * (-std::min(slide_speed, friction * normal_change) / slide_speed);
			velocity_change += brake;
			shift += brake * h;
		}
	}
	x[a] += shift * (inverse_mass_a / inverse_mass);
	v[a] += velocity_change * (inverse_mass_a / inverse_mass);
	if (a != b) {
		x[b] += shift * (inverse_mass_b / inverse_mass);
		v[b] += velocity_change * (inverse_mass_b / inverse_mass);
	}
	return normal_change / inverse_mass;
}

void give_back_bounce(SoftBodyData &body, const ContactLoad &load, Real bounce_threshold, Real h) {
	TouchMemory &touch = body.touch_memory();
	if (!touch.touching && !(load.restitution > 0)) {
		return; // in free flight, or nothing bounces here
	}
	const Real mass = body.shape().total_mass();
	Vec2 momentum;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		momentum += body.velocities()[i] * body.shape().masses()[i];
	}
	const Vec2 velocity = momentum * (1 / mass);
	if (load.normal_impulse > 0) {
		const Real size = length(load.impulse);
		if (!(size > 0)) {
			return; // squeezed from both sides: no direction to bounce to
		}
		touch.normal = load.impulse * (1 / size);
		touch.surface_velocity = load.surface_velocity * (1 / load.normal_impulse);
		touch.restitution = load.restitution / load.normal_impulse;
		// What this substep's contacts have just taken belongs to the approach.
		const Vec2 before = velocity - load.impulse * (1 / mass) - touch.surface_velocity;
		const Real approach = -dot(before, touch.normal);
		if (!touch.touching) {
			touch.approach = 0;
		} else if (std::abs(approach) <= bounce_threshold) {
			// A turning point passes through here within a substep or two; a body at rest stays.
			touch.approach *= std::max(Real(0), 1 - h / BOUNCE_MEMORY);
		}
		touch.approach = std::max(touch.approach, approach);
		touch.touching = true;
		return;
	}
	const Real leaving = dot(velocity - touch.surface_velocity, touch.normal);
	if (!(leaving > 0)) {
		return; // between two contacts of one touch
	}
	const Real missing = touch.restitution * touch.approach - leaving;
	if (touch.approach > bounce_threshold && missing > 0) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			if (body.inverse_masses()[i] > 0) {
				body.mutable_velocities()[i] += touch.normal * missing;
			}
		}
	}
	touch = {};
}

#define SOFTBODY_INSTANTIATE(T)                                                                                      \
	template void solve_border<T>(const BodyLanes<T> &, const Border &, Real, Real, BasicContactLoad<T> &,          \
			std::span<BasicPointSolution<T>>);                                                                         \
	template void resist_rolling<T>(const BodyLanes<T> &, const BasicContactLoad<T> &);
SOFTBODY_INSTANTIATE(Real)
SOFTBODY_INSTANTIATE(RealPack)
#undef SOFTBODY_INSTANTIATE

} // namespace softbody
