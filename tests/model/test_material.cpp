// SPDX-License-Identifier: MIT
// What a material's moduli mean in each model: uniform strain costs what theory says.
#include "core/model/material.h"

#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/energy.h"
#include "core/geometry/polygon.h"
#include "core/model/soft_body_data.h"
#include "scenes/circle.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace softbody;

namespace {

std::shared_ptr<const SoftBodyShape> elastic_shape(const std::vector<Vec2> &hull) {
	StructureOptions options;
	options.stiffness = 1;
	options.elastic = true;
	return SoftBodyCreator::create_polygon(hull, options).value();
}

// Energy of a uniform stretch of the rest shape, (1 + a) along an axis at `angle` and (1 + b) across it.
double energy_of_strain(const std::shared_ptr<const SoftBodyShape> &shape, const BodySettings &settings, double a, double b, double angle) {
	SoftBodyData body = SoftBodyData::create(shape, settings).value();
	const Rotation turn = Rotation::from_angle(Real(angle));
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 q = turn.apply_inverse(shape->rest_positions()[i]);
		REQUIRE(!body.set_point(i, turn.apply({ Real(q.x * (1 + a)), Real(q.y * (1 + b)) }), {}));
	}
	return measure_energy(body, {}).total();
}

// Averaged over the directions of the strain.
double mean_energy(const std::shared_ptr<const SoftBodyShape> &shape, const BodySettings &settings, double a, double b) {
	constexpr int DIRECTIONS = 12;
	double sum = 0;
	for (int k = 0; k < DIRECTIONS; ++k) {
		sum += energy_of_strain(shape, settings, a, b, 3.14159265 * k / DIRECTIONS);
	}
	return sum / DIRECTIONS;
}

} // namespace

TEST_CASE("moduli follow from Young's modulus and Poisson's ratio as in plane strain") {
	const Material material{ 300, Real(0.25), 0 };
	CHECK(double(material.shear_modulus()) == doctest::Approx(120));
	CHECK(double(material.bulk_modulus()) == doctest::Approx(240)); // λ = 120
}

TEST_CASE("uniform shear of a body with elastic modes costs 2 μ A e², in every direction") {
	for (const int count : { 8, 16, 64 }) {
		const auto shape = elastic_shape(circle_hull(50, count).value());
		BodySettings settings;
		const Material material;
		REQUIRE(!apply_material(material, ElasticModel::MODES, *shape, settings));
		const double expected = 2 * double(material.shear_modulus()) * double(shape->rest_area()) * 0.01 * 0.01;
		for (const double angle : { 0.0, 0.3, 1.0 }) {
			CAPTURE(count);
			// An eighth of the second order in e is the area's; inner points are no part of the solid's uniform strain.
			CHECK(energy_of_strain(shape, settings, 0.01, -0.01, angle) == doctest::Approx(expected).epsilon(0.05));
		}
	}
}

TEST_CASE("uniform dilation costs 2 K A e²") {
	const auto shape = elastic_shape(circle_hull(50, 16).value());
	const Material material;
	for (const ElasticModel model : { ElasticModel::MODES, ElasticModel::SPRINGS_SHAPE_AND_AREA }) {
		BodySettings settings;
		REQUIRE(!apply_material(material, model, *shape, settings));
		const double expected = 2 * double(material.bulk_modulus()) * double(shape->rest_area()) * 0.005 * 0.005;
		CHECK(energy_of_strain(shape, settings, 0.005, 0.005, 0) == doctest::Approx(expected).epsilon(0.03));
	}
}

TEST_CASE("springs and shape matching take up the shear modulus of the material, on average over directions") {
	std::vector<Vec2> box = { { 0, 0 }, { 40, 0 }, { 80, 0 }, { 80, 30 }, { 80, 60 }, { 40, 60 }, { 0, 60 }, { 0, 30 } };
	const auto shape = elastic_shape(box);
	const Material material;
	for (const ElasticModel model : { ElasticModel::SPRINGS, ElasticModel::SPRINGS_AND_SHAPE, ElasticModel::SPRINGS_SHAPE_AND_AREA }) {
		BodySettings settings;
		REQUIRE(!apply_material(material, model, *shape, settings));
		const double expected = 2 * double(material.shear_modulus()) * double(shape->rest_area()) * 0.005 * 0.005;
		CAPTURE(int(model));
		CHECK(mean_energy(shape, settings, 0.005, -0.005) == doctest::Approx(expected).epsilon(0.03));
	}
}

TEST_CASE("springs alone resist dilation with twice the shear modulus, as Cauchy's relation says") {
	const auto shape = elastic_shape(circle_hull(50, 24).value());
	BodySettings settings;
	const Material material;
	REQUIRE(!apply_material(material, ElasticModel::SPRINGS, *shape, settings));
	const double expected = 2 * 2 * double(material.shear_modulus()) * double(shape->rest_area()) * 0.005 * 0.005;
	CHECK(energy_of_strain(shape, settings, 0.005, 0.005, 0) == doctest::Approx(expected).epsilon(0.02));
}

TEST_CASE("bad materials are refused by name, and nothing changes") {
	const auto shape = elastic_shape(circle_hull(50, 8).value());
	const BodySettings before;
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	const auto refused = [&](const Material &material, const char *name) {
		BodySettings settings = before;
		const Status status = apply_material(material, ElasticModel::MODES, *shape, settings);
		REQUIRE(status);
		CHECK(status->name == name);
		CHECK(settings == before);
	};
	refused({ 0, Real(0.3), 0 }, "youngs_modulus");
	refused({ -1, Real(0.3), 0 }, "youngs_modulus");
	refused({ nan, Real(0.3), 0 }, "youngs_modulus");
	refused({ 100, Real(0.5), 0 }, "poisson_ratio");
	refused({ 100, Real(-0.1), 0 }, "poisson_ratio");
	refused({ 100, nan, 0 }, "poisson_ratio");
	refused({ 100, Real(0.3), -1 }, "damping_ratio");
}

TEST_CASE("models that a shape cannot follow are refused") {
	StructureOptions options;
	const auto network = testing::circle_shape(50, 8, options).value();
	BodySettings settings;
	CHECK(apply_material({}, ElasticModel::MODES, *network, settings)->name == "elastic_model");
	options.stiffness = 0;
	const auto limp = testing::circle_shape(50, 8, options).value();
	CHECK(apply_material({}, ElasticModel::SPRINGS, *limp, settings)->name == "elastic_model");
	CHECK(settings == BodySettings{});
}

TEST_CASE("a network has the values of its springs, and shape matching with the damping ratio that was asked for") {
	StructureOptions options;
	options.stiffness = 1;
	options.damping = 1;
	const auto shape = testing::circle_shape(50, 8, options).value(); // nine points
	BodySettings settings;
	REQUIRE(!apply_network({ 200, 3, 0.5, 0.25 }, 18, *shape, settings));
	CHECK(settings.spring_stiffness_scale == 200);
	CHECK(settings.spring_damping_scale == 3);
	CHECK(settings.shape_stiffness == 100);
	CHECK(double(settings.shape_damping) == doctest::Approx(2 * 0.25 * std::sqrt(100.0 * 2)));
	const double most = double(std::numeric_limits<Real>::max());
	CHECK(apply_network({ most, 3, 0.5, 0.25 }, 18, *shape, settings)->name == "stiffness");
	CHECK(apply_network({ 200, most, 0.5, 0.25 }, 18, *shape, settings)->name == "damping");
}
