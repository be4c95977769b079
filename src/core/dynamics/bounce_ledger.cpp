// SPDX-License-Identifier: MIT
// Restitution of bodies as wholes, paid for by the energy that their touches have taken.
#include "core/dynamics/bounce_ledger.h"

#include "core/base/constants.h"
#include "core/collision/pair_bounce.h"
#include "core/dynamics/energy.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace softbody {

namespace {

constexpr std::size_t BODIES_A_TASK = 32;

// Share of the approach of two bodies below which a speed that still misses is not asked for again [1].
constexpr Real LEAST_MISSING = Real(0.02);

// Wobble that a speed costs after the touch, over its energy [1]. At 1, semi-implicit Euler drifts up in a closed box, as what
// is taken out of its wobble is not what its step makes of it. Larger: boxes lose energy.
constexpr double LATE_PRICE = 1.3;

double stored_energy(const SoftBodyData &body) {
	return measure_energy(body, {}).total();
}

Vec2 rigid_velocity(const BodyFrame &frame, Vec2 p) {
	return frame.velocity + perpendicular(p - frame.center) * frame.angular_velocity;
}

double wobble_energy(const SoftBodyData &body, const BodyFrame &frame) {
	double twice = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		if (body.inverse_masses()[i] > 0) {
			twice += double(body.shape().masses()[i]) * length_squared(body.velocities()[i] - rigid_velocity(frame, body.positions()[i]));
		}
	}
	return twice / 2;
}

/// Adds a velocity to the body's free points, and leaves its wobble the share `keep` of its energy.
void change_motion(SoftBodyData &body, const BodyFrame &frame, Vec2 velocity, double keep) {
	const Real of_speed = Real(std::sqrt(std::clamp(keep, 0.0, 1.0)));
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		if (body.inverse_masses()[i] > 0) {
			const Vec2 rigid = rigid_velocity(frame, body.positions()[i]);
			body.mutable_velocities()[i] = rigid + velocity + (body.velocities()[i] - rigid) * of_speed;
		}
	}
}

struct Payment {
	double speed = 0; ///< added to `leaving`
	double from_account = 0;
	double from_wobble = 0;
};

/// The largest speed up to `missing` that can be paid for. A mass that leaves with `leaving` and gets the speed s has m (leaving
/// s + s²/2) more.
Payment payment(double mass, double leaving, double missing, double account, double wobble) {
	const double purse = std::max(account, 0.0);
	const double most = std::sqrt(leaving * leaving + 2 * (purse + wobble) / mass) - std::abs(leaving);
	Payment payment;
	payment.speed = std::min(missing, most);
	const double price = mass * (leaving * payment.speed + payment.speed * payment.speed / 2);
	payment.from_account = std::min(price, purse);
	payment.from_wobble = price - payment.from_account;
	return std::isfinite(price) ? payment : Payment{}; // a body that is about to be reset gets nothing
}

} // namespace

void BounceLedger::begin_step(ActiveBodies &bodies, Vec2 gravity, const ParallelFor &parallel_for) {
	bodies_ = &bodies;
	gravity_ = gravity;
	starts_.resize(bodies.count());
	const std::span<const std::uint32_t> awake = bodies.awake();
	std::size_t size = 0;
	for (const std::uint32_t i : awake) {
		starts_[i].state = size;
		size += 2 * bodies.solver_body(i).positions.size();
	}
	states_.resize(size);
	run_slices(parallel_for, awake.size(), BODIES_A_TASK, [&](std::size_t, std::size_t begin, std::size_t end) {
		for (const std::uint32_t i : awake.subspan(begin, end - begin)) {
			SoftBodyData &body = bodies.data(i);
			Start &start = starts_[i];
			const auto velocities = std::ranges::copy(body.positions(), states_.begin() + std::ptrdiff_t(start.state)).out;
			std::ranges::copy(body.velocities(), velocities);
			start.energy = body.settings().can_dent() ? stored_energy(body) : 0.0; // by its shape before
			start.is_driven = !body.external_forces().empty() || body.queued_load() != RigidLoad{} || !body.pin_targets().empty();
			body.touch_memory().work = 0;
		}
	});
}

