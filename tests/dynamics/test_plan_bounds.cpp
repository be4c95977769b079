// SPDX-License-Identifier: MIT
// Claims about the bounds that plans are made of, against eigenvalues found another way.
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/dynamics/substep_plan.h"
#include "core/geometry/polygon.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// Square matrices of a few dozen rows, in double.
struct Matrix {
	std::size_t n;
	std::vector<double> a;
	explicit Matrix(std::size_t size) : n(size), a(size * size) {}
	double &at(std::size_t i, std::size_t j) { return a[i * n + j]; }
	double at(std::size_t i, std::size_t j) const { return a[i * n + j]; }
};

Matrix product(const Matrix &a, const Matrix &b) {
	Matrix c(a.n);
	for (std::size_t i = 0; i < a.n; ++i) {
		for (std::size_t k = 0; k < a.n; ++k) {
			for (std::size_t j = 0; j < a.n; ++j) {
				c.at(i, j) += a.at(i, k) * b.at(k, j);
			}
		}
	}
	return c;
}

// p + factor q
Matrix sum(Matrix p, double factor, const Matrix &q) {
	for (std::size_t i = 0; i < p.a.size(); ++i) {
		p.a[i] += factor * q.a[i];
	}
	return p;
}

Matrix identity(std::size_t n) {
	Matrix m(n);
	for (std::size_t i = 0; i < n; ++i) {
		m.at(i, i) = 1;
	}
	return m;
}

double norm(const Matrix &m) {
	double squares = 0;
	for (const double x : m.a) {
		squares += x * x;
	}
	return std::sqrt(squares);
}

// |M^N|^(1/N) for N = 2^22, by squaring: the largest growth a step, and for what only drifts (a Jordan block of
// rigid motion) 1 + log(N)/N, which is 4e-6.
double growth(Matrix m) {
	double log_scale = 0;
	double power = 1;
	for (int i = 0; i < 22; ++i) {
		m = product(m, m);
		power *= 2;
		const double size = norm(m);
		log_scale = 2 * log_scale + std::log(size);
		for (double &x : m.a) {
			x /= size;
		}
	}
	return std::exp(log_scale / power);
}

double largest_eigenvalue(const Matrix &symmetric) {
	const double shift = norm(symmetric);
	Matrix shifted = sum(symmetric, shift, identity(symmetric.n)); // positive, so the largest is the largest in size
	return growth(shifted) - shift;
}

void add_outer(Matrix &m, const std::vector<double> &u, double factor) {
	for (std::size_t i = 0; i < m.n; ++i) {
		for (std::size_t j = 0; j < m.n; ++j) {
			m.at(i, j) += factor * u[i] * u[j];
		}
	}
}

// Stiffness and damping of a body at rest, over the masses: M^(-1/2) K M^(-1/2). Springs by their directions, shape
// matching as what remains of a motion without its rigid part, pressure by the gradient of the area.
struct Linear {
	Matrix stiffness;
	Matrix damping;
};

Linear linearized(const SoftBodyShape &shape, const BodySettings &settings) {
	const std::size_t n = shape.point_count();
	Linear linear{ Matrix(2 * n), Matrix(2 * n) };
	const auto x = [&](std::size_t i, std::size_t axis) {
		return double(axis ? shape.rest_positions()[i].y : shape.rest_positions()[i].x);
	};
	const auto root_mass = [&](std::size_t i) { return std::sqrt(double(shape.masses()[i])); };
	for (const Spring2D &spring : shape.springs()) {
		std::vector<double> u(2 * n);
		const double length = std::hypot(x(spring.b, 0) - x(spring.a, 0), x(spring.b, 1) - x(spring.a, 1));
		for (const std::size_t axis : { 0u, 1u }) {
			const double e = (x(spring.b, axis) - x(spring.a, axis)) / length;
			u[2 * spring.a + axis] = -e / root_mass(spring.a);
			u[2 * spring.b + axis] = e / root_mass(spring.b);
		}
		add_outer(linear.stiffness, u, double(spring.stiffness));
		add_outer(linear.damping, u, double(spring.damping));
	}
	Matrix relative = identity(2 * n);
	std::vector<double> along_x(2 * n);
	std::vector<double> along_y(2 * n);
	std::vector<double> turn(2 * n);
	for (std::size_t i = 0; i < n; ++i) {
		along_x[2 * i] = along_y[2 * i + 1] = root_mass(i) / std::sqrt(double(shape.total_mass()));
		turn[2 * i] = -root_mass(i) * x(i, 1) / std::sqrt(double(shape.rest_inertia()));
		turn[2 * i + 1] = root_mass(i) * x(i, 0) / std::sqrt(double(shape.rest_inertia()));
	}
	for (const auto &rigid : { along_x, along_y, turn }) {
		add_outer(relative, rigid, -1);
	}
	const double mean_mass = double(shape.total_mass()) / double(n);
	linear.stiffness = sum(linear.stiffness, double(settings.shape_stiffness) / mean_mass, relative);
	linear.damping = sum(linear.damping, double(settings.shape_damping) / mean_mass, relative);
	std::vector<double> gradient(2 * n);
	const std::size_t hull = shape.hull_count();
	for (std::size_t i = 0; i < hull; ++i) {
		const std::size_t next = (i + 1) % hull;
		const std::size_t last = (i + hull - 1) % hull;
		gradient[2 * i] = (x(next, 1) - x(last, 1)) / 2 / root_mass(i);
		gradient[2 * i + 1] = (x(last, 0) - x(next, 0)) / 2 / root_mass(i);
	}
	add_outer(linear.stiffness, gradient, double(settings.pressure_stiffness) / double(shape.rest_area()));
	return linear;
}

