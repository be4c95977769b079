// SPDX-License-Identifier: MIT
// A CharacterBody2D as a body with a mass, while it falls or stands on soft bodies.
#include "godot/surroundings/character_motion.h"

#include "godot/convert.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

// Where a soft body is looked for that a character on a floor stands on, above and below its soles [px]. It is farther
// below them in the tick in which it gives way.
constexpr Real FLOOR_ABOVE = 4;
constexpr Real FLOOR_BELOW = 16;

// Speed at which a character may walk off at any time and find no wall of the dent in which it stands [px/s].
constexpr Real WALKING_SPEED = 1000;

// Gap between where a step has left the soles and the floor that the engine sees: a little less than the margin that the
// engine keeps characters from floors by, as a share of it and in px. Larger: it does not find the floor if it snaps to
// none. Smaller: it lifts the character in each tick.
constexpr Real GAP_SHARE = Real(0.6);
constexpr Real GAP_BELOW_MARGIN = Real(0.03);

// Difference between the way of a character in the air and that of its velocity in a tick, beside a quarter of it, up to
// which it counts as moved by that [px].
constexpr Real FLIGHT_TOLERANCE = 1;

// A character that has stood so long [s], slower than this [px/s] and within this distance [px], sleeps, and lets the soft
// bodies under it sleep, until they press it by less or more than these parts of its weight.
constexpr Real CALM_TIME = Real(0.5);
constexpr Real CALM_SPEED = 3;
constexpr Real CALM_DISTANCE = Real(0.2);
constexpr Real LEAST_LOAD = Real(0.5);
constexpr Real MOST_LOAD = Real(1.5);

// Part of its way in a tick, and most [px], by which a landing character finds the floor earlier. Smaller: one that is
// hardly braked, in short ticks, passes the floor and falls on.
constexpr Real LANDING_SHARE = Real(0.3);
constexpr Real MOST_LANDING_LIFT = 1;

// Gap between the soles of a character that rises and the floor [px]: what it leaves is not to hold it. One on the floor
// is thrown off if it rises higher than that.
constexpr Real LEAVING_GAP = 2;

// Distance from where the last step has left it at which something else has stopped the character [px].
constexpr Real BLOCKED_DISTANCE = 3;

} // namespace

const char *const CharacterMotion::MASS_META = "soft_body_mass";

void CharacterMotion::begin_tick() {
	is_near_ = false;
	is_above_ = false;
	surface_speed_ = 0;
	is_hard_ = false;
}

void CharacterMotion::note_near(const SoftBodyData &body, const Aabb &box, bool hard) {
	is_near_ = true;
	is_hard_ |= hard;
	if (const std::optional<Vec2> surface = velocity_at_soles(body.hull(), body.velocities(), { box, up_ }, FLOOR_ABOVE, FLOOR_BELOW)) {
		surface_speed_ = is_above_ ? std::max(surface_speed_, dot(*surface, up_)) : dot(*surface, up_);
		is_above_ = true;
	}
}

