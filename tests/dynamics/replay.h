// SPDX-License-Identifier: MIT
// The equations of motion a second time: complex numbers in double, straight from the formulas.
#pragma once

#include "core/model/soft_body_data.h"
#include "support/random.h"

#include <complex>
#include <vector>

namespace softbody::testing {

using Complex = std::complex<double>; ///< x + iy: turning by an angle is one product

inline Complex to_complex(Vec2 a) {
	return { double(a.x), double(a.y) };
}

inline Vec2 to_vec2(Complex z) {
	return { Real(z.real()), Real(z.imag()) };
}

inline double scalar_product(Complex a, Complex b) {
	return std::real(std::conj(a) * b);
}

/// Positions and velocities of a body's points.
struct ReplayState {
	std::vector<Complex> z;
	std::vector<Complex> w;

	explicit ReplayState(const SoftBodyData &body) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			z.push_back(to_complex(body.positions()[i]));
			w.push_back(to_complex(body.velocities()[i]));
		}
	}
};

/// Best-fitting rigid motion of the state.
struct ReplayFrame {
	Complex center, velocity, rotation;
	double spin = 0;

	ReplayFrame(const SoftBodyShape &shape, const ReplayState &state) {
		double mass = 0;
		for (std::size_t i = 0; i < state.z.size(); ++i) {
			mass += double(shape.masses()[i]);
			center += double(shape.masses()[i]) * state.z[i];
			velocity += double(shape.masses()[i]) * state.w[i];
		}
		center /= mass;
		velocity /= mass;
		Complex moment;
		double angular_momentum = 0;
		double inertia = 0;
		for (std::size_t i = 0; i < state.z.size(); ++i) {
			const Complex arm = state.z[i] - center;
			moment += double(shape.masses()[i]) * std::conj(to_complex(shape.rest_positions()[i])) * arm;
			angular_momentum += double(shape.masses()[i]) * std::imag(std::conj(arm) * (state.w[i] - velocity));
			inertia += double(shape.masses()[i]) * std::norm(arm);
		}
		rotation = moment / std::abs(moment);
		spin = angular_momentum / inertia;
	}
};

/// Energy of springs and shape matching.
inline double replay_potential(const SoftBodyData &body, const ReplayState &state) {
	const SoftBodyShape &shape = body.shape();
	double energy = 0;
	for (const Spring2D &spring : shape.springs()) {
		const double stretch = std::abs(state.z[spring.b] - state.z[spring.a]) - double(spring.rest_length);
		energy += double(spring.stiffness) * stretch * stretch / 2;
	}
	const ReplayFrame frame(shape, state);
	const double mean_mass = double(shape.total_mass()) / double(shape.point_count());
	for (std::size_t i = 0; i < state.z.size(); ++i) {
		const Complex goal = frame.center + frame.rotation * to_complex(shape.rest_positions()[i]);
		energy += double(shape.masses()[i]) / mean_mass * double(body.settings().shape_stiffness) * std::norm(state.z[i] - goal) / 2;
	}
	return energy;
}

/// Forces of springs, shape matching and gravity.
inline std::vector<Complex> replay_forces(const SoftBodyData &body, Complex gravity, const ReplayState &state) {
	const SoftBodyShape &shape = body.shape();
	std::vector<Complex> forces(state.z.size());
	const ReplayFrame frame(shape, state);
	const double mean_mass = double(shape.total_mass()) / double(shape.point_count());
	for (std::size_t i = 0; i < state.z.size(); ++i) {
		const double mass = shape.masses()[i];
		const Complex goal = frame.center + frame.rotation * to_complex(shape.rest_positions()[i]);
		const Complex rigid = frame.velocity + Complex(0, frame.spin) * (state.z[i] - frame.center);
		forces[i] = mass * gravity * double(body.settings().gravity_scale);
		forces[i] += mass / mean_mass * double(body.settings().shape_stiffness) * (goal - state.z[i]);
		forces[i] += mass / mean_mass * double(body.settings().shape_damping) * (rigid - state.w[i]);
	}
	for (const Spring2D &spring : shape.springs()) {
		const Complex d = state.z[spring.b] - state.z[spring.a];
		const Complex e = d / std::abs(d);
		const double tension = double(spring.stiffness) * (std::abs(d) - double(spring.rest_length)) +
				double(spring.damping) * scalar_product(e, state.w[spring.b] - state.w[spring.a]);
		forces[spring.a] += tension * e;
		forces[spring.b] -= tension * e;
	}
	return forces;
}

/// The thesis body's points with random masses, springs, settings, and a random state about `place`
/// that is deformed by up to `size` and moves with up to `speed`.
inline SoftBodyData random_body(Random &random, const SoftBodyShape &model, double size, double speed, Vec2 place = {}) {
	SoftBodyShape::Description description;
	description.points.assign(model.rest_positions().begin(), model.rest_positions().end());
	description.hull_count = model.hull_count();
	for (std::size_t i = 0; i < model.point_count(); ++i) {
		description.masses.push_back(random.real(0.2, 2));
	}
	for (Spring2D spring : model.springs()) {
		spring.stiffness = random.real(10, 200);
		spring.damping = random.real(0, 5);
		description.springs.push_back(spring);
	}
	BodySettings settings;
	settings.shape_stiffness = random.real(10, 100);
	settings.shape_damping = random.real(1, 5);
	settings.gravity_scale = random.real(-2, 2);
	SoftBodyData body = SoftBodyData::create(SoftBodyShape::create(description).value(), settings, Pose{ place, Rotation::from_angle(random.real(-3, 3)) }).value();
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 shift = random.vector(size);
		body.set_point(i, body.positions()[i] + shift, random.vector(speed));
	}
	return body;
}

} // namespace softbody::testing
