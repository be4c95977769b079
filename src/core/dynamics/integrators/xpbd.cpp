// SPDX-License-Identifier: MIT
// Extended position-based dynamics: every elastic term as a compliant constraint, springs one way and back a substep.
#include "core/dynamics/integrators/integrator_step.h"

#include "core/base/constants.h"
#include "core/dynamics/elastic_lanes.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/forces_lanes.h"
#include "core/dynamics/pressure_lanes.h"
#include "core/dynamics/triangle_lanes.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// One spring as the constraint C = |d| - l with compliance 1/k and damping c (Macklin, Müller, Chentanez 2016, eq. 18
// and 26). Multiplied through with k h² and c h, so that k = 0 and c = 0 need no special case, a visit adds
//   Δλ = -(k h² C + c h ∇C·(x - x_before) + λ) / (1 + (k h² + c h) (w_a + w_b)).
// The denominator exceeds the numerator's gain for every k, c and h: one spring alone is always stable. Many springs at
// once are not, see balance_energy.
//
// A sweep over the springs one way answers a pull on point i at point j otherwise than one on j at i. Its forces have a
// curl: they add energy to a wobble, and turn a disc that lies on the ground. A sweep one way and one back, which goes on
// from the impulses -λ and keeps the directions ∇C, answers both alike.
void solve_springs(const SoftBodyData &body, std::span<const Vec2> before, Real h, std::span<Vec2> x, std::vector<SpringVisit> &visits) {
	visits.clear();
	if (!body.settings().has_springs()) {
		return;
	}
	const Real stiffness = body.settings().spring_stiffness_scale;
	const Real damping = body.settings().spring_damping_scale;
	const std::span<const Real> w = body.inverse_masses();
	for (const Spring2D &spring : body.shape().springs()) {
		const Vec2 d = x[spring.b] - x[spring.a];
		const Real current = length(d);
		if (!(current > DEGENERATE_LENGTH * spring.rest_length)) {
			visits.push_back({});
			continue;
		}
		const Vec2 e = d * (1 / current);
		const Real elastic = spring.stiffness * stiffness * h * h;
		const Real viscous = spring.damping * damping * h;
		const Real way = dot(e, (x[spring.b] - before[spring.b]) - (x[spring.a] - before[spring.a]));
		const Real share = 1 / (1 + (elastic + viscous) * (w[spring.a] + w[spring.b]));
		const Real impulse = (elastic * (current - spring.rest_length) + viscous * way) * share;
		visits.push_back({ e, elastic, viscous, share, impulse });
		x[spring.a] += e * (impulse * w[spring.a]);
		x[spring.b] -= e * (impulse * w[spring.b]);
	}
}

void solve_springs_back(const SoftBodyData &body, std::span<const Vec2> before, std::span<Vec2> x, std::span<const SpringVisit> visits) {
	const std::span<const Spring2D> springs = body.shape().springs();
	const std::span<const Real> w = body.inverse_masses();
	for (std::size_t i = visits.size(); i-- > 0;) {
		const Spring2D &spring = springs[i];
		const SpringVisit &visit = visits[i];
		const Vec2 d = x[spring.b] - x[spring.a];
		const Real way = dot(visit.direction, d - (before[spring.b] - before[spring.a]));
		const Real stretch = dot(visit.direction, d) - spring.rest_length;
		const Real change = (visit.elastic * stretch + visit.viscous * way - visit.impulse) * visit.share;
		x[spring.a] += visit.direction * (change * w[spring.a]);
		x[spring.b] -= visit.direction * (change * w[spring.b]);
	}
}

// The area as the constraint C = A - s A0 of compliance A0/k_p.
void solve_pressure(const SoftBodyData &body, Real h, std::span<Vec2> x, std::span<Vec2> gradient) {
	const SoftBodyShape &shape = body.shape();
	const std::span<const Real> w = body.inverse_masses();
	const std::span<const Vec2> hull = x.first(shape.hull_count());
	Real inverse_mass = 0;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		gradient[i] = area_derivative<Real>(hull, i);
		inverse_mass += w[i] * length_squared(gradient[i]);
	}
	const Real elastic = body.settings().pressure_stiffness / shape.rest_area() * h * h;
	const Real excess = hull_area<Real>(hull) - body.settings().inflation * shape.rest_area();
	const Real impulse = -elastic * excess / (1 + elastic * inverse_mass);
	for (std::size_t i = 0; i < shape.hull_count(); ++i) {
		x[i] += gradient[i] * (impulse * w[i]);
	}
}