// What a step of h does to (x, v), both scaled by the roots of the masses.
Matrix step_matrix(Integrator integrator, const Linear &linear, double h) {
	const std::size_t n = linear.stiffness.n;
	Matrix slope(2 * n);
	for (std::size_t i = 0; i < n; ++i) {
		slope.at(i, n + i) = 1;
		for (std::size_t j = 0; j < n; ++j) {
			slope.at(n + i, j) = -linear.stiffness.at(i, j);
			slope.at(n + i, n + j) = -linear.damping.at(i, j);
		}
	}
	const int order = integrator == Integrator::EXPLICIT_EULER ? 1 : integrator == Integrator::RUNGE_KUTTA_4 ? 4 : 2;
	Matrix result = identity(2 * n); // the exponential series up to the order
	for (int i = order; i > 0; --i) {
		result = sum(identity(2 * n), h / i, product(slope, result));
	}
	return result;
}

struct Drawn {
	std::shared_ptr<const SoftBodyShape> shape;
	BodySettings settings;
};

// Five or six hull points and sometimes a center, springs of any stiffness and damping, every mixture of terms.
Drawn random_body(Random &random, Integrator integrator) {
	SoftBodyShape::Description description;
	description.hull_count = std::size_t(random.integer(3, 6));
	for (std::size_t i = 0; i < description.hull_count; ++i) {
		const Rotation turn = Rotation::from_angle(Real(6.283185307179586 * double(i) / double(description.hull_count)));
		description.points.push_back(turn.apply({ random.real(0.5, 1), 0 }));
	}
	if (random.chance(0.5)) {
		description.points.push_back({ 0, 0 });
	}
	for (std::size_t i = 0; i < description.points.size(); ++i) {
		description.masses.push_back(std::pow(Real(10), random.real(-1, 1)));
		for (std::size_t j = 0; j < i; ++j) {
			const bool neighbors = j + 1 == i || (j == 0 && i + 1 == description.hull_count);
			if (neighbors || random.chance(0.5)) {
				const Real k = random.chance(0.1) ? Real(0) : std::pow(Real(10), random.real(0, 4));
				const Real c = random.real(0.02, 1) * std::sqrt(std::max(k, Real(1)));
				description.springs.push_back({ std::uint32_t(j), std::uint32_t(i),
						length(description.points[i] - description.points[j]), k, c });
			}
		}
	}
	Drawn drawn{ SoftBodyShape::create(std::move(description)).value(), {} };
	drawn.settings.integrator = integrator;
	if (random.chance(0.5)) {
		drawn.settings.shape_stiffness = std::pow(Real(10), random.real(0, 4));
		drawn.settings.shape_damping = random.real(0.02, 1) * std::sqrt(drawn.settings.shape_stiffness);
		if (random.chance(0.5)) {
			drawn.settings.pressure_stiffness = std::pow(Real(10), random.real(0, 4));
		}
	}
	return drawn;
}

constexpr double LINEAR_LIMIT = 2; // the budget that stands for the limit itself

