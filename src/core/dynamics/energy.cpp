// SPDX-License-Identifier: MIT
// Energy and momentum of a body.
#include "core/dynamics/energy.h"

#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"

#include <cmath>

namespace softbody {

Energy measure_energy(const SoftBodyData &body, Vec2 gravity) {
	const SoftBodyShape &shape = body.shape();
	const BodyFrame frame = measure_frame(body);
	const double per_mass = double(shape.point_count()) / shape.total_mass();
	const Vec2 acceleration = gravity * body.settings().gravity_scale;
	Energy energy;
	for (std::size_t i = 0; i < shape.point_count(); ++i) {
		const double mass = shape.masses()[i];
		const Vec2 v = body.velocities()[i];
		const Vec2 p = body.positions()[i];
		const Vec2 strain = frame.centre + frame.rotation.apply(shape.rest_positions()[i]) - p;
		energy.kinetic += mass * (double(v.x) * v.x + double(v.y) * v.y) / 2;
		energy.shape += mass * per_mass * body.settings().shape_stiffness *
				(double(strain.x) * strain.x + double(strain.y) * strain.y) / 2;
		energy.gravity -= mass * (double(acceleration.x) * p.x + double(acceleration.y) * p.y);
	}
	const double excess = signed_area(body.hull()) - double(body.settings().inflation) * shape.rest_area();
	energy.pressure = body.settings().pressure_stiffness * excess * excess / (2 * double(shape.rest_area()));
	for (const Spring2D &spring : shape.springs()) {
		const Vec2 a = body.positions()[spring.a];
		const Vec2 b = body.positions()[spring.b];
		const double stretch = std::hypot(double(b.x) - a.x, double(b.y) - a.y) - spring.rest_length;
		energy.springs += spring.stiffness * stretch * stretch / 2;
	}
	return energy;
}

Momentum measure_momentum(const SoftBodyData &body, Vec2 origin) {
	Momentum momentum;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double mass = body.shape().masses()[i];
		const Vec2 v = body.velocities()[i];
		const Vec2 p = body.positions()[i];
		momentum.linear_x += mass * v.x;
		momentum.linear_y += mass * v.y;
		momentum.angular += mass * ((double(p.x) - origin.x) * v.y - (double(p.y) - origin.y) * v.x);
	}
	return momentum;
}

} // namespace softbody