bool CharacterMotion::begin_step(const CharacterBody2D &node, Vec2 gravity, Real mass, Real delta, RigidBody &r_body) {
	const bool stood = std::exchange(stood_, false);
	up_ = to_core(node.get_up_direction());
	const Real own_mass = node.has_meta(MASS_META) ? Real(double(node.get_meta(MASS_META))) : mass;
	const bool is_on_floor = node.is_on_floor();
	const Vec2 velocity = to_core(node.get_velocity());
	// One that is not moved by its velocity is a lift or a piston.
	const Real fall = dot(velocity, up_);
	const bool is_in_flight = !is_on_floor && fall != 0 &&
			std::abs(dot(r_body.linear_velocity, up_) - fall) * delta < FLIGHT_TOLERANCE + std::abs(fall) * delta / 4;
	acts_ = is_near_ && !is_hard_ && own_mass > 0 && std::isfinite(own_mass) && delta > 0 &&
			node.get_motion_mode() == CharacterBody2D::MOTION_MODE_GROUNDED && (is_on_floor ? is_above_ : is_in_flight);
	if (!acts_) {
		return false;
	}
	Real speed = fall;
	Vec2 carried;
	own_speed_ = 0;
	from_ = r_body.pose.position;
	if (is_on_floor) {
		// On a floor the velocity of the node is that relative to the floor: what the step has left is known here only.
		const Real strayed = dot(from_, up_) - level_;
		speed = stood && std::abs(strayed) > BLOCKED_DISTANCE ? speed_ + strayed / delta : speed_;
		stood_ = true;
		own_speed_ = std::max(fall, Real(0)); // of a jump that has not left the floor
		const Vec2 platform = to_core(node.get_platform_velocity());
		carried = platform - up_ * dot(platform, up_);
	}
	const Real margin = Real(node.get_safe_margin());
	floor_gap_ = std::max(margin * GAP_SHARE, margin - GAP_BELOW_MARGIN);
	snap_length_ = Real(const_cast<CharacterBody2D &>(node).get_floor_snap_length()); // the engine's getter is not const
	const bool is_calm = is_on_floor && velocity == Vec2{} && carried == Vec2{} && std::abs(speed) < CALM_SPEED &&
			length(from_ - calm_place_) < CALM_DISTANCE;
	calm_time_ = is_calm ? calm_time_ + delta : 0;
	calm_place_ = is_calm ? calm_place_ : from_;
	reach_ = WALKING_SPEED * delta;
	way_ = (velocity - up_ * dot(velocity, up_) + carried) * delta;
	r_body.linear_velocity = up_ * speed + carried;
	r_body.angular_velocity = 0;
	r_body.acceleration = gravity;
	r_body.inverse_mass = 1 / own_mass;
	r_body.inverse_inertia = 0;
	r_body.asleep = calm_time_ > CALM_TIME;
	return true;
}

void CharacterMotion::end_step(const RigidBody &body, const Reaction &reaction, Real delta) {
	if (body.asleep) { // as long as soft bodies carry its weight
		const Real load = dot(reaction.impulse, up_) * body.inverse_mass / (length(body.acceleration) * delta);
		const bool is_carried = reaction.beside_sleeper || (load > LEAST_LOAD && load < MOST_LOAD);
		calm_time_ = is_carried ? calm_time_ : 0;
	}
	speed_ = body.asleep ? 0 : dot(body.linear_velocity, up_);
	const Real moved = speed_ * delta;
	level_ = dot(from_, up_) + moved;
	// With what it is thrown it rises so high above the floor [px].
	const Real throw_speed = std::max(speed_ - surface_speed_, Real(0));
	const Real rise = throw_speed * throw_speed / (2 * std::max(length(body.acceleration), Real(1)));
	const bool is_pushed = dot(reaction.impulse, up_) > 0;
	const bool is_thrown = stood_ && speed_ > 0 && rise > LEAVING_GAP && !is_pushed;
	// What the step has stopped a little lands for sure: the floor is a part of its way higher.
	gap_ = stood_ || !is_pushed ? floor_gap_ : -std::min(std::abs(moved) * LANDING_SHARE, MOST_LANDING_LIFT);
	if (std::abs(speed_) >= CALM_SPEED) { // what turns round on a surface is in one place for one tick
		calm_time_ = 0;
	}
	if (calm_time_ > 0) { // in one place
		gap_ = dot(from_ - calm_place_, up_) + moved + floor_gap_;
	}
	if (is_thrown || (!stood_ && moved >= 0 && !is_pushed)) {
		gap_ += moved + LEAVING_GAP + (is_thrown ? snap_length_ : 0);
	}
	way_ += up_ * moved;
}

Rider CharacterMotion::rider(const Aabb &box) const {
	return { { box.min + way_, box.max + way_ }, up_, speed_ - own_speed_, reach_, stood_, gap_ };
}

} // namespace softbody