// Shape matching by an implicit step of each point towards its goal, with damping relative to the rigid part of the
// motion. Goals and rigid motion are those of the predicted positions, and the weights are masses, so the corrections
// sum to zero momentum and spin, up to rounding.
void solve_shape(SoftBodyData &body, std::span<const Vec2> before, Real h, std::span<Vec2> x, std::span<Vec2> velocities) {
	const SoftBodyShape &shape = body.shape();
	for (std::size_t i = 0; i < x.size(); ++i) {
		velocities[i] = (x[i] - before[i]) * (1 / h);
	}
	const BodyFrame frame = measure_frame(body, x, velocities);
	const Real per_mass = Real(shape.point_count()) / shape.total_mass();
	const Real elastic = body.settings().shape_stiffness * per_mass * h * h;
	const Real viscous = body.settings().shape_damping * per_mass * h;
	const Real share = 1 / (1 + elastic + viscous);
	for (std::size_t i = 0; i < x.size(); ++i) {
		if (body.inverse_masses()[i] == 0) {
			continue;
		}
		const Vec2 arm = x[i] - frame.center;
		const Vec2 strain = frame.rotation.apply(shape.rest_positions()[i]) - arm;
		const Vec2 drift = frame.velocity + perpendicular(arm) * frame.angular_velocity - velocities[i];
		x[i] += (strain * elastic + drift * (viscous * h)) * share;
	}
}

// Elastic modes, and deformation in no mode, by an implicit step of each. They are independent oscillators, so this is
// exact for all at once, except for the turn of the body within the substep.
void solve_modes(const SoftBodyData &body, std::span<const Vec2> before, Real h, std::span<Vec2> x, std::span<Vec2> scratch) {
	const SoftBodyShape &shape = body.shape();
	const ElasticModes &modes = *shape.modes();
	const ModeStiffness<Real> stiffness = mode_stiffness(modes, body.settings());
	const Real damping = body.settings().elastic_damping_time;
	for (std::size_t i = 0; i < x.size(); ++i) {
		scratch[i] = (x[i] - before[i]) * (1 / h);
	}
	const BodyFrame frame = measure_frame(body, x, scratch);
	const Real per_mass = 1 / shape.total_mass();
	const auto share_of = [&](Real k) {
		const Real elastic = k * per_mass * h * h;
		return elastic / (1 + elastic + k * per_mass * damping * h);
	};
	std::array<Real, MAX_ELASTIC_MODES> amplitudes{};
	Real dilation = 0;
	for (std::size_t i = 0; i < x.size(); ++i) {
		const Vec2 arm = x[i] - frame.center;
		const Vec2 drift = scratch[i] - frame.velocity - perpendicular(arm) * frame.angular_velocity;
		scratch[i] = frame.rotation.apply_inverse(arm + drift * damping) - shape.rest_positions()[i];
		const std::span<const Vec2> mode = modes.shape_of_point(i);
		for (std::size_t j = 0; j < mode.size(); ++j) {
			amplitudes[j] += dot(mode[j], scratch[i]);
		}
		dilation += i < shape.hull_count() ? dot(modes.dilation[i], scratch[i]) : Real(0);
	}
	const Real rest = share_of(stiffness.rest);
	for (std::size_t j = 0; j < modes.count; ++j) {
		amplitudes[j] = (amplitudes[j] - dilation * modes.dilation_overlap[j]) * (share_of(stiffness.modes[j]) - rest);
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		if (body.inverse_masses()[i] == 0) {
			continue;
		}
		Vec2 back = (scratch[i] - shape.rest_positions()[i] * dilation) * rest;
		const Real per_share = shape.total_mass() * shape.inverse_masses()[i];
		const std::span<const Vec2> mode = modes.shape_of_point(i);
		for (std::size_t j = 0; j < mode.size(); ++j) {
			back += mode[j] * (amplitudes[j] * per_share);
		}
		x[i] -= frame.rotation.apply(back);
	}
}

