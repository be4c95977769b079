// SPDX-License-Identifier: MIT
// Keeps a body from being crushed flat, drawn out or turned inside out.
#include "core/dynamics/shape_limits_lanes.h"

#include "core/base/constants.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace softbody {

namespace {

// A linear map of the plane.
struct Map {
	double xx = 0;
	double xy = 0;
	double yx = 0;
	double yy = 0;

	Vec2 apply(Vec2 v) const { return { Real(xx * v.x + xy * v.y), Real(yx * v.x + yy * v.y) }; }
	/// Adds factor · a bᵀ.
	void add(Vec2 a, Vec2 b, double factor) {
		xx += factor * a.x * b.x;
		xy += factor * a.x * b.y;
		yx += factor * a.y * b.x;
		yy += factor * a.y * b.y;
	}
};

// a · b⁻¹, b symmetric.
Map over(const Map &a, const Map &b) {
	const double determinant = b.xx * b.yy - b.xy * b.yx;
	const Map inverse{ b.yy / determinant, -b.xy / determinant, -b.yx / determinant, b.xx / determinant };
	return { a.xx * inverse.xx + a.xy * inverse.yx, a.xx * inverse.xy + a.xy * inverse.yy,
		a.yx * inverse.xx + a.yy * inverse.yx, a.yx * inverse.xy + a.yy * inverse.yy };
}

// F = sum of s_k u_k v_kᵀ, s_1 >= |s_2|; u and v are orthonormal with equal winding, so that s_2 < 0 for a mirrored
// body.
struct Stretches {
	std::array<double, 2> sizes;
	std::array<Vec2, 2> now; ///< u
	std::array<Vec2, 2> rest; ///< v
};

// Stretches of a map as the sum of a turned scaling and a mirrored one, whose angles add and subtract.
Stretches stretches_of(const Map &f) {
	const double e = (f.xx + f.yy) / 2;
	const double g = (f.yx - f.xy) / 2;
	const double h = (f.xx - f.yy) / 2;
	const double k = (f.yx + f.xy) / 2;
	const double turned = std::sqrt(e * e + g * g);
	const double mirrored = std::sqrt(h * h + k * k);
	// As complex numbers of length 1: u v = (h + i k) / mirrored and u / v = (e + i g) / turned. Square roots alone:
	// the last digit of trigonometric functions differs between machines.
	const auto unit = [](double c, double s, double size) { return size > 0 ? std::array{ c / size, s / size } : std::array{ 1.0, 0.0 }; };
	const auto [pc, ps] = unit(h, k, mirrored);
	const auto [qc, qs] = unit(e, g, turned);
	const double c = pc * qc - ps * qs; // u²
	const double s = pc * qs + ps * qc;
	const double half_c = std::sqrt(std::max(0.0, (1 + c) / 2));
	const double half_s = std::copysign(std::sqrt(std::max(0.0, (1 - c) / 2)), s);
	const Vec2 u{ Real(half_c), Real(half_s) };
	const Vec2 v{ Real(pc * half_c + ps * half_s), Real(ps * half_c - pc * half_s) };
	return { { turned + mirrored, turned - mirrored }, { u, perpendicular(u) }, { v, perpendicular(v) } };
}

// The stretches within bounds and with the least area. A bound of 0 is off: a mirrored body stays mirrored.
std::array<double, 2> allowed_stretches(const std::array<double, 2> &found, const ShapeBounds &bounds) {
	std::array<double, 2> allowed;
	for (std::size_t k = 0; k < 2; ++k) {
		const double least = bounds.least_stretch > 0 ? double(bounds.least_stretch) : -double(bounds.most_stretch);
		allowed[k] = std::clamp(found[k], least, double(bounds.most_stretch));
	}
	const double area = allowed[0] * allowed[1];
	if (bounds.least_area > 0 && area < bounds.least_area) {
		// The thinner side gets the missing area first.
		allowed[1] = std::min(bounds.least_area / std::max(allowed[0], 1e-6), allowed[0]);
		allowed[0] = std::max(allowed[0], bounds.least_area / std::max(allowed[1], 1e-6));
	}
	return allowed;
}

// Excess of a body over its bounds.
struct Excess {
	Map shift; ///< from the body's affine map to the allowed one, at most LIMIT_PUSH
	Map now; ///< the body's own affine map
	bool is_any = false; ///< out of bounds at all
	bool is_far = false; ///< out of bounds by more than LIMIT_FAR
};

std::optional<Excess> find_excess(const BodyLanes<Real> &body, Vec2 center) {
	const SoftBodyShape &shape = body.model.shape;
	Map positions;
	Map rest;
	for (std::size_t i = 0; i < shape.point_count(); ++i) {
		const Vec2 q = shape.rest_positions()[i];
		const double mass = shape.masses()[i];
		positions.add(body.positions[i] - center, q, mass);
		rest.add(q, q, mass);
	}
	Excess excess;
	excess.now = over(positions, rest);
	const Stretches stretches = stretches_of(excess.now);
	if (!std::isfinite(stretches.sizes[0])) {
		return std::nullopt;
	}
	const std::array<double, 2> allowed = allowed_stretches(stretches.sizes, bounds_of(body.model.settings));
	for (std::size_t k = 0; k < 2; ++k) {
		const double change = allowed[k] - stretches.sizes[k];
		excess.is_any |= change != 0;
		excess.is_far |= std::abs(change) > double(LIMIT_FAR);
		excess.shift.add(stretches.now[k], stretches.rest[k], std::clamp(change, -double(LIMIT_PUSH), double(LIMIT_PUSH)));
	}
	return excess;
}

// Adds the velocity of a way gone in h, as far as the speed along it stays below `fastest`.
void quicken(Vec2 &velocity, Vec2 way, Real h, Real fastest) {
	const Real size = length(way);
	if (size > 0) {
		const Vec2 direction = way * (1 / size);
		const Real along = dot(velocity, direction);
		velocity += direction * (std::max(along, std::min(along + size / h, fastest)) - along);
	}
}

BodyFrame frame_of(const BodyLanes<Real> &body) {
	return measure_frame<Real>(body.model.shape, body.model.rotation_memory, body.positions, body.velocities);
}

// Restores momentum, spin and center after changes.
void restore_rigid_motion(const BodyLanes<Real> &body, const BodyFrame &before) {
	const BodyFrame after = frame_of(body);
	const Real turn = after.inertia > 0 ? before.angular_velocity * before.inertia / after.inertia - after.angular_velocity : Real(0);
	const Vec2 push = before.velocity - after.velocity;
	const Vec2 back = before.center - after.center;
	for (std::size_t i = 0; i < body.positions.size(); ++i) {
		body.velocities[i] += push + perpendicular(body.positions[i] - after.center) * turn;
		body.positions[i] += back;
	}
}

} // namespace

