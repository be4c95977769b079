// SPDX-License-Identifier: MIT
// Hulls and structures of any numbers.
#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/skin/triangulation.h"
#include "fuzz/bytes.h"
#include "fuzz/targets.h"

#include <algorithm>
#include <cmath>

namespace softbody::fuzzing {

namespace {

/// Each of these meets each other: of larger hulls, boxes of tiny spacing, none is more than slow.
constexpr std::size_t MOST_POINTS = 64;

void check_error(const Error &error) {
	require(!error.name.empty() && !error.value.empty() && !error.bound.empty() && !error.remedy.empty(),
			"a refusal names the value, its bound and a remedy");
}

bool is_above_zero(Real value) {
	return std::isfinite(value) && value > 0;
}

void check_shape(const SoftBodyShape &shape) {
	for (const Vec2 p : shape.rest_positions()) {
		require(is_finite(p), "rest positions are finite");
	}
	for (std::size_t i = 0; i < shape.point_count(); ++i) {
		require(is_above_zero(shape.masses()[i]) && is_above_zero(shape.inverse_masses()[i]), "masses and their inverses are > 0");
	}
	for (const Spring2D &spring : shape.springs()) {
		require(spring.a < shape.point_count() && spring.b < shape.point_count() && spring.a != spring.b, "springs join two points");
		require(is_above_zero(spring.rest_length), "springs have a length");
	}
	require(is_above_zero(shape.total_mass()) && is_above_zero(shape.rest_area()) && is_above_zero(shape.radius()) &&
					is_above_zero(shape.width()) && is_above_zero(shape.rest_inertia()) && is_above_zero(shape.shortest_hull_edge()),
			"mass, area, radius, width, inertia and edges are > 0");
	require(std::isfinite(shape.spring_frequency_squared()) && std::isfinite(shape.spring_damping_rate()) &&
					is_above_zero(shape.area_inverse_mass()),
			"bounds of frequencies are finite");
}

void step_once(const std::shared_ptr<const SoftBodyShape> &shape, Bytes &bytes) {
	BodySettings settings;
	settings.shape_stiffness = bytes.any(1000);
	settings.shape_damping = bytes.any(10);
	settings.pressure_stiffness = bytes.any(1000);
	settings.integrator = Integrator(bytes.integer(0, INTEGRATOR_COUNT - 1));
	const Result<SoftBodyData> made = SoftBodyData::create(shape, settings);
	if (!made) {
		check_error(made.error());
		return;
	}
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	world.add_soft_body(made.value());
	Simulator simulator(world);
	require(!simulator.simulate(Real(1) / 60).refused, "a step of 1/60 s is taken");
	for (const Vec2 p : world.soft_bodies()[0].positions()) {
		require(is_finite(p), "positions are finite after a step");
	}
}

std::vector<Vec2> any_hull(Bytes &bytes) {
	Result<std::vector<Vec2>> made = std::vector<Vec2>{};
	switch (bytes.integer(0, 5)) {
		case 0: made = circle_hull(bytes.any(100), bytes.integer(0, 40)); break;
		case 1: {
			const Vec2 size = bytes.any_vector(100);
			made = box_hull(size, bytes.any(50));
			break;
		}
		case 2: {
			const Real radius = bytes.any(50);
			const Real height = bytes.any(200);
			made = capsule_hull(radius, height, bytes.any(50));
			break;
		}
		case 3: // in order of their angles: simple
			for (int i = 0, count = bytes.integer(0, 24); i < count; ++i) {
				const Real angle = Real(6.2831853) * (Real(i) + bytes.positive(0.9)) / Real(count);
				made.value().push_back(Rotation::from_angle(angle).apply({ bytes.any(100), 0 }));
			}
			break;
		default:
			for (int i = bytes.integer(0, 12); i > 0; --i) {
				made.value().push_back(bytes.any_vector(100));
			}
	}
	if (!made) {
		check_error(made.error());
		return {};
	}
	return made.value();
}

} // namespace

void fuzz_shape(std::span<const std::uint8_t> data) {
	Bytes bytes(data);
	const std::vector<Vec2> hull = any_hull(bytes);
	if (hull.size() > MOST_POINTS) {
		return;
	}
	StructureOptions options;
	options.mass = bytes.any(10);
	options.stiffness = bytes.any(1000);
	options.damping = bytes.any(10);
	options.center_point = bytes.chance();
	for (int i = bytes.integer(0, 15) - 8; i > 0; --i) {
		options.inner_points.push_back(bytes.any_vector(100));
	}
	for (int i = bytes.integer(0, 15) - 8; i > 0; --i) {
		const std::uint32_t a = bytes.byte() % 32u;
		options.springs.push_back({ a, bytes.byte() % 32u });
	}
	for (auto *scales : { &options.spring_stiffness_scales, &options.spring_damping_scales, &options.spring_length_scales }) {
		for (std::size_t i = bytes.integer(0, 3) == 1 ? options.springs.size() : 0; i > 0; --i) {
			scales->push_back(bytes.any(2));
		}
	}
	const auto made = SoftBodyCreator::create_polygon(hull, options);
	if (!made) {
		check_error(made.error());
		return;
	}
	require(!check_hull(hull), "what check_hull refuses is no body");
	const SoftBodyShape &shape = *made.value();
	require(shape.hull_count() == hull.size(), "a hull keeps its points");
	check_shape(shape);
	double area = 0;
	for (const Triangle &t : triangulate(shape.rest_positions(), shape.hull_count())) {
		require(std::ranges::all_of(t, [&](std::uint32_t i) { return i < shape.point_count(); }), "triangles name points that are there");
		const Vec2 a = shape.rest_positions()[t[0]];
		const Vec2 ab = shape.rest_positions()[t[1]] - a;
		const Vec2 ac = shape.rest_positions()[t[2]] - a;
		area += (double(ab.x) * ac.y - double(ab.y) * ac.x) / 2;
	}
	// Each of up to 50 triangles is rounded at the size of the whole.
	const double rounding = 1000 * std::numeric_limits<Real>::epsilon() * double(shape.radius()) * double(shape.radius());
	require(std::abs(area - double(shape.rest_area())) <= rounding, "triangles have the area of the hull");
	const auto heavier = shape.resized(1, bytes.any(10));
	if (heavier) {
		check_shape(*heavier.value());
	}
	step_once(made.value(), bytes);
}

} // namespace softbody::fuzzing