// A growth of 1 as computed: the drift of rigid motion, and in float its stiffness, which is a rounding of k instead of
// 0 and may be negative: a growth of hω sqrt(epsilon).
constexpr double NO_GROWTH = sizeof(Real) == 8 ? 1 + 2e-5 : 1 + 1e-3;

} // namespace

TEST_CASE("explicit Euler, midpoint, Heun and Runge-Kutta do not grow within their planned step, by their step matrices") {
	Random random(41);
	int stable_steps = 0;
	for (const Integrator integrator :
			{ Integrator::EXPLICIT_EULER, Integrator::MIDPOINT, Integrator::HEUN, Integrator::RUNGE_KUTTA_4 }) {
		for (int round = 0; round < 40; ++round) {
			const Drawn drawn = random_body(random, integrator);
			const double step =
					largest_stable_step(integrator, frequency_bounds(*drawn.shape, drawn.settings), LINEAR_LIMIT);
			CAPTURE(int(integrator));
			CAPTURE(round);
			if (step > 0 && std::isfinite(step)) {
				CHECK(growth(step_matrix(integrator, linearized(*drawn.shape, drawn.settings), step)) < NO_GROWTH);
				stable_steps++;
			}
		}
	}
	CHECK(stable_steps > 100);
}

TEST_CASE("at rest the springs of 300 random bodies are as fast as the eigenvalues of their Hessians say, and no faster than their bound") {
	Random random(417);
	double least_share = 1;
	for (int round = 0; round < 300; ++round) {
		Drawn drawn = random_body(random, Integrator::SEMI_IMPLICIT_EULER);
		drawn.settings = {};
		const SoftBodyShape &shape = *drawn.shape;
		const Linear linear = linearized(shape, drawn.settings);
		const double frequency_squared = largest_eigenvalue(linear.stiffness);
		const double rate = largest_eigenvalue(linear.damping);
		CHECK(double(shape.rest_spring_frequency_squared()) <= 1.0001 * frequency_squared);
		CHECK(double(shape.rest_spring_frequency_squared()) >= 0.9 * frequency_squared);
		CHECK(double(shape.rest_spring_damping_rate()) >= 0.9 * rate);
		CHECK(shape.rest_spring_frequency_squared() <= shape.spring_frequency_squared());
		least_share = std::min(least_share, double(shape.rest_spring_frequency_squared()) / double(shape.spring_frequency_squared()));
	}
	CHECK(least_share < 0.7); // the bound for any shape is farther off
}

TEST_CASE("bodies near their rest shape take fewer substeps and never show twice their energy: 500 random bodies for two seconds") {
	Random random(418);
	int fewer = 0;
	for (int round = 0; round < 500; ++round) {
		CAPTURE(round);
		Drawn drawn = random_body(random, Integrator::AUTOMATIC);
		drawn.settings.pressure_stiffness = 0;
		const SoftBodyShape &shape = *drawn.shape;
		WorldData world;
		world.add_border({ { { 0, -1000 }, { 0, 1 } }, {} }); // far away, but bodies are planned for contacts
		world.add_soft_body(SoftBodyData::create(drawn.shape, drawn.settings, {}).value());
		SoftBodyData &body = world.soft_bodies()[0];
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			REQUIRE(!body.set_point(i, body.positions()[i] + random.vector(double(CALM_STRAIN) / 2) * shape.radius(), {}));
		}
		Simulator simulator(world);
		const double first = measure_energy(body, {}).total();
		const SubstepPlan plan = simulator.plan(body, Real(1) / 60);
		for (int tick = 0; tick < 120; ++tick) {
			const StepReport report = simulator.simulate(Real(1) / 60);
			fewer += tick == 0 && report.substeps < std::uint64_t(plan.substeps);
			CHECK(report.reset_bodies.empty());
			CHECK(measure_energy(body, {}).total() <= 2 * first);
		}
	}
	CHECK(fewer > 100);
}

TEST_CASE("a body with hardly any damping takes the substeps of any shape also near its rest shape, whether it bounces or not") {
	for (const Real restitution : { Real(0), Real(0.2), Real(1) }) {
		for (const Real ratio : { Real(0), Real(0.005), Real(0.05) }) {
			CAPTURE(restitution);
			CAPTURE(ratio);
			const Real stiffness = 800;
			const auto shape = circle_shape(Real(0.5), 8, { 1, stiffness, 2 * ratio * std::sqrt(stiffness / 9), true }).value();
			BodySettings settings;
			settings.restitution = restitution;
			const SubstepPlan plan = plan_substeps(*shape, settings, Real(1) / 60, true);
			const SubstepPlan calm = plan_near_rest(plan, *shape, settings, Real(1) / 60);
			CHECK((calm.substeps < plan.substeps) == (ratio > Real(0.01)));
		}
	}
}

