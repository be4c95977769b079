// SPDX-License-Identifier: MIT
// Finds how a body carries its own weight: a copy of it settles in a world of its own.
#include "core/dynamics/load_trial.h"

#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace softbody {

namespace {

constexpr std::uint32_t EVERY_LAYER = UINT32_MAX;
constexpr Real LARGEST_FACTOR = 4096;
constexpr Real FACTOR_PRECISION = Real(1.1);

// A copy with all resistance to a change of shape times `factor`, and its damping ratios.
Result<SoftBodyData> made_stiffer(const SoftBodyData &body, Real factor) {
	SoftBodyData stiffer = body;
	BodySettings settings = body.settings();
	settings.spring_stiffness_scale *= factor;
	settings.spring_damping_scale *= std::sqrt(factor);
	settings.shape_stiffness *= factor;
	settings.shape_damping *= std::sqrt(factor);
	settings.shear_modulus *= factor;
	settings.area_stiffness *= factor;
	settings.elastic_damping_time /= std::sqrt(factor);
	if (Status status = stiffer.set_settings(settings)) {
		return *status;
	}
	return stiffer;
}

} // namespace

bool needs_more(const LoadOutcome &outcome) {
	return outcome.folded || outcome.area_loss > FIRM_AREA_LOSS || outcome.sag > 2 * FIRM_AREA_LOSS;
}

Result<LoadTrial> LoadTrial::create(SoftBodyData body, Vec2 gravity, Real length_unit, Real dt) {
	if (Status status = check_above("dt", double(dt), 0, "s")) {
		return *status;
	}
	LoadTrial trial;
	trial.world_ = std::make_unique<WorldData>();
	WorldData &world = *trial.world_;
	if (Status status = world.set_gravity(gravity)) {
		return *status;
	}
	if (Status status = world.set_length_unit(length_unit)) {
		return *status;
	}
	BodySettings settings = body.settings();
	settings.can_sleep = true;
	settings.contact_monitor = false;
	settings.collision_mask = EVERY_LAYER;
	// The trial judges elasticity; with its limits a body would stand in any case.
	settings.least_area = 0;
	settings.least_stretch = 0;
	settings.most_stretch = std::numeric_limits<Real>::infinity();
	if (Status status = body.set_settings(settings)) {
		return *status;
	}
	body.set_frozen(false);
	body.set_active(true);
	body.wake();

	trial.dt_ = dt;
	trial.hangs_ = body.has_pins();
	trial.first_center_ = measure_frame(body).center;
	const Vec2 pull = body.total_acceleration(gravity);
	if (length(pull) > 0) {
		trial.down_ = pull * (1 / length(pull));
		if (!trial.hangs_) {
			Real lowest = std::numeric_limits<Real>::lowest();
			Vec2 lowest_point;
			for (const Vec2 point : body.hull()) {
				if (dot(point, trial.down_) > lowest) {
					lowest = dot(point, trial.down_);
					lowest_point = point;
				}
			}
			Surface ground;
			ground.layer = EVERY_LAYER;
			if (Status status = world.add_border({ { lowest_point, -trial.down_ }, ground })) {
				return *status;
			}
		}
	}
	world.add_soft_body(std::move(body));
	trial.simulator_ = std::make_unique<Simulator>(world);
	return trial;
}

bool LoadTrial::step() {
	if (elapsed_ >= LONGEST || body().is_asleep()) {
		return false;
	}
	simulator_->simulate(dt_);
	elapsed_ += dt_;
	return true;
}

Real LoadTrial::height_along(Vec2 down, std::span<const Vec2> points) const {
	Real least = std::numeric_limits<Real>::max();
	Real most = std::numeric_limits<Real>::lowest();
	for (const Vec2 point : points) {
		least = std::min(least, dot(point, down));
		most = std::max(most, dot(point, down));
	}
	return most - least;
}

LoadOutcome LoadTrial::outcome() const {
	LoadOutcome outcome;
	const SoftBodyShape &shape = body().shape();
	const BodyFrame frame = measure_frame(body());
	outcome.folded = is_folded(body().hull());
	outcome.area_loss = 1 - signed_area(body().hull()) / shape.rest_area();
	outcome.rests = body().is_asleep();
	if (length(down_) > 0) {
		// A body that has rolled or toppled is compared with its rest height in that orientation.
		const Real height = height_along(frame.rotation.apply_inverse(down_), shape.rest_hull());
		outcome.sag = hangs_ ? dot(frame.center - first_center_, down_) / height
							 : 1 - height_along(down_, body().hull()) / height;
	}
	return outcome;
}

Real find_firm_factor(const SoftBodyData &body, Vec2 gravity, Real length_unit, Real dt, int most_steps) {
	int steps = 0;
	const auto holds_with = [&](Real factor) {
		auto stiffer = made_stiffer(body, factor);
		if (!stiffer) {
			return false;
		}
		auto trial = LoadTrial::create(std::move(stiffer.value()), gravity, length_unit, dt);
		if (!trial) {
			return false;
		}
		while (steps < most_steps && trial.value().step()) {
			++steps;
		}
		return !needs_more(trial.value().outcome());
	};
	Real low = 1;
	if (holds_with(low)) {
		return steps < most_steps ? low : Real(0);
	}
	Real high = 2;
	while (!holds_with(high)) {
		if (high >= LARGEST_FACTOR || steps >= most_steps) {
			return 0;
		}
		low = high;
		high *= 2;
	}
	while (high > FACTOR_PRECISION * low) {
		const Real middle = std::sqrt(low * high);
		(holds_with(middle) ? high : low) = middle;
	}
	return steps < most_steps ? high * FACTOR_PRECISION : Real(0);
}

} // namespace softbody
