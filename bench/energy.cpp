// SPDX-License-Identifier: MIT
// What each integrator does to the energy of a wobbling body over a minute.
#include "bench.h"
#include "bodies.h"

#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "scenes/integrator_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Integrator;
using softbody::Real;
using softbody::Vec2;

constexpr std::array<Integrator, 7> INTEGRATORS = { Integrator::EXPLICIT_EULER, Integrator::SEMI_IMPLICIT_EULER,
	Integrator::MIDPOINT, Integrator::HEUN, Integrator::RUNGE_KUTTA_4, Integrator::VELOCITY_VERLET, Integrator::XPBD };

constexpr int SAMPLES = 120;
constexpr double BLOW_UP = 100; // E/E0 past which no game could go on; what follows is not simulated
constexpr double DAMPING_RATIO = 0.05;

// The thesis's body, drawn out along x and in along y by a tenth, let go at rest.
softbody::SoftBodyData wobbling_body(double stiffness, bool damped, Integrator integrator) {
	const Shape shape = circle_shape(8, true, stiffness, damped ? DAMPING_RATIO : 0);
	softbody::BodySettings settings;
	settings.integrator = integrator;
	settings.substeps = 1;
	Points points(shape->rest_positions().begin(), shape->rest_positions().end());
	for (Vec2 &p : points) {
		p = { p.x * Real(1.1), p.y * Real(0.9) };
	}
	return body_at(shape, settings, points);
}

// One run. The series holds the mean of E/E0 between two samples: a symplectic method's energy swings within each
// oscillation, and single values of it would show where in the swing the sample fell.
json run(Integrator integrator, bool damped, double stiffness, int rate, int seconds) {
	softbody::WorldData world;
	world.set_sleeping(false); // however small the motion
	softbody::Simulator simulator(world);
	world.add_soft_body(wobbling_body(stiffness, damped, integrator));
	const softbody::SoftBodyData &body = world.soft_bodies()[0];
	const double start = softbody::measure_energy(body, {}).total();
	const int steps = rate * seconds;
	json series = json::array({ json::array({ 0, 1 }) });
	bool blown_up = false;
	double highest = 1;
	double sum = 0;
	int summed = 0;
	int next = 1;
	for (int i = 1; i <= steps && !blown_up; ++i) {
		const bool reset = !simulator.simulate(Real(1) / Real(rate)).reset_bodies.empty();
		const double energy = softbody::measure_energy(body, {}).total() / start;
		blown_up = reset || !(energy <= BLOW_UP);
		if (blown_up) {
			series.push_back({ double(i) / rate, BLOW_UP });
			break;
		}
		highest = std::max(highest, energy);
		sum += energy;
		summed++;
		if (i == long(next) * steps / (SAMPLES - 1)) {
			series.push_back({ double(i) / rate, sum / summed });
			sum = 0;
			summed = 0;
			next++;
		}
	}
	return { { "integrator", softbody::integrator_facts(integrator).name }, { "damped", damped }, { "dt", 1.0 / rate },
		{ "k", stiffness }, { "series", series }, { "highest", highest }, { "blown_up", blown_up } };
}

} // namespace

json energy(const Options &options) {
	const int seconds = options.quick ? 20 : 60;
	const std::vector<int> rates = options.quick ? std::vector{ 60, 240 } : std::vector{ 60, 120, 240, 480, 960 };
	json result = { { "seconds", seconds }, { "damping_ratio", DAMPING_RATIO }, { "blow_up", BLOW_UP },
		{ "runs", json::array() } };
	for (const double stiffness : { 100.0, 1000.0 }) {
		for (const bool damped : { false, true }) {
			for (const int rate : rates) {
				for (const Integrator integrator : INTEGRATORS) {
					result["runs"].push_back(run(integrator, damped, stiffness, rate, seconds));
				}
			}
		}
	}
	return result;
}

} // namespace bench