TEST_CASE("a body with a point farther from its place than a near one may be takes the substeps of any shape: 200 random bodies") {
	Random random(419);
	for (int round = 0; round < 200; ++round) {
		CAPTURE(round);
		Drawn drawn = random_body(random, Integrator::AUTOMATIC);
		drawn.settings.pressure_stiffness = 0;
		WorldData world;
		world.add_border({ { { 0, -1000 }, { 0, 1 } }, {} });
		world.add_soft_body(SoftBodyData::create(drawn.shape, drawn.settings, {}).value());
		SoftBodyData &body = world.soft_bodies()[0];
		const Vec2 neighbor = body.positions()[1];
		REQUIRE(!body.set_point(0, neighbor - (body.positions()[0] - neighbor) * Real(0.8), {})); // to its other side
		Simulator simulator(world);
		const SubstepPlan plan = simulator.plan(body, Real(1) / 60);
		CHECK(simulator.simulate(Real(1) / 60).substeps == std::uint64_t(plan.substeps));
	}
}

TEST_CASE("stiffness is nowhere more than damping over the damping time, in no mode") {
	Random random(42);
	for (int round = 0; round < 60; ++round) {
		const Drawn drawn = random_body(random, Integrator::HEUN);
		const double time = frequency_bounds(*drawn.shape, drawn.settings).damping_time;
		const Linear linear = linearized(*drawn.shape, drawn.settings);
		CAPTURE(round);
		REQUIRE(std::isfinite(time));
		// The largest eigenvalue of βK - C is that of the rigid motions, 0, but for what float made of the body.
		const double scale = norm(linear.damping);
		CHECK(largest_eigenvalue(sum(sum(Matrix(linear.damping.n), time, linear.stiffness), -1, linear.damping)) <
				2e-5 * scale);
	}
}

TEST_CASE("where all springs have one ratio of damping to stiffness the explicit limit is sharp") {
	// c/k = 0.004 s in every mode: all of them reach their limit together.
	const auto shape = thesis_shape(500, 2);
	BodySettings settings;
	settings.integrator = Integrator::EXPLICIT_EULER;
	const FrequencyBounds bounds = frequency_bounds(*shape, settings);
	CHECK(std::abs(bounds.damping_time - 0.004) < 0.004 * 4 * EPSILON);
	const double step = largest_stable_step(Integrator::EXPLICIT_EULER, bounds, LINEAR_LIMIT);
	CHECK(growth(step_matrix(Integrator::EXPLICIT_EULER, linearized(*shape, settings), 0.95 * step)) < NO_GROWTH);
	CHECK(growth(step_matrix(Integrator::EXPLICIT_EULER, linearized(*shape, settings), 1.05 * step)) > NO_GROWTH);
}

TEST_CASE("one undamped spring among damped ones, or pressure alone, leaves explicit Euler, midpoint and Heun no step") {
	std::vector<Spring2D> springs{ { 0, 1, 1, 100, 5 }, { 1, 2, 1, 100, 0 } };
	const SoftBodyData body = loose_points(3, 1, springs);
	BodySettings settings;
	for (const Integrator integrator : { Integrator::EXPLICIT_EULER, Integrator::MIDPOINT, Integrator::HEUN }) {
		settings.integrator = integrator;
		settings.pressure_stiffness = 0;
		CHECK(largest_stable_step(integrator, frequency_bounds(body.shape(), settings), LINEAR_LIMIT) == 0);
		CHECK(plan_substeps(body.shape(), settings, Real(0.01), false).reason == PlanReason::UNSTABLE);
		settings.pressure_stiffness = 10;
		CHECK(largest_stable_step(integrator, frequency_bounds(*thesis_shape(100, 5), settings), LINEAR_LIMIT) == 0);
		settings.shape_damping = 1;
		CHECK(largest_stable_step(integrator, frequency_bounds(*thesis_shape(100, 5), settings), LINEAR_LIMIT) > 0);
		settings.shape_damping = 0;
	}
}