void BounceLedger::end_step(std::span<const BodyPair> pairs, std::span<PairTouch> touches, std::span<const BodyPair> joined, Real dt,
		const ParallelFor &parallel_for) {
	form_islands(pairs, touches, joined);
	book(parallel_for);
	pay_bounces();
	pay_pair_bounces(pairs, touches, dt);
	settle(dt);
}

void BounceLedger::form_islands(std::span<const BodyPair> pairs, std::span<const PairTouch> touches, std::span<const BodyPair> joined) {
	islands_.reset(bodies_->count());
	of_.assign(bodies_->count(), {});
	for (const BodyPair pair : joined) {
		islands_.join(pair.a, pair.b);
	}
	for (std::size_t k = 0; k < touches.size(); ++k) {
		if (touches[k].touching || touches[k].ended) {
			islands_.join(pairs[k].a, pairs[k].b);
		}
	}
	const auto add = [](Island &island, const auto &touch, double mass) {
		island.touches |= touch.touching;
		island.asks |= (touch.touching || touch.ended) && touch.approach > 0;
		island.most += touch.touching ? mass * double(touch.approach) * double(touch.approach) / 2 : 0.0;
	};
	for (std::size_t k = 0; k < touches.size(); ++k) {
		const Real inverse_mass = whole_inverse_mass(bodies_->data(pairs[k].a)) + whole_inverse_mass(bodies_->data(pairs[k].b));
		add(island_of(pairs[k].a), touches[k], inverse_mass > 0 ? 1 / double(inverse_mass) : 0.0);
	}
	for (const std::uint32_t i : bodies_->awake()) {
		add(island_of(i), bodies_->data(i).touch_memory(), double(bodies_->data(i).shape().total_mass()));
	}
}

double BounceLedger::loss_of(std::uint32_t active_index) const {
	SoftBodyData &body = bodies_->data(active_index);
	const Start &start = starts_[active_index];
	const std::span<const Vec2> positions = std::span(states_).subspan(start.state, body.point_count());
	const std::span<const Vec2> velocities = std::span(states_).subspan(start.state + body.point_count(), body.point_count());
	const double energy = body.settings().can_dent() ? start.energy : measure_energy(body, positions, velocities, {}).total();
	const Vec2 way = measure_translation(body).center - measure_translation(body, positions, velocities).center;
	const double work = double(body.shape().total_mass()) * double(dot(body.total_acceleration(gravity_), way)) + body.touch_memory().work;
	const double lost = energy + work - stored_energy(body);
	return std::isfinite(lost) ? lost : 0.0;
}

void BounceLedger::book(const ParallelFor &parallel_for) {
	const std::span<const std::uint32_t> awake = bodies_->awake();
	for (const std::uint32_t i : awake) {
		starts_[i].counts = island_of(i).asks && !starts_[i].is_driven;
	}
	losses_.resize(bodies_->count());
	run_slices(parallel_for, awake.size(), BODIES_A_TASK, [&](std::size_t, std::size_t begin, std::size_t end) {
		for (const std::uint32_t i : awake.subspan(begin, end - begin)) {
			losses_[i] = starts_[i].counts ? loss_of(i) : 0.0;
		}
	});
	for (const std::uint32_t i : awake) {
		SoftBodyData &body = bodies_->data(i);
		Island &island = island_of(i);
		island.mass += double(body.shape().total_mass());
		island.account += body.touch_memory().account + losses_[i];
	}
}

