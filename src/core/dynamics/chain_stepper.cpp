// SPDX-License-Identifier: MIT
// Carries a chain through a substep.
#include "core/dynamics/chain_stepper.h"

#include "core/base/elementary.h"
#include "core/model/rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// Speed at which a place may creep that friction holds [length/s, times WorldData::length_unit]: a fiftieth of the speed at rest.
constexpr double LEAST_SLIP = 0.001;

// The change of a section two of whose points contacts have changed: as little as gives each of them its own. The environment
// does not yield, so that nothing is owed to it.
Vec2 joined_change(Vec2 a, Vec2 b) {
	const bool is_first = length_squared(a) >= length_squared(b);
	const Vec2 more = is_first ? a : b;
	const Vec2 less = is_first ? b : a;
	const Real size_squared = length_squared(less);
	if (!(size_squared > 0)) {
		return more;
	}
	const Real missing = 1 - dot(more, less) / size_squared;
	return missing > 0 ? more + less * std::min(missing, Real(1)) : more;
}

} // namespace

void ChainStepper::gather(const SoftBodyData &body) {
	const ChainShape &chain = *body.shape().chain();
	const std::span<const Real> m = body.shape().masses();
	const std::span<const Real> w = body.inverse_masses();
	const std::span<const Vec2> x = body.positions();
	const std::span<const Vec2> v = body.velocities();
	const std::size_t n = chain.count();
	x_.resize(n);
	v_.resize(n);
	is_fixed_.resize(n);
	base_ = x[chain.sections()[0].center];
	for (std::size_t i = 0; i < n; ++i) {
		const auto [left, right, center] = chain.sections()[i];
		is_fixed_[i] = char(w[left] == 0 || w[right] == 0 || w[center] == 0);
		if (is_fixed_[i] != 0) {
			const std::uint32_t point = w[center] == 0 ? center : w[left] == 0 ? left : right;
			x_[i] = difference(x[center], base_);
			v_[i] = Vec2d(v[point]);
			continue;
		}
		const double share = 1 / double(chain.masses()[i]);
		x_[i] = (difference(x[left], base_) * double(m[left]) + difference(x[right], base_) * double(m[right]) +
						difference(x[center], base_) * double(m[center])) * share;
		v_[i] = (Vec2d(v[left]) * double(m[left]) + Vec2d(v[right]) * double(m[right]) + Vec2d(v[center]) * double(m[center])) * share;
	}
}

void ChainStepper::gather_forces(const SoftBodyData &body, Vec2 gravity) {
	const ChainShape &chain = *body.shape().chain();
	external_.assign(body.point_count(), Vec2{});
	for (const ExternalForce &external : body.external_forces()) {
		external_[external.point] += external.force;
	}
	if (body.queued_load() != RigidLoad{}) {
		add_rigid_load(body, external_);
	}
	const Vec2 acceleration = body.total_acceleration(gravity);
	forces_.resize(chain.count());
	for (std::size_t i = 0; i < chain.count(); ++i) {
		const auto [left, right, center] = chain.sections()[i];
		forces_[i] = Vec2d(external_[left]) + Vec2d(external_[right]) + Vec2d(external_[center]) + Vec2d(acceleration) * double(chain.masses()[i]);
	}
}

// About the center of mass.
double ChainStepper::spin_of(const SoftBodyData &body) const {
	const std::span<const Real> m = body.shape().masses();
	Vec2d center;
	Vec2d momentum;
	for (std::size_t i = 0; i < m.size(); ++i) {
		center += difference(body.positions()[i], base_) * double(m[i]);
		momentum += Vec2d(body.velocities()[i]) * double(m[i]);
	}
	const double per_mass = 1 / double(body.shape().total_mass());
	double spin = 0;
	for (std::size_t i = 0; i < m.size(); ++i) {
		spin += double(m[i]) * cross(difference(body.positions()[i], base_) - center * per_mass, Vec2d(body.velocities()[i]) - momentum * per_mass);
	}
	return spin;
}

// Forces that act at the end of the substep act along lines that have turned since its start.
void ChainStepper::set_spin(SoftBodyData &body, double spin) const {
	const std::span<const Real> m = body.shape().masses();
	Vec2d center;
	for (std::size_t i = 0; i < m.size(); ++i) {
		center += difference(body.positions()[i], base_) * double(m[i]);
	}
	center = center * (1 / double(body.shape().total_mass()));
	double inertia = 0;
	for (std::size_t i = 0; i < m.size(); ++i) {
		inertia += double(m[i]) * length_squared(difference(body.positions()[i], base_) - center);
	}
	const double turn = inertia > 0 ? (spin - spin_of(body)) / inertia : 0.0;
	for (std::size_t i = 0; i < m.size(); ++i) {
		body.mutable_velocities()[i] += Vec2(perpendicular(difference(body.positions()[i], base_) - center) * turn);
	}
}