bool keep_whole(const BodyLanes<Real> &body, Real h, bool bears_load) {
	const SoftBodyShape &shape = body.model.shape;
	const BodySettings &settings = body.model.settings;
	if (!settings.has_limits() || !may_break_limits<Real>(body.model, body.positions)) {
		return false;
	}
	const BodyFrame frame = frame_of(body);
	const std::optional<Excess> excess = find_excess(body, frame.center);
	if (!excess) {
		return false; // not finite: it is about to be reset
	}
	// Crumpled: area is lost although the whole is not small. Points are drawn to their places in the affine map.
	const Real area = hull_area<Real>(body.positions.first(shape.hull_count())) / shape.rest_area();
	const Real least_area = bounds_of(settings).least_area;
	const Real onset = least_area * LIMIT_ONSET;
	const Real smoothing = area < onset ? std::min((onset - area) / (onset - least_area), Real(1)) * LIMIT_SMOOTHING : Real(0);
	const Real walk = LIMIT_SPEED * shape.radius();
	const bool is_pressed = area < pressed_area(settings) || excess->is_any;
	const Real damped = is_pressed ? h * LIMIT_DAMPING / (1 + h * LIMIT_DAMPING) : Real(0);
	for (std::size_t i = 0; i < body.positions.size(); ++i) {
		if (body.inverse_masses[i] == 0) {
			continue;
		}
		const Vec2 q = shape.rest_positions()[i];
		Vec2 &position = body.positions[i];
		Vec2 &velocity = body.velocities[i];
		const Vec2 home = frame.center + excess->now.apply(q);
		const Vec2 shift = excess->shift.apply(q);
		const Vec2 smoothed = (home - position) * smoothing;
		const Vec2 carried = frame.velocity + perpendicular(position - frame.center) * frame.angular_velocity;
		velocity += (carried - velocity) * damped;
		position += shift + smoothed;
		// A constraint's velocity, so that it bears a load; but bounded where a body could burst.
		quicken(velocity, shift, h, bears_load && !excess->is_far ? std::numeric_limits<Real>::max() : walk);
		quicken(velocity, smoothed, h, walk);
	}
	if (std::ranges::find(body.inverse_masses, Real(0)) == body.inverse_masses.end()) {
		restore_rigid_motion(body, frame);
	}
	return true;
}

} // namespace softbody
