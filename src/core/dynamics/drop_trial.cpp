// SPDX-License-Identifier: MIT
// Finds from what height a body may fall before it dents, or tears.
#include "core/dynamics/drop_trial.h"

#include "core/dynamics/simulator.h"
#include "core/model/world_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

constexpr std::uint32_t EVERY_LAYER = UINT32_MAX;
constexpr Real LANDING = Real(0.5); // [s] that a landing is watched
constexpr Real FIRST_DROP = Real(0.05); // of the radius [1]
constexpr Real TOLERANCE = Real(1.05);

class Drops {
public:
	Drops(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt, int most_steps, const DropCheck &check) :
			body_(body), gravity_(gravity), unit_(length_unit), dt_(dt), steps_left_(most_steps), check_(check) {}

	/// Whether it happens after a fall from this height. Nothing more is known once `is_stopped`.
	bool happens(Real height) {
		WorldData world;
		SoftBodyData copy = body_;
		BodySettings settings = copy.settings();
		settings.can_sleep = false;
		settings.contact_monitor = false;
		settings.collision_mask = EVERY_LAYER;
		const Vec2 pull = copy.total_acceleration(gravity_);
		const Real size = length(pull);
		if (!(size > 0) || copy.set_settings(settings) || world.set_gravity(gravity_) || world.set_length_unit(unit_)) {
			is_stopped = true;
			return false;
		}
		const Vec2 down = pull * (1 / size);
		copy.set_frozen(false);
		copy.set_active(true);
		copy.wake();
		Real lowest = std::numeric_limits<Real>::lowest();
		for (std::uint32_t i = 0; i < copy.point_count(); ++i) {
			if (i < copy.shape().hull_count()) {
				lowest = std::max(lowest, dot(copy.positions()[i], down));
			}
			is_stopped |= copy.set_point(i, copy.positions()[i], down * std::sqrt(2 * size * height)).has_value();
		}
		Surface ground;
		ground.layer = EVERY_LAYER;
		if (is_stopped || world.add_border({ { down * lowest, -down }, ground })) {
			is_stopped = true;
			return false;
		}
		const BodyId id = world.add_soft_body(std::move(copy));
		Simulator simulator(world);
		for (Real elapsed = 0; elapsed < LANDING; elapsed += dt_) {
			if (--steps_left_ < 0) {
				is_stopped = true;
				return false;
			}
			simulator.simulate(dt_);
			if (check_(*world.find(id))) {
				return true;
			}
		}
		return false;
	}

	bool is_stopped = false;

private:
	const SoftBodyData &body_;
	Vec2 gravity_;
	Real unit_;
	Real dt_;
	int steps_left_;
	const DropCheck &check_;
};

} // namespace

Real find_drop_height(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt, int most_steps, const DropCheck &check) {
	constexpr Real UNKNOWN = std::numeric_limits<Real>::quiet_NaN();
	if (body.has_pins() || !(dt > 0)) {
		return UNKNOWN;
	}
	Drops drops(body, gravity, length_unit, dt, most_steps, check);
	if (drops.happens(0)) {
		return 0;
	}
	Real harmless = 0;
	Real height = FIRST_DROP * body.shape().radius();
	while (!drops.is_stopped && !drops.happens(height)) {
		if (height >= MOST_DROP * length_unit) {
			return drops.is_stopped ? UNKNOWN : std::numeric_limits<Real>::infinity();
		}
		harmless = height;
		height = std::min(height * 2, MOST_DROP * length_unit);
	}
	while (!drops.is_stopped && height > std::max(harmless * TOLERANCE, FIRST_DROP * body.shape().radius())) {
		const Real middle = (harmless + height) / 2;
		(drops.happens(middle) ? height : harmless) = middle;
	}
	return drops.is_stopped ? UNKNOWN : height;
}

} // namespace softbody