TEST_CASE("the frequency bound of a body under pressure holds however its hull is stretched") {
	// Hessian of k_p (A - s A0)²/(2 A0) from its formula; area and gradient are those of the shoelace sum.
	Random random(43);
	int above_rest = 0;
	for (int round = 0; round < 60; ++round) {
		const Drawn drawn = random_body(random, Integrator::VELOCITY_VERLET);
		BodySettings settings = drawn.settings;
		settings.pressure_stiffness = 1000;
		settings.shape_stiffness = 0;
		settings.inflation = random.real(0, 3);
		settings.spring_stiffness_scale = settings.spring_damping_scale = 0; // the springs' bound has its own test
		const auto shape = drawn.shape;
		SoftBodyData body = SoftBodyData::create(shape, settings).value();
		const double stretch = random.real(0.2, 4);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i] * Real(stretch) + random.vector(0.5 * stretch), {});
		}
		const std::size_t hull = shape->hull_count();
		const std::size_t n = 2 * hull;
		const double area = double(signed_area(body.hull()));
		const double rest = double(shape->rest_area());
		Matrix hessian(n);
		std::vector<double> gradient(n);
		for (std::size_t i = 0; i < hull; ++i) {
			const std::size_t next = (i + 1) % hull;
			const std::size_t last = (i + hull - 1) % hull;
			const double mass = std::sqrt(double(shape->masses()[i]));
			const Vec2 across = body.hull()[next] - body.hull()[last];
			gradient[2 * i] = double(across.y) / 2 / mass;
			gradient[2 * i + 1] = -double(across.x) / 2 / mass;
			// ∂²A/∂x_i∂y_next = 1/2, ∂²A/∂y_i∂x_next = -1/2, and the same mirrored.
			const double entry = 0.5 / (mass * std::sqrt(double(shape->masses()[next]))) * (area / rest - settings.inflation) * 1000;
			hessian.at(2 * i, 2 * next + 1) += entry;
			hessian.at(2 * next + 1, 2 * i) += entry;
			hessian.at(2 * i + 1, 2 * next) -= entry;
			hessian.at(2 * next, 2 * i + 1) -= entry;
		}
		add_outer(hessian, gradient, 1000 / rest);
		const double measured = largest_eigenvalue(hessian);
		CAPTURE(round);
		CHECK(measured <= frequency_bounds(body, Real(1) / 60).frequency_squared * (1 + 1e-4));
		above_rest += measured > frequency_bounds(*shape, settings).frequency_squared;
	}
	CHECK(above_rest > 20); // so the rest hull would not have done
}

TEST_CASE("a plan looks ahead: a hull that its velocities stretch within the step counts as stretched") {
	BodySettings settings;
	settings.pressure_stiffness = 1000;
	SoftBodyData body = thesis_body(thesis_shape(100, 1), settings);
	const int resting = plan_substeps(body, Real(1) / 60, false).substeps;
	CHECK(resting == plan_substeps(body.shape(), settings, Real(1) / 60, false).substeps);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], body.positions()[i] * Real(120)); // three times the size after 1/60 s
	}
	CHECK(plan_substeps(body, Real(1) / 60, false).substeps > resting + 2);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i] * Real(3), body.positions()[i] * Real(-120)); // and back again
	}
	CHECK(plan_substeps(body, Real(1) / 60, false).substeps > resting + 2);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.shape().rest_positions()[i], {});
	}
	body.mutable_velocities()[0].x = NOT_A_NUMBER;
	CHECK(plan_substeps(body, Real(1) / 60, false).substeps == resting);
}

TEST_CASE("a balloon three times too large neither blows up nor gains energy under the automatic choice") {
	BodySettings settings;
	settings.pressure_stiffness = 3000;
	const auto shape = circle_shape(THESIS_RADIUS, 6, { 1, 20, Real(0.1), false }).value();
	WorldData world;
	SoftBodyData body = thesis_body(shape, settings);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i] * Real(3), {});
	}
	const double start = measure_energy(body, {}).total();
	world.add_soft_body(std::move(body));
	Simulator simulator(world);
	for (int i = 0; i < 120; ++i) {
		CHECK(simulator.simulate(Real(1) / 60).reset_bodies.empty());
		CHECK(measure_energy(world.soft_bodies()[0], {}).total() < 1.2 * start);
	}
}
