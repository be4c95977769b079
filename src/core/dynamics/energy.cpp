// SPDX-License-Identifier: MIT
// Energy of a body.
#include "core/dynamics/energy.h"

#include "core/dynamics/elastic_lanes.h"
#include "core/dynamics/triangle_lanes.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"

#include <cmath>

namespace softbody {

namespace {

double mode_energy(const SoftBodyData &body, std::span<const Vec2> positions, const BodyFrame &frame) {
	const SoftBodyShape &shape = body.shape();
	const ElasticModes &modes = *shape.modes();
	const ModeStiffness<Real> stiffness = mode_stiffness(modes, body.settings());
	std::array<double, MAX_ELASTIC_MODES> amplitudes{};
	double dilation = 0;
	double along = 0;
	double squares = 0;
	for (std::size_t i = 0; i < shape.point_count(); ++i) {
		const Vec2 q = shape.rest_positions()[i];
		const Vec2 y = frame.rotation.apply_inverse(positions[i] - frame.center) - q;
		const double share = double(shape.masses()[i]) / shape.total_mass();
		const std::span<const Vec2> mode = modes.shape_of_point(i);
		for (std::size_t j = 0; j < mode.size(); ++j) {
			amplitudes[j] += double(dot(mode[j], y));
		}
		dilation += i < shape.hull_count() ? double(dot(modes.dilation[i], y)) : 0.0;
		along += share * dot(q, y);
		squares += share * length_squared(y);
	}
	// Energy of the displacement without its dilation.
	squares += dilation * (dilation * shape.rest_inertia() / shape.total_mass() - 2 * along);
	double twice = stiffness.rest * squares;
	for (std::size_t j = 0; j < modes.count; ++j) {
		const double amplitude = amplitudes[j] - dilation * modes.dilation_overlap[j];
		twice += (double(stiffness.modes[j]) - stiffness.rest) * amplitude * amplitude;
	}
	return twice / 2;
}

double triangle_energy(const SoftBodyData &body, std::span<const Vec2> positions) {
	const BodySettings &settings = body.settings();
	double energy = 0;
	for (const ElasticTriangle &triangle : body.shape().triangles()->triangles) {
		const auto [a, b, c] = triangle.corners;
		const Vec2 e1 = positions[b] - positions[a];
		const Vec2 e2 = positions[c] - positions[a];
		const TriangleShear<Real> shear = triangle_shear<Real>(triangle, e1, e2);
		const Real ratio = cross(e1, e2) / (2 * triangle.area);
		const TriangleDilation<Real> dilation = triangle_dilation<Real>(settings.inflation, coefficients_of<Real>(settings), ratio, shear);
		const double sheared = double(shear.u) * shear.u + double(shear.v) * shear.v;
		energy += triangle.area * (settings.shear_modulus * sheared / 2 + dilation_energy(settings.area_stiffness, dilation));
	}
	return energy;
}

} // namespace

Energy measure_energy(const SoftBodyData &body, Vec2 gravity) {
	return measure_energy(body, body.positions(), body.velocities(), gravity);
}

Energy measure_energy(const SoftBodyData &body, std::span<const Vec2> positions, std::span<const Vec2> velocities, Vec2 gravity) {
	const SoftBodyShape &shape = body.shape();
	const BodyFrame frame = measure_frame(body, positions, velocities);
	const double per_mass = double(shape.point_count()) / shape.total_mass();
	const Vec2 acceleration = gravity * body.settings().gravity_scale;
	Energy energy;
	for (std::size_t i = 0; i < shape.point_count(); ++i) {
		const double mass = shape.masses()[i];
		const Vec2 v = velocities[i];
		const Vec2 p = positions[i];
		const Vec2 strain = frame.center + frame.rotation.apply(shape.rest_positions()[i]) - p;
		energy.kinetic += mass * (double(v.x) * v.x + double(v.y) * v.y) / 2;
		energy.shape += mass * per_mass * body.settings().shape_stiffness *
				(double(strain.x) * strain.x + double(strain.y) * strain.y) / 2;
		energy.gravity -= mass * (double(acceleration.x) * p.x + double(acceleration.y) * p.y);
	}
	const double excess = signed_area(positions.first(shape.hull_count())) - double(body.settings().inflation) * shape.rest_area();
	if (holds_area(shape, body.settings())) {
		energy.area = body.settings().area_stiffness * excess * excess / (2 * double(shape.rest_area()));
	}
	if (body.settings().is_elastic() && shape.modes() != nullptr) {
		energy.modes = mode_energy(body, positions, frame);
	}
	if (has_triangles(shape, body.settings())) {
		energy.triangles = triangle_energy(body, positions);
	}
	energy.pressure = body.settings().pressure_stiffness * excess * excess / (2 * double(shape.rest_area()));
	for (const Spring2D &spring : shape.springs()) {
		const Vec2 a = positions[spring.a];
		const Vec2 b = positions[spring.b];
		const double stretch = std::sqrt((double(b.x) - a.x) * (double(b.x) - a.x) + (double(b.y) - a.y) * (double(b.y) - a.y)) - spring.rest_length;
		energy.springs += double(spring.stiffness) * body.settings().spring_stiffness_scale * stretch * stretch / 2;
	}
	return energy;
}

} // namespace softbody
