// SPDX-License-Identifier: MIT
// How fast each integrator lets an oscillator grow, measured in the simulator and set against theory.
#include "bench.h"
#include "bodies.h"

#include "core/base/constants.h"
#include "core/dynamics/simulator.h"
#include "scenes/integrator_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Integrator;
using softbody::Real;
using softbody::Vec2;

constexpr std::array<Integrator, 7> INTEGRATORS = { Integrator::EXPLICIT_EULER, Integrator::SEMI_IMPLICIT_EULER,
	Integrator::MIDPOINT, Integrator::HEUN, Integrator::RUNGE_KUTTA_4, Integrator::VELOCITY_VERLET, Integrator::XPBD };

// One step of a linear method on x'' = -ω²x - 2ζωx', in the state (x, hx', h²x''). All but Verlet carry only the
// first two; their third column is 0.
using Matrix = std::array<std::array<double, 3>, 3>;

Matrix identity() {
	return { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
}

Matrix product(const Matrix &a, const Matrix &b) {
	Matrix result{};
	for (std::size_t i = 0; i < 3; ++i) {
		for (std::size_t j = 0; j < 3; ++j) {
			for (std::size_t k = 0; k < 3; ++k) {
				result[i][j] += a[i][k] * b[k][j];
			}
		}
	}
	return result;
}

// Taylor polynomial of exp(h·d/dt) up to `order`: what every Runge-Kutta method of that order and as many stages does
// to a linear equation.
Matrix taylor(double z, double d, int order) {
	const Matrix slope = { { { 0, 1, 0 }, { -z * z, -d, 0 }, { 0, 0, 0 } } };
	Matrix result = identity();
	result[2][2] = 0;
	Matrix term = result;
	for (int i = 1; i <= order; ++i) {
		term = product(term, slope);
		for (std::size_t row = 0; row < 3; ++row) {
			for (std::size_t column = 0; column < 3; ++column) {
				term[row][column] /= i;
				result[row][column] += term[row][column];
			}
		}
	}
	return result;
}

// With z = hω and d = 2ζhω, written down from the formulas of each method, not from the core's code.
Matrix amplification(Integrator integrator, double z, double zeta) {
	const double d = 2 * zeta * z;
	const double q = 1 + z * z + d;
	switch (integrator) {
		case Integrator::SEMI_IMPLICIT_EULER: // y' = y - z²x - dy, x' = x + y'
			return { { { 1 - z * z, 1 - d, 0 }, { -z * z, 1 - d, 0 }, { 0, 0, 0 } } };
		case Integrator::MIDPOINT:
		case Integrator::HEUN:
			return taylor(z, d, 2);
		case Integrator::RUNGE_KUTTA_4:
			return taylor(z, d, 4);
		case Integrator::VELOCITY_VERLET: { // x' = x + y + a/2, a' = -z²x' - d(y + a), y' = y + (a + a')/2
			const std::array<double, 3> next = { -z * z, -z * z - d, -z * z / 2 - d };
			return { { { 1, 1, 0.5 }, { next[0] / 2, 1 + next[1] / 2, 0.5 + next[2] / 2 }, next } };
		}
		case Integrator::XPBD: // one spring alone: backward Euler, x' = (x + y + dx)/(1 + z² + d), y' = x' - x
			return { { { (1 + d) / q, 1 / q, 0 }, { (1 + d) / q - 1, 1 / q, 0 }, { 0, 0, 0 } } };
		case Integrator::AUTOMATIC:
		case Integrator::EXPLICIT_EULER:
			break;
	}
	return taylor(z, d, 1);
}

// The acceleration a that opens a substep of Verlet is the one that closed the last, found with the predicted velocity
// y + a: hence its third column. Only the first substep of a tick finds it from the present state.
Matrix fresh_acceleration(double z, double d) {
	return { { { 1, 0, 0 }, { 0, 1, 0 }, { -z * z, -d, 0 } } };
}

// Largest factor by which a matrix stretches in the long run, the spectral radius: |M^n|^(1/n) for n = 2^40 by repeated
// squaring, where the root has made 1 of every constant.
double spectral_radius(Matrix power) {
	double logarithm = 0;
	double share = 1;
	for (int i = 0; i <= 40; ++i) {
		double norm = 0;
		for (const auto &row : power) {
			for (const double entry : row) {
				norm = std::max(norm, std::abs(entry));
			}
		}
		if (norm == 0) { // a double eigenvalue: the squares converge to a matrix whose square is 0
			break;
		}
		for (auto &row : power) {
			for (double &entry : row) {
				entry /= norm;
			}
		}
		logarithm += std::log(norm) * share;
		power = product(power, power);
		share /= 2;
	}
	return std::exp(logarithm);
}

// Growth a substep with `tick` substeps a step of the simulator. Only for Verlet does it depend on `tick`.
double growth_in_theory(Integrator integrator, double z, double zeta, int tick) {
	const Matrix substep = amplification(integrator, z, zeta);
	if (integrator != Integrator::VELOCITY_VERLET) {
		return spectral_radius(substep);
	}
	Matrix whole = fresh_acceleration(z, 2 * zeta * z);
	for (int i = 0; i < tick; ++i) {
		whole = product(substep, whole);
	}
	return std::pow(spectral_radius(whole), 1.0 / tick);
}

// Two masses on one spring, moving along it; two more points, which nothing pulls, complete the hull.
class Oscillator {
public:
	// `tick` substeps of `h` make one step of the simulator, as in a game.
	Oscillator(Integrator integrator, double z, double zeta, double h, int tick) :
			omega_(z / h), h_(h), tick_(tick) {
		softbody::SoftBodyShape::Description description;
		description.points = { { -1, 0 }, { 0, -1 }, { 1, 0 }, { 0, 1 } };
		description.hull_count = 4;
		description.masses = { MASSES[0], 1, MASSES[1], 1 };
		description.springs = { { 0, 2, 2, Real(omega_ * omega_ / inverse_mass()), Real(2 * zeta * omega_ / inverse_mass()) } };
		softbody::BodySettings settings;
		settings.integrator = integrator;
		settings.substeps = tick;
		const Shape shape = take(softbody::SoftBodyShape::create(description));
		world_.set_sleeping(false); // however small the motion
		world_.add_soft_body(take(softbody::SoftBodyData::create(shape, settings)));
	}
	Oscillator(const Oscillator &) = delete;

	static double inverse_mass() { return 1 / double(MASSES[0]) + 1 / double(MASSES[1]); }

	// Mean logarithm of the growth a substep, in the energy norm sqrt(v² + ω²x²) of the spring's length. The norm
	// itself swings within each oscillation, so the tops of two stretches of the run are compared.
	double growth(int ticks) {
		double logarithm = 0;
		double early = -INFINITE;
		double late = -INFINITE;
		place(AMPLITUDE, 0);
		for (int i = 0; i < ticks; ++i) {
			if (!simulator_.simulate(Real(h_ * tick_)).reset_bodies.empty()) {
				return INFINITE;
			}
			const double stretch = length() - 2;
			const double rate = speed();
			const double norm = std::sqrt(stretch * stretch + rate * rate / (omega_ * omega_));
			if (norm == 0) {
				return -INFINITE;
			}
			logarithm += std::log(norm / AMPLITUDE);
			place(stretch * AMPLITUDE / norm, rate * AMPLITUDE / norm);
			if (i >= ticks / 4 && i < ticks / 2) {
				early = std::max(early, logarithm);
			} else if (i >= ticks - ticks / 4) {
				late = std::max(late, logarithm);
			}
		}
		return (late - early) / ((ticks - ticks / 2) * double(tick_));
	}

	// A tick may multiply the amplitude by this and still leave the spring in its linear range.
	static constexpr double ROOM = sizeof(Real) == 8 ? 1e5 : 1e2;

private:
	static constexpr double INFINITE = std::numeric_limits<double>::infinity();
	static constexpr double AMPLITUDE = sizeof(Real) == 8 ? 1e-6 : 2e-3; // large against rounding, small against 2
	static constexpr std::array<Real, 2> MASSES = { 1, Real(0.25) };

	softbody::SoftBodyData &body() { return world_.soft_bodies()[0]; }
	double length() { return double(body().positions()[2].x) - double(body().positions()[0].x); }
	double speed() { return double(body().velocities()[2].x) - double(body().velocities()[0].x); }

	// Sets the spring's stretch and its rate, about the resting center of mass.
	void place(double stretch, double rate) {
		const auto positions = body().mutable_positions();
		const auto velocities = body().mutable_velocities();
		const auto rest = body().shape().rest_positions();
		for (const std::size_t end : { std::size_t(0), std::size_t(2) }) {
			const double share = (end == 0 ? -1 : 1) / double(MASSES[end / 2]) / inverse_mass();
			positions[end] = { rest[end].x + Real(stretch * share), rest[end].y };
			velocities[end] = { Real(rate * share), 0 };
		}
	}

	double omega_;
	double h_;
	int tick_;
	softbody::WorldData world_;
	softbody::Simulator simulator_{ world_ };
};

// Substeps a tick: as many as a step may have, fewer where the motion would leave the linear range within the tick.
int tick_for(Integrator integrator, double z, double zeta) {
	const double growth = spectral_radius(amplification(integrator, z, zeta));
	// A double root grows faster than its power, by up to as many times as there are substeps.
	const double room = zeta == 1 ? Oscillator::ROOM / softbody::MAX_SUBSTEPS : Oscillator::ROOM;
	const double most = growth > 1 ? std::log(room) / std::log(growth) : softbody::MAX_SUBSTEPS;
	return int(std::clamp(most, 1.0, double(softbody::MAX_SUBSTEPS)));
}

double measured_growth(Integrator integrator, double z, double zeta, double h, int steps) {
	const int tick = tick_for(integrator, z, zeta);
	return std::exp(Oscillator(integrator, z, zeta, h, tick).growth(std::max(steps / tick, 64)));
}

constexpr double LOWEST = 0.1; // smallest hω looked at without damping; half of the smallest limit with it
constexpr double HIGHEST = 4; // above every finite limit
constexpr double BEYOND = 1e5; // "for every k": hω looked at where HIGHEST is still stable

// Largest hω below which every one is stable: the first unstable one of a scan, made precise by bisection.
// 0 when the lowest is unstable, infinite when none is.
template <typename IsStable>
double largest_stable(double lowest, double precision, IsStable is_stable) {
	double low = lowest;
	if (!is_stable(low)) {
		return 0;
	}
	double high = low;
	while (is_stable(high)) {
		low = high;
		if (high > HIGHEST) {
			return is_stable(BEYOND) ? std::numeric_limits<double>::infinity() : HIGHEST;
		}
		high *= 1.1;
	}
	while (high - low > precision * high) {
		const double middle = (low + high) / 2;
		(is_stable(middle) ? low : high) = middle;
	}
	return low;
}

json finite_or_null(double value) {
	return std::isfinite(value) ? json(value) : json(nullptr);
}

// Growth below this over half a run is none. A run of 2^16 steps so tells 3e-6 a step from none.
constexpr double NO_GROWTH = 0.1;

double theoretical_limit(Integrator integrator, double zeta, double lowest) {
	return largest_stable(lowest, 1e-9, [&](double z) {
		return growth_in_theory(integrator, z, zeta, tick_for(integrator, z, zeta)) <= 1 + 1e-9;
	});
}

double measured_limit(Integrator integrator, double zeta, double h, double lowest, int steps) {
	const double tolerance = std::exp(NO_GROWTH / (steps / 2));
	return largest_stable(
			lowest, 1e-4, [&](double z) { return measured_growth(integrator, z, zeta, h, steps) <= tolerance; });
}

double lowest_for(Integrator integrator, double zeta) {
	// The limits shrink like 2ζ (explicit Euler, small ζ) and like 1/(2ζ) (large ζ).
	return zeta == 0 || integrator == Integrator::XPBD ? LOWEST : std::min(zeta, 0.25 / zeta) / 2;
}

} // namespace