// The shear of a triangle as two constraints u = 0 and v = 0 of compliance 1/(μ A0), see triangle_lanes.h. They are
// linear, and their gradients are orthogonal and of one length at each corner, so both have one effective mass and are
// solved at once.
void solve_shear(const ElasticTriangle &triangle, const SoftBodyData &body, std::span<const Vec2> before, Real h, std::span<Vec2> x) {
	const std::span<const Real> w = body.inverse_masses();
	const auto [a, b, c] = triangle.corners;
	const auto [g1, g2] = triangle.gradients;
	const Vec2 e1 = x[b] - x[a];
	const Vec2 e2 = x[c] - x[a];
	const TriangleShear<Real> shear = triangle_shear<Real>(triangle, e1, e2);
	const TriangleShear<Real> way = triangle_shear<Real>(triangle, e1 - (before[b] - before[a]), e2 - (before[c] - before[a]));
	const Real elastic = body.settings().shear_modulus * triangle.area * h * h;
	const Real viscous = body.settings().shear_modulus * triangle.area * body.settings().elastic_damping_time * h;
	const Real inverse_mass = w[a] * length_squared(g1 + g2) + w[b] * length_squared(g1) + w[c] * length_squared(g2);
	const Real share = 1 / (1 + (elastic + viscous) * inverse_mass);
	const TriangleShear<Real> impulse = { (elastic * shear.u + viscous * way.u) * share, (elastic * shear.v + viscous * way.v) * share };
	const Vec2 on_b = shear_derivative<Real>(impulse, g1);
	const Vec2 on_c = shear_derivative<Real>(impulse, g2);
	x[a] += (on_b + on_c) * w[a];
	x[b] -= on_b * w[b];
	x[c] -= on_c * w[c];
}

// The area of a triangle as the constraint C of compliance 1/(K A0) where h is quadratic; beyond, by its pressure.
void solve_dilation(const ElasticTriangle &triangle, const SoftBodyData &body, Real h, std::span<Vec2> x) {
	const BodySettings &settings = body.settings();
	const std::span<const Real> w = body.inverse_masses();
	const auto [a, b, c] = triangle.corners;
	const Vec2 e1 = x[b] - x[a];
	const Vec2 e2 = x[c] - x[a];
	const Real ratio = cross(e1, e2) / (2 * triangle.area);
	const TriangleShear<Real> shear = triangle_shear<Real>(triangle, e1, e2);
	const TriangleDilation<Real> dilation = triangle_dilation<Real>(settings.inflation, coefficients_of<Real>(settings), ratio, shear);
	// As in the forces: a corner's part of K h(C) A0 by J and by u² + v².
	const TriangleShear<Real> stress = { -shear.u * dilation.softening * triangle.area, -shear.v * dilation.softening * triangle.area };
	const Vec2 on_b = shear_derivative<Real>(stress, triangle.gradients[0]) - perpendicular(e2) * (dilation.pressure / 2);
	const Vec2 on_c = shear_derivative<Real>(stress, triangle.gradients[1]) + perpendicular(e1) * (dilation.pressure / 2);
	const Real inverse_mass = w[a] * length_squared(on_b + on_c) + w[b] * length_squared(on_b) + w[c] * length_squared(on_c);
	// These are K A0 h'(C) ∂C/∂x; the constraint's gradient lacks the factor K A0 h'(C).
	const Real scale = settings.area_stiffness * triangle.area * dilation.slope * dilation.slope;
	const Real share = scale > 0 ? h * h / (1 + h * h * inverse_mass / scale) : Real(0);
	x[a] += (on_b + on_c) * (share * w[a]);
	x[b] -= on_b * (share * w[b]);
	x[c] -= on_c * (share * w[c]);
}

void solve_triangles(const SoftBodyData &body, std::span<const Vec2> before, Real h, std::span<Vec2> x) {
	for (const ElasticTriangle &triangle : body.shape().triangles()->triangles) {
		solve_shear(triangle, body, before, h, x);
		solve_dilation(triangle, body, h, x);
	}
}

