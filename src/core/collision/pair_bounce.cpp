// SPDX-License-Identifier: MIT
// Restitution between two bodies as wholes.
#include "core/collision/pair_bounce.h"

#include "core/base/constants.h"
#include "core/collision/point_edge_constraint.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softbody {

namespace {

struct Bouncing {
	SoftBodyData &body;
	BodyFrame frame;
	Real inverse_mass; // of the body as a whole; 0 where a point is pinned

	Vec2 rigid_velocity(std::size_t i) const {
		return frame.velocity + perpendicular(body.positions()[i] - frame.center) * frame.angular_velocity;
	}
	double kinetic_energy() const {
		double twice = 0;
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			twice += double(body.shape().masses()[i]) * length_squared(body.velocities()[i]);
		}
		return twice / 2;
	}
	double wobble_energy() const { // of the motion relative to the rigid one
		double twice = 0;
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			twice += double(body.shape().masses()[i]) * length_squared(body.velocities()[i] - rigid_velocity(i));
		}
		return twice / 2;
	}
	void change(Vec2 by, Real keep_of_wobble) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			const Vec2 rigid = rigid_velocity(i);
			body.mutable_velocities()[i] = rigid + by + (body.velocities()[i] - rigid) * keep_of_wobble;
		}
	}
};

Bouncing bouncing(SoftBodyData &body) {
	return { body, measure_frame(body), body.is_free() ? 1 / body.shape().total_mass() : Real(0) };
}

} // namespace

void give_back_pair_bounce(SoftBodyData &first, SoftBodyData &second, Vec2 push, PairTouch &touch,
		Real bounce_threshold, Real h) {
	const Real restitution = std::min(signed_restitution(first.settings().restitution, first.settings().absorbent) +
					signed_restitution(second.settings().restitution, second.settings().absorbent),
			Real(1));
	if (!(restitution > 0) || (push == Vec2{} && !touch.touching)) {
		return;
	}
	std::array<Bouncing, 2> pair = { bouncing(first), bouncing(second) };
	const Real inverse_mass = pair[0].inverse_mass + pair[1].inverse_mass;
	const Vec2 line = pair[0].frame.center - pair[1].frame.center;
	const Real distance = length(line);
	if (!(inverse_mass > 0) || !(distance > 0)) {
		return;
	}
	const Vec2 normal = line * (1 / distance);
	const Real leaving = dot(pair[0].frame.velocity - pair[1].frame.velocity, normal);
	if (push != Vec2{}) {
		// The approach includes what this substep's contacts have just removed.
		const Real approach = dot(push, normal) * inverse_mass - leaving;
		if (!touch.touching) {
			touch.energy = pair[0].kinetic_energy() + pair[1].kinetic_energy() +
					double(approach * approach - leaving * leaving) / (2 * double(inverse_mass));
		}
		remember_approach(touch, approach, bounce_threshold, h);
		return;
	}
	if (!(leaving > 0)) {
		return; // between two contacts of one touch
	}
	const Real wanted = restitution * touch.approach;
	if (touch.approach > bounce_threshold && wanted > leaving) {
		double energy = 0;
		double wobble = 0;
		for (const Bouncing &body : pair) {
			energy += body.kinetic_energy();
			wobble += body.inverse_mass > 0 ? body.wobble_energy() : 0.0;
		}
		// The bounce is paid for by the energy that the contacts have lost, then by the wobble. On average the springs
		// hold as much energy as the wobble, so it is not lost.
		const double price = double(wanted * wanted - leaving * leaving) / (2 * double(inverse_mass));
		const double lost = std::max(0.0, touch.energy - energy - wobble);
		const double from_wobble = std::clamp(price - lost, 0.0, wobble);
		const double paid = std::min(price, lost + from_wobble);
		const Real keep = Real(std::sqrt(1 - from_wobble / std::max(wobble, 1e-300)));
		const Real parting = std::sqrt(leaving * leaving + 2 * inverse_mass * Real(paid));
		const Vec2 impulse = normal * ((parting - leaving) / inverse_mass);
		if (!is_finite(impulse) || !std::isfinite(keep)) {
			touch = {};
			return; // a body that is about to be reset must not affect the other
		}
		for (Bouncing &body : pair) {
			if (body.inverse_mass > 0) {
				body.change(impulse * (&body == &pair[0] ? body.inverse_mass : -body.inverse_mass), keep);
			}
		}
	}
	touch = {};
}

} // namespace softbody
