// SPDX-License-Identifier: MIT
// Where theory says that a method of the thesis fails, it does, and as fast as theory says.
#include "scenes/stress/bodies.h"

#include "core/dynamics/integrators/integrator_step.h"

#include <complex>

namespace softbody::testing {

namespace {

// Growth of the amplitude in one substep of the undamped oscillator with z = hω: the largest root of the method's
// characteristic polynomial, written down from its formulas.
double growth(Integrator method, double z) {
	using Complex = std::complex<double>;
	const Complex w(0, z);
	switch (method) {
		case Integrator::EXPLICIT_EULER: return std::abs(1.0 + w);
		case Integrator::MIDPOINT:
		case Integrator::HEUN: return std::abs(1.0 + w + w * w / 2.0);
		case Integrator::RUNGE_KUTTA_4: return std::abs(1.0 + w + w * w / 2.0 + w * w * w / 6.0 + w * w * w * w / 24.0);
		case Integrator::AUTOMATIC: // chooses one that is stable
		case Integrator::XPBD: return 1; // for every step
		case Integrator::SEMI_IMPLICIT_EULER:
		case Integrator::VELOCITY_VERLET: break;
	}
	// Both: λ² - (2 - z²) λ + 1 = 0.
	const double half_trace = 1 - z * z / 2;
	return std::abs(half_trace) <= 1 ? 1 : std::abs(half_trace) + std::sqrt(half_trace * half_trace - 1);
}

// One spring between two masses, swinging along its line, in one substep a tick, at a given hω.
StressScene undamped_spring(const StressSetup &setup, double z) {
	StressScene scene(scene_name("theory/undamped_spring_h_omega", z), weightless_world());
	const double omega = z * setup.rate;
	SoftBodyShape::Description description;
	description.points = { { -50, 0 }, { 0, -50 }, { 50, 0 }, { 0, 50 } };
	description.masses = { 1, 1, 1, 1 };
	description.hull_count = 4;
	description.springs = { { 0, 2, 100, Real(omega * omega / 2), 0 } };
	BodySettings settings;
	settings.integrator = setup.integrator;
	settings.substeps = setup.integrator == Integrator::AUTOMATIC ? 0 : 1;
	SoftBodyData body = SoftBodyData::create(SoftBodyShape::create(description).value(), settings).value();
	body.set_point(0, { Real(-50.5), 0 }, {});
	body.set_point(2, { Real(50.5), 0 }, {});
	scene.world.add_soft_body(std::move(body));
	scene.world.set_sleeping(false);
	const double each = growth(setup.integrator, z);
	// As long as the amplitude may grow to a hundredfold, which is the spring's own length and the end of its theory.
	const double ticks = each > 1 + 1e-9 ? std::min(600.0, std::floor(std::log(100) / std::log(each))) : 600;
	const double predicted = std::max(1.0, std::pow(each, ticks)); // the most that is seen is at least the start
	scene.seconds = ticks / setup.rate;
	scene.is_violent = false;
	scene.judge = [predicted](const WorldData &, const StressLog &log, StressVerdict &verdict) {
		const double grown = std::sqrt(log.most_energy / log.start_energy);
		if (predicted > 1.5) {
			verdict.at_least("growth of the amplitude, over what theory predicts", grown / predicted, 0.3);
		} else {
			// Methods that conserve do so up to a factor of the swing that they conserve; at hω = 1.5 it is 1 / (1 - z/2).
			verdict.at_most("growth of the amplitude, over what theory predicts", grown / predicted, 4);
		}
	};
	return scene;
}

} // namespace

std::vector<StressScene> theory_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	for (const double z : { 0.2, 0.8, 1.5, 2.2, 3.0 }) {
		scenes.push_back(undamped_spring(setup, z));
	}
	return scenes;
}

} // namespace softbody::testing