void ChainStepper::spread(SoftBodyData &body, bool with_positions) {
	const ChainShape &chain = *body.shape().chain();
	const std::span<const Real> w = body.inverse_masses();
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const std::size_t n = chain.count();
	for (std::size_t i = 0; i < n; ++i) {
		const std::size_t last = i == 0 ? 0 : i - 1;
		const std::size_t next = std::min(i + 1, n - 1);
		// The bisector of both links, which does not depend on their lengths.
		const auto unit = [](Vec2d d) {
			const double size = length(d);
			return size > 0 ? d * (1 / size) : Vec2d{};
		};
		const Vec2d tangent = unit(unit(x_[i] - x_[last]) + unit(x_[next] - x_[i]));
		// A section turns as its links do on average: their ends may be in one place where the chain is folded.
		const auto spin_of_link = [&](std::size_t a, std::size_t b) {
			const double size_squared = length_squared(x_[b] - x_[a]);
			return size_squared > 0 ? cross(x_[b] - x_[a], v_[b] - v_[a]) / size_squared : 0.0;
		};
		const double spin = (spin_of_link(last, last + 1) + spin_of_link(next - 1, next)) / 2;
		const Vec2d offset = perpendicular(tangent) * double(chain.half_widths()[i]);
		const auto [left, right, center] = chain.sections()[i];
		const auto put = [&](std::uint32_t point, Vec2d arm) {
			if (w[point] == 0) {
				return;
			}
			if (with_positions) {
				x[point] = Vec2(Vec2d(base_) + x_[i] + arm);
			}
			v[point] = Vec2(v_[i] + perpendicular(arm) * spin);
		};
		put(left, offset);
		put(right, -offset);
		put(center, {});
	}
}

std::size_t ChainStepper::solve_velocities(const ColliderIndex &surroundings, SoftBodyData &body, Real elapsed, Real h,
		std::span<ChainLoad> loads, double drift_rate, ContactLog &log) {
	gather(body);
	gather_forces(body, surroundings.world().gravity());
	finder_.find(surroundings, body, elapsed, h, contacts_);
	slip_ = LEAST_SLIP * double(surroundings.world().length_unit());
	const ChainSubstep step{ *body.shape().chain(), body.settings(), double(h), slip_, x_, forces_, is_fixed_, loads, contacts_ };
	keeps_spin_ = loads.empty() && !body.has_pins();
	if (keeps_spin_) {
		spin_ = spin_of(body);
		Vec2d center;
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			center += difference(body.positions()[i], base_) * double(body.shape().masses()[i]);
		}
		center = center * (1 / double(body.shape().total_mass()));
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			spin_ += double(h) * cross(difference(body.positions()[i], base_) - center, Vec2d(external_[i]));
		}
	}
	// Air drags each section by itself: a rope sags and swings without moving as a whole.
	const double keep = body.settings().linear_damp > 0 ? exponential(-double(body.settings().linear_damp) * double(h)) : 1.0;
	for (Vec2d &velocity : v_) {
		velocity = velocity * keep;
	}
	spin_ *= keep;
	solver_.solve_velocities(step, v_, drift_rate);
	std::size_t count = 0;
	for (ChainContact &contact : contacts_) {
		if (!contact.presses) {
			continue;
		}
		++count;
		if (body.settings().contact_monitor) {
			contact.source.body = std::uint32_t(&body - surroundings.world().soft_bodies().data());
			contact.source.normal_impulse = Real(contact.normal_impulse);
			log.add(contact.source);
		}
	}
	keeps_spin_ = keeps_spin_ && count == 0;
	spread(body, false);
	return count;
}

void ChainStepper::move(const ColliderIndex &surroundings, SoftBodyData &body, Real elapsed, Real h, std::span<ChainLoad> loads) {
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const std::span<const Real> w = body.inverse_masses();
	if (!loads.empty()) { // between them, others were solved
		gather(body);
		finder_.find(surroundings, body, elapsed, h, contacts_);
		for (ChainContact &contact : contacts_) {
			contact.presses = contact.gap <= 0;
		}
	}
	for (std::size_t i = 0; i < x_.size(); ++i) {
		x_[i] += v_[i] * double(h);
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		if (w[i] == 0) {
			x[i] += v[i] * h; // a pin is at its target, to the bit
		}
	}
	for (ChainLoad &load : loads) {
		load.gap = difference(load.place, base_) - x_[load.section] - load.offset;
	}
	moves_.resize(x_.size());
	const ChainSubstep step{ *body.shape().chain(), body.settings(), double(h), slip_, x_, forces_, is_fixed_, loads, contacts_ };
	if (solver_.close_links(step, moves_)) {
		for (std::size_t i = 0; i < x_.size(); ++i) {
			x_[i] += moves_[i];
		}
	}
	spread(body, true);
	if (keeps_spin_ && loads.empty()) {
		set_spin(body, spin_);
	}
}

void ChainStepper::begin_contacts(const SoftBodyData &body) {
	old_positions_.assign(body.positions().begin(), body.positions().end());
	old_velocities_.assign(body.velocities().begin(), body.velocities().end());
}

// Points stay where contacts have left them: only the next motion, which contacts follow, makes a section square again.
void ChainStepper::take_contacts(SoftBodyData &body) const {
	const ChainShape &chain = *body.shape().chain();
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	for (std::size_t i = 0; i < chain.count(); ++i) {
		if (is_fixed_[i] != 0) {
			continue;
		}
		const auto [left, right, center] = chain.sections()[i];
		const auto change_of = [&, left = left, right = right](std::span<const Vec2> now, const std::vector<Vec2> &old) {
			return joined_change(now[left] - old[left], now[right] - old[right]);
		};
		const Vec2 way = change_of(x, old_positions_);
		const Vec2 faster = change_of(v, old_velocities_);
		for (const std::uint32_t point : { left, right, center }) {
			x[point] = way != Vec2{} ? old_positions_[point] + way : x[point];
			v[point] = faster != Vec2{} ? old_velocities_[point] + faster : v[point];
		}
	}
}

} // namespace softbody