// One pass over many constraints that pull one way can add more speed than their energy pays for: each is solved as if
// the others had not just moved the point. The excess over `allowed` is taken from the motion relative to the rigid
// one. Where the new shape alone exceeds it (a constraint overshot along its curved path), the deformation of this
// substep is halved until it does not. Momentum stays, and spin to first order in h. See docs/decisions/xpbd.md.
void balance_energy(SoftBodyData &body, double allowed, const SubstepInput &input, std::span<const Vec2> before) {
	constexpr int HALVINGS = 24;
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	for (int attempt = 0;; ++attempt) {
		const double excess = measure_energy(body, input.gravity).total() - allowed;
		if (!(excess > 0)) {
			return;
		}
		// The way of the rigid motion over h, as a rotation: along its tangent a fast spin would stretch the body.
		const BodyFrame frame = measure_frame(body, before, v);
		const Rotation turn = Rotation::from_angle(frame.angular_velocity * input.h);
		const auto rigid = [&](std::size_t i) {
			const Vec2 arm = before[i] - frame.center;
			return frame.velocity + (turn.apply(arm) - arm) * (1 / input.h);
		};
		double relative = 0;
		for (std::size_t i = 0; i < v.size(); ++i) {
			relative += double(body.shape().masses()[i]) * length_squared(v[i] - rigid(i)) / 2;
		}
		const bool is_speed_enough = excess <= relative || attempt == HALVINGS;
		const Real keep =
				is_speed_enough ? Real(std::sqrt(std::max(0.0, 1 - excess / std::max(relative, 1e-300)))) : Real(0.5);
		for (std::size_t i = 0; i < v.size(); ++i) {
			if (body.inverse_masses()[i] == 0) {
				continue;
			}
			v[i] = rigid(i) + (v[i] - rigid(i)) * keep;
			if (!is_speed_enough) {
				x[i] = before[i] + v[i] * input.h;
			}
		}
		if (is_speed_enough) {
			return;
		}
	}
}

// Work of moving pins on the body within the substep: against the forces at its start and at its end, each for half of
// the way. Without it balance_energy would hold a body back from its pins. `forces` is overwritten.
double work_of_pins(const SoftBodyData &body, std::span<const Vec2> before, std::span<const Vec2> x, std::span<const Vec2> v,
		std::span<Vec2> forces) {
	double work = 0;
	for (const std::span<const Vec2> positions : { before, x }) {
		evaluate_forces<Real>(model_of(body), {}, {}, positions, v, forces);
		for (std::size_t i = 0; i < x.size(); ++i) {
			if (body.inverse_masses()[i] == 0) {
				work -= double(dot(forces[i], x[i] - before[i])) / 2;
			}
		}
	}
	return work;
}

// The rigid motion, which a substep without contacts can change only through external loads.
struct RigidMotion {
	Vec2 center;
	Vec2 velocity;
	double spin = 0; // angular momentum about the center
	double inertia = 0;
};

RigidMotion rigid_motion_of(const SoftBodyData &body) {
	const std::span<const Vec2> x = body.positions();
	const std::span<const Vec2> v = body.velocities();
	const std::span<const Real> m = body.shape().masses();
	const Vec2 base = x[0]; // sums relative to a point of the body keep digits far from the origin
	const Vec2 base_velocity = v[0];
	RigidMotion motion;
	for (std::size_t i = 0; i < x.size(); ++i) {
		motion.center += (x[i] - base) * m[i];
		motion.velocity += (v[i] - base_velocity) * m[i];
	}
	motion.center = base + motion.center * (1 / body.shape().total_mass());
	motion.velocity = base_velocity + motion.velocity * (1 / body.shape().total_mass());
	for (std::size_t i = 0; i < x.size(); ++i) {
		const Vec2 arm = x[i] - motion.center;
		motion.spin += double(m[i]) * cross(arm, v[i] - motion.velocity);
		motion.inertia += double(m[i]) * length_squared(arm);
	}
	return motion;
}