json stability(const Options &options) {
	const std::vector<double> ratios = options.quick ? std::vector<double>{ 0, 0.05, 0.2, 1 }
													 : std::vector<double>{ 0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2 };
	const int steps = options.quick ? 1 << 14 : 1 << 16;
	const int cells = options.quick ? 30 : 60;
	constexpr double h = 1.0 / 240;
	json result = { { "map", json::array() }, { "theory", json::array() }, { "limits", json::array() } };
	for (const Integrator integrator : INTEGRATORS) {
		const char *name = softbody::integrator_facts(integrator).name;
		for (const double zeta : ratios) {
			for (int i = 1; i <= cells; ++i) {
				const double z = 3 * (i - 0.5) / cells; // never a limit itself, where rounding decides
				const double growth = measured_growth(integrator, z, zeta, h, 2048);
				result["map"].push_back({ { "integrator", name }, { "zeta", zeta }, { "h_omega", z },
						{ "growth", finite_or_null(growth) },
						{ "growth_theory", growth_in_theory(integrator, z, zeta, tick_for(integrator, z, zeta)) },
						{ "stable", growth <= 1 + 1e-3 } });
			}
			const double lowest = lowest_for(integrator, zeta);
			const double limit = theoretical_limit(integrator, zeta, lowest);
			const double measured = measured_limit(integrator, zeta, h, lowest, steps);
			result["theory"].push_back({ { "integrator", name }, { "zeta", zeta }, { "h_omega_limit", finite_or_null(limit) },
					{ "h_omega_measured", finite_or_null(measured) }, { "unbounded", std::isinf(limit) } });
		}
		for (const int rate : { 60, 240, 960 }) {
			const double dt = 1.0 / rate;
			const auto stiffness = [&](double z) { return z * z / (dt * dt * Oscillator::inverse_mass()); };
			const double limit = theoretical_limit(integrator, 0, LOWEST);
			const double measured = measured_limit(integrator, 0, dt, LOWEST, steps);
			result["limits"].push_back({ { "integrator", name }, { "dt", dt },
					{ "k_measured", finite_or_null(stiffness(measured)) }, { "k_theory", finite_or_null(stiffness(limit)) },
					{ "unbounded", std::isinf(limit) && std::isinf(measured) } });
		}
	}
	result["unbounded_up_to_h_omega"] = BEYOND;
	return result;
}

} // namespace bench
