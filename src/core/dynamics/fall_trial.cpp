// SPDX-License-Identifier: MIT
// Finds whether a body has its shape back after a fall: copies of it fall in worlds of their own.
#include "core/dynamics/fall_trial.h"

#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "core/model/world_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace softbody {

namespace {

constexpr std::uint32_t EVERY_LAYER = UINT32_MAX;
constexpr Real LONGEST = 8; // [s] of a fall, at rest or not
constexpr Real FALL_RADII = 2;
constexpr Real FALL_TURN = Real(0.2); // [rad]; a body that stands on a corner or an edge may stay balanced there

FallOutcome try_fall(SoftBodyData body, Vec2 gravity, Real length_unit, Real dt) {
	FallOutcome outcome;
	WorldData world;
	const Vec2 pull = body.total_acceleration(gravity);
	if (!(length(pull) > 0) || world.set_gravity(gravity) || world.set_length_unit(length_unit)) {
		return outcome;
	}
	const Vec2 down = pull * (1 / length(pull));
	Real lowest = std::numeric_limits<Real>::lowest();
	for (const Vec2 point : body.hull()) {
		lowest = std::max(lowest, dot(point, down));
	}
	const Real rest_area = body.shape().rest_area();
	lowest += FALL_RADII * std::sqrt(rest_area / std::numbers::pi_v<Real>);
	Surface ground;
	ground.layer = EVERY_LAYER;
	if (world.add_border({ { down * lowest, -down }, ground })) {
		return outcome;
	}
	const BodyId id = world.add_soft_body(std::move(body));
	Simulator simulator(world);
	for (Real elapsed = 0; elapsed < LONGEST && !world.find(id)->is_asleep(); elapsed += dt) {
		simulator.simulate(dt);
	}
	outcome.area_loss = 1 - signed_area(world.find(id)->hull()) / rest_area;
	outcome.folded = is_folded(world.find(id)->hull());
	return outcome;
}

} // namespace

FallOutcome try_falls(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt) {
	SoftBodyData copy = body;
	BodySettings settings = body.settings();
	settings.can_sleep = true;
	settings.contact_monitor = false;
	settings.collision_mask = EVERY_LAYER;
	if (body.has_pins() || !(dt > 0) || copy.set_settings(settings)) {
		return {};
	}
	copy.set_frozen(false);
	copy.set_active(true);
	copy.wake();
	const FallOutcome upright = try_fall(copy, gravity, length_unit, dt);
	if (!upright.keeps_shape()) {
		return upright;
	}
	const Vec2 center = measure_frame(copy).center;
	copy.teleport({ center, {} }, { center, Rotation::from_angle(FALL_TURN) });
	const FallOutcome turned = try_fall(copy, gravity, length_unit, dt);
	return { std::max(upright.area_loss, turned.area_loss), turned.folded };
}

} // namespace softbody