// Each correction acts along a line between two points as they are by then, moved by earlier corrections: momentum is
// kept, spin is not. And while the sum of momentum is kept, the last digit of a position over h is a speed. The missing
// momentum and spin are restored as a rigid motion. See docs/decisions/xpbd.md.
void restore_rigid_motion(SoftBodyData &body, const RigidMotion &wanted) {
	const RigidMotion found = rigid_motion_of(body);
	const Vec2 push = wanted.velocity - found.velocity;
	// Points that coincide cannot make up for spin by turning.
	const bool can_turn = found.inertia > DEGENERATE_LENGTH * body.shape().rest_inertia();
	const auto turn = Real(can_turn ? (wanted.spin - found.spin) / found.inertia : 0.0);
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		body.mutable_velocities()[i] += push + perpendicular(body.positions()[i] - found.center) * turn;
	}
}

} // namespace

// Predict, correct, and let the corrections change the velocity, at the share θ of the substep; from there the motion
// goes on as it is, and so does the change of velocity (the θ method). Springs take one pass one way and back, other terms
// one between them: many small substeps are better than few with many passes (Macklin et al. 2019).
void step_xpbd(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace) {
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const std::span<const Real> w = body.inverse_masses();
	const std::span<const Real> m = body.shape().masses();
	const std::span<Vec2> before(workspace.stage_positions.data(), x.size());
	const std::span<Vec2> predicted(workspace.stage_velocities.data(), x.size());
	const std::span<Vec2> scratch(workspace.forces.data(), x.size());
	const Vec2 acceleration = input.gravity * body.settings().gravity_scale;
	// Relative to a point of the body: far from the origin, the effect of springs in a substep is smaller than the
	// distance between two floats, and would be lost as a change of a position.
	const Vec2 base = is_finite(x[0]) ? x[0] : Vec2{};
	const std::span<Vec2> places(workspace.position_slopes.data(), x.size());
	for (std::size_t i = 0; i < x.size(); ++i) {
		places[i] = x[i];
		x[i] -= base;
	}
	double allowed = measure_energy(body, input.gravity).total();
	const bool is_free = std::ranges::find(w, Real(0)) == w.end(); // pins absorb any momentum
	RigidMotion rigid = rigid_motion_of(body);
	rigid.velocity += acceleration * input.h;
	const Real part = input.h * input.implicit_share;
	const std::span<Vec2> start(workspace.velocity_slopes.data(), x.size());
	for (std::size_t i = 0; i < x.size(); ++i) {
		before[i] = x[i];
		start[i] = v[i];
		v[i] += (acceleration * m[i] + input.external[i]) * (w[i] * part);
		x[i] += v[i] * part;
		predicted[i] = x[i];
	}
	solve_springs(body, before, part, x, workspace.spring_visits);
	if (body.settings().pressure_stiffness > 0) {
		solve_pressure(body, part, x, scratch);
	}
	if (body.settings().matches_shape()) {
		solve_shape(body, before, part, x, scratch);
	}
	solve_springs_back(body, before, x, workspace.spring_visits);
	if (body.settings().is_elastic() && body.shape().modes() != nullptr) {
		solve_modes(body, before, part, x, scratch);
	}
	if (has_triangles(body.shape(), body.settings())) {
		solve_triangles(body, before, part, x);
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		// Not (x - before)/h: at small h that is the magnified rounding of x, even without corrections.
		v[i] += (x[i] - predicted[i]) * (1 / part);
		x[i] = before[i] + v[i] * input.h;
		v[i] = start[i] + (v[i] - start[i]) * (1 / input.implicit_share);
		allowed += dot(input.external[i], x[i] - before[i]);
		rigid.velocity += input.external[i] * (input.h / body.shape().total_mass());
		rigid.spin += double(input.h) * cross(before[i] - rigid.center, input.external[i]);
	}
	bool is_driven = false;
	for (std::size_t i = 0; !is_free && i < x.size(); ++i) {
		is_driven |= w[i] == 0 && v[i] != Vec2{};
	}
	if (is_driven) {
		const std::span<Vec2> forces(workspace.velocity_slopes.data(), x.size());
		allowed += work_of_pins(body, before, x, v, forces);
	}
	balance_energy(body, allowed, input, before);
	if (is_free) {
		restore_rigid_motion(body, rigid);
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] = w[i] == 0 ? places[i] + v[i] * input.h : x[i] + base; // a pin is at its target, to the bit
	}
}

} // namespace softbody