void BounceLedger::pay_bounces() {
	for (const std::uint32_t i : bodies_->awake()) {
		SoftBodyData &body = bodies_->data(i);
		TouchMemory &touch = body.touch_memory();
		touch.ended = false;
		if (!(touch.missing > 0)) {
			continue;
		}
		const BodyFrame frame = measure_frame(body);
		const double wobble = wobble_energy(body, frame);
		const double leaving = double(dot(frame.velocity - touch.surface_velocity, touch.normal));
		Island &island = island_of(i);
		const Payment paid = payment(double(body.shape().total_mass()), leaving, double(touch.missing), island.account, wobble);
		island.account -= paid.from_account;
		change_motion(body, frame, touch.normal * Real(paid.speed), wobble > 0 ? 1 - paid.from_wobble / wobble : 1);
		touch.missing = 0;
	}
}

// What strains still hold when two bodies part, their wobble has a little later: a rest is asked for again in the next steps, but of
// the wobble alone. The account of bodies that no longer touch goes up and down with the energy of their method.
void BounceLedger::pay_pair_bounces(std::span<const BodyPair> pairs, std::span<PairTouch> touches, Real dt) {
	const Real keep_missing = std::max(Real(0), 1 - dt / BOUNCE_MEMORY);
	for (std::size_t k = 0; k < touches.size(); ++k) {
		PairTouch &touch = touches[k];
		const bool ends_now = std::exchange(touch.ended, false);
		if (!(touch.missing > 0)) {
			continue;
		}
		const double missing = double(touch.missing);
		touch.missing = 0;
		SoftBodyData &a = bodies_->data(pairs[k].a);
		SoftBodyData &b = bodies_->data(pairs[k].b);
		const BodyFrame frame_a = measure_frame(a);
		const BodyFrame frame_b = measure_frame(b);
		const Vec2 line = frame_a.center - frame_b.center;
		const Real distance = length(line);
		const double inverse_mass = double(whole_inverse_mass(a) + whole_inverse_mass(b));
		if (!(distance > 0) || !(inverse_mass > 0)) {
			continue;
		}
		const Vec2 normal = line * (1 / distance);
		const double leaving = double(dot(frame_a.velocity - frame_b.velocity, normal));
		const double wobble = (a.is_free() ? wobble_energy(a, frame_a) : 0.0) + (b.is_free() ? wobble_energy(b, frame_b) : 0.0);
		Island &island = island_of(pairs[k].a);
		const double price = ends_now ? 1.0 : LATE_PRICE;
		const Payment paid = payment(1 / inverse_mass, leaving, missing, ends_now ? island.account : 0.0, wobble / price);
		island.account -= paid.from_account;
		const Real rest = Real(missing - paid.speed);
		touch.missing = rest > LEAST_MISSING * touch.approach ? rest * keep_missing : Real(0);
		const Vec2 impulse = normal * Real(paid.speed / inverse_mass);
		const double keep = wobble > 0 ? 1 - price * paid.from_wobble / wobble : 1;
		if (a.is_free()) {
			change_motion(a, frame_a, impulse * whole_inverse_mass(a), keep);
		}
		if (b.is_free()) {
			change_motion(b, frame_b, -impulse * whole_inverse_mass(b), keep);
		}
	}
}

// Debts are paid by the wobble of the island. The rest of an account goes on, up to what the touches may ask for; without
// touches it is forgotten over BOUNCE_MEMORY.
void BounceLedger::settle(Real dt) {
	for (const std::uint32_t i : bodies_->awake()) {
		if (Island &island = island_of(i); island.account < 0) {
			island.wobble += wobble_energy(bodies_->data(i), measure_frame(bodies_->data(i)));
		}
	}
	const double keep = std::max(0.0, 1 - double(dt / BOUNCE_MEMORY));
	for (const std::uint32_t i : bodies_->awake()) {
		SoftBodyData &body = bodies_->data(i);
		const Island &island = island_of(i);
		double account = island.account;
		if (account < 0 && island.wobble > 0 && std::isfinite(island.wobble)) {
			const double paid = std::min(-account, island.wobble);
			change_motion(body, measure_frame(body), {}, 1 - paid / island.wobble);
			account += paid;
		} else if (account > 0) {
			account = island.touches ? std::min(account, island.most) : account * keep;
		}
		body.touch_memory().account = account * double(body.shape().total_mass()) / island.mass;
	}
}

} // namespace softbody
