// SPDX-License-Identifier: MIT
// What a contact with an immovable surface does to the points of a body.
#include "core/collision/surface_response.h"

#include "core/model/body_frame.h"

#include <algorithm>

namespace softbody {

Real answer_contact(SoftBodyData &body, const SurfaceContact &contact, const Surface &surface, Real bounce_threshold,
		Real h) {
	const auto [a, b, t] = contact.place;
	const Real share_a = 1 - t;
	const Real share_b = a == b ? Real(0) : t;
	const Real mobility_a = body.inverse_masses()[a] * share_a;
	const Real mobility_b = body.inverse_masses()[b] * share_b;
	// An impulse J at the place moves it by J w with w = w_a (1-t)² + w_b t²; dividing by w turns the
	// wanted change at the place into the changes of its end points.
	const Real mobility = mobility_a * share_a + mobility_b * share_b;
	if (!(mobility > 0)) {
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
		const BodySettings &settings = body.settings();
		const Real friction = surface.rough ? surface.friction : std::min(settings.friction, surface.friction);
		const Real restitution = std::clamp(settings.restitution +
						(surface.absorbent ? -surface.restitution : surface.restitution),
				Real(0), Real(1));
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
	x[a] += shift * (mobility_a / mobility);
	v[a] += velocity_change * (mobility_a / mobility);
	if (a != b) {
		x[b] += shift * (mobility_b / mobility);
		v[b] += velocity_change * (mobility_b / mobility);
	}
	return normal_change / mobility;
}

void resist_rolling(SoftBodyData &body, const ContactLoad &load) {
	const Real resistance = body.settings().rolling_resistance;
	if (!(resistance > 0) || !(load.normal_impulse > 0)) {
		return;
	}
	const BodyFrame frame = measure_frame(body);
	Real inertia = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		inertia += body.shape().masses()[i] * length_squared(body.positions()[i] - frame.centre);
	}
	if (!(inertia > 0)) {
		return;
	}
	const Real spin = frame.angular_velocity - load.surface_spin / load.normal_impulse;
	const Real most = resistance * body.shape().radius() * load.normal_impulse / inertia;
	const Real change = -std::clamp(spin, -most, most);
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		if (body.inverse_masses()[i] > 0) {
			body.mutable_velocities()[i] += perpendicular(body.positions()[i] - frame.centre) * change;
		}
	}
}

} // namespace softbody
