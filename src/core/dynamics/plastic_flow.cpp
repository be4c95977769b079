// SPDX-License-Identifier: MIT
// Dents: the shape at rest follows what strains the body too far.
#include "core/dynamics/plastic_flow.h"

#include "core/base/elementary.h"
#include "core/dynamics/energy.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// Share of its area below which a body is crumpled, and its displacements tell nothing of its strain [1].
constexpr Real LEAST_FLOWING_AREA = Real(0.25);

// Tolerance of `max_dent` [1], as keeping the area moves all points after the lines were limited.
constexpr Real DENT_TOLERANCE = Real(0.01);

Real line_length(const Spring2D &spring, std::span<const Vec2> places) {
	return length(places[spring.b] - places[spring.a]);
}

double elastic_energy(const SoftBodyData &body) {
	const Energy energy = measure_energy(body, {});
	return energy.total() - energy.kinetic;
}

} // namespace

bool PlasticFlow::flow(SoftBodyData &body, Real h) {
	const BodySettings &settings = body.settings();
	if (!find_shares(body)) {
		return false;
	}
	const std::span<const Vec2> hull = body.hull();
	if (!(signed_area(hull) > LEAST_FLOWING_AREA * body.shape().rest_area()) || is_folded(hull)) {
		return false;
	}
	const Real rate = 1 - Real(exponential(double(-settings.flow_rate * h)));
	const std::vector<Vec2> before(body.shape().rest_positions().begin(), body.shape().rest_positions().end());
	const double energy_before = elastic_energy(body);
	for (const bool is_uniform : { false, true }) {
		if (is_uniform) {
			Real sum = 0;
			for (const Real share : shares_) {
				sum += share;
			}
			std::ranges::fill(shares_, sum / Real(shares_.size()));
		}
		if (!place(body, rate)) {
			continue;
		}
		if (exceeds(body, settings.max_dent)) {
			limit(body);
			if (!place(body, rate) || exceeds(body, settings.max_dent + DENT_TOLERANCE)) {
				continue;
			}
		}
		body.move_rest(places_);
		if (elastic_energy(body) <= energy_before) {
			return true;
		}
		body.move_rest(before);
	}
	return false;
}

// False if no line yields.
bool PlasticFlow::find_shares(const SoftBodyData &body) {
	const SoftBodyShape &shape = body.shape();
	const BodySettings &settings = body.settings();
	shares_.assign(shape.point_count(), Real(0));
	Real stiffness = 0;
	for (const Spring2D &spring : shape.springs()) {
		stiffness += spring.stiffness;
	}
	stiffness /= Real(std::max<std::size_t>(1, shape.springs().size()));
	bool yields = false;
	for (const Spring2D &spring : shape.springs()) {
		const Real strain = line_length(spring, body.positions()) / line_length(spring, shape.rest_positions()) - 1;
		const Real yield = stiffness > 0 ? settings.yield_strain * spring.stiffness / stiffness : settings.yield_strain;
		const bool counts = settings.dent_by == DentBy::BOTH || (strain < 0) == (settings.dent_by == DentBy::COMPRESSION);
		if (counts && std::abs(strain) > yield) {
			const Real share = 1 - yield / std::abs(strain);
			shares_[spring.a] = std::max(shares_[spring.a], share);
			shares_[spring.b] = std::max(shares_[spring.b], share);
			yields = true;
		}
	}
	return yields;
}

// Rest positions after flow, with the center, the orientation and the area of those before. False if they are folded.
bool PlasticFlow::place(const SoftBodyData &body, Real rate) {
	const SoftBodyShape &shape = body.shape();
	const std::span<const Vec2> rest = shape.rest_positions();
	const BodyFrame frame = measure_frame(body);
	if (!frame.rotation_defined) {
		return false;
	}
	places_.assign(rest.begin(), rest.end());
	double x = 0;
	double y = 0;
	for (std::size_t i = 0; i < places_.size(); ++i) {
		const Vec2 moved = frame.rotation.apply_inverse(body.positions()[i] - frame.center) - rest[i];
		places_[i] += moved * (rate * shares_[i]);
		x += double(shape.masses()[i]) * places_[i].x;
		y += double(shape.masses()[i]) * places_[i].y;
	}
	const Vec2 center{ Real(x / shape.total_mass()), Real(y / shape.total_mass()) };
	double c = 0;
	double s = 0;
	for (std::size_t i = 0; i < places_.size(); ++i) {
		places_[i] -= center;
		c += shape.masses()[i] * double(dot(rest[i], places_[i]));
		s += shape.masses()[i] * double(cross(rest[i], places_[i]));
	}
	const double size = std::sqrt(c * c + s * s);
	const double area = signed_area(std::span<const Vec2>(places_).first(shape.hull_count()));
	const double kept_area = body.shared_shape()->rest_area();
	if (!(size > 0) || !(area > LEAST_FLOWING_AREA * kept_area)) {
		return false;
	}
	const double scale = std::sqrt(kept_area / area);
	const Rotation turn{ Real(c / size), Real(s / size) };
	for (Vec2 &each : places_) {
		each = turn.apply_inverse(each) * Real(scale);
	}
	return !is_folded(std::span<const Vec2>(places_).first(shape.hull_count()));
}

// Holds the ends of lines that would change too much.
void PlasticFlow::limit(const SoftBodyData &body) {
	const std::span<const Vec2> first = body.shared_shape()->rest_positions();
	for (const Spring2D &spring : body.shared_shape()->springs()) {
		if (std::abs(line_length(spring, places_) / line_length(spring, first) - 1) > body.settings().max_dent) {
			shares_[spring.a] = 0;
			shares_[spring.b] = 0;
		}
	}
}

bool PlasticFlow::exceeds(const SoftBodyData &body, Real most) const {
	const std::span<const Vec2> first = body.shared_shape()->rest_positions();
	return std::ranges::any_of(body.shared_shape()->springs(), [&](const Spring2D &spring) {
		return std::abs(line_length(spring, places_) / line_length(spring, first) - 1) > most;
	});
}

} // namespace softbody
