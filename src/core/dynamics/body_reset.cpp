// SPDX-License-Identifier: MIT
// Tests whether a body can continue, and restores the rest shape of one that cannot.
#include "core/dynamics/body_reset.h"

#include "core/base/constants.h"
#include "core/model/body_frame.h"

#include <cstdint>
#include <limits>
#include <span>

namespace softbody {

namespace {

bool is_together(const SoftBodyData &body) {
	return is_finite_within<Real>(body.positions(), body.velocities(), CREDIBLE_REACH * body.shape().radius());
}

// The center at which the pins of a body in its rest shape lie, on average, at their present places: a body torn from
// its pins would be torn again in every step. Without finite pins, `otherwise`.
Vec2 center_by_pins(const SoftBodyData &data, Rotation rotation, Vec2 otherwise) {
	Vec2 sum;
	std::size_t count = 0;
	for (std::uint32_t i = 0; i < data.point_count(); ++i) {
		if (data.is_pinned(i) && is_finite(data.positions()[i])) {
			sum += data.positions()[i] - rotation.apply(data.shape().rest_positions()[i]);
			++count;
		}
	}
	const Vec2 mean = sum * (1 / Real(count));
	return count > 0 && is_finite(mean) ? mean : otherwise;
}

// The most probable center of a body with NaN among its points: that of its finite points, else that of the start of
// the step.
Vec2 center_by_finite_points(const SoftBodyData &data) {
	for (const std::span<const Vec2> points : { data.positions(), data.previous_positions() }) {
		Vec2 sum;
		std::size_t count = 0;
		for (const Vec2 p : points) {
			if (is_finite(p)) {
				sum += p;
				++count;
			}
		}
		const Vec2 mean = sum * (1 / Real(count));
		if (count > 0 && is_finite(mean)) {
			return mean;
		}
	}
	return {};
}

} // namespace

Real credible_reach(const SoftBodyShape &shape, const SubstepPlan &plan) {
	return plan.frequency > 0 ? CREDIBLE_REACH * shape.radius() : std::numeric_limits<Real>::infinity();
}

bool is_finite(const SoftBodyData &body) {
	RealPack sum(0);
	for (std::size_t i = 0; i < packs_for(body.point_count()); ++i) {
		sum += zero_if_finite(pack_of(body.positions(), i), pack_of(body.velocities(), i));
	}
	return !any(!(sum < RealPack(1)));
}

void reset_body(SoftBodyData &data, Real dt) {
	const BodyFrame frame = measure_frame(data);
	Vec2 center = frame.center;
	Rotation rotation = data.rotation_memory();
	const Real size = length(Vec2{ rotation.c, rotation.s });
	if (!(size > Real(0.5) && size < 2)) { // NaN compares false; rounding stays far from these bounds
		rotation = {};
		data.set_rotation_memory(rotation);
	}
	Vec2 velocity;
	const bool is_whole = is_finite(center) && is_together(data);
	if (!is_finite(center)) {
		center = center_by_finite_points(data);
	} else if (is_whole) {
		rotation = frame.rotation;
		if (!data.has_pins() && length(frame.velocity) * dt <= CREDIBLE_REACH * data.shape().radius()) {
			velocity = frame.velocity;
		}
	}
	if (!is_whole) {
		center = center_by_pins(data, rotation, center);
	}
	for (std::size_t i = 0; i < data.point_count(); ++i) {
		const bool is_pinned = data.inverse_masses()[i] == 0;
		const Vec2 home = center + rotation.apply(data.shape().rest_positions()[i]);
		data.mutable_positions()[i] = is_pinned && is_finite(data.positions()[i]) ? data.positions()[i] : home;
		data.mutable_velocities()[i] = is_pinned ? Vec2{} : velocity;
	}
	data.touch_memory() = {};
	data.one_ways().clear();
	data.last_valid_hull().clear();
	data.clear_external_forces(); // they might ruin the body again
}

} // namespace softbody
