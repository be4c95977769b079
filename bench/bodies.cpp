// SPDX-License-Identifier: MIT
// Bodies and deformations that several benches share.
#include "bodies.h"

#include "thesis/damping_ratio.h"
#include "scenes/circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace bench {

namespace {

using softbody::BodySettings;
using softbody::Real;
using softbody::SoftBodyShape;
using softbody::Spring2D;
using softbody::Vec2;

constexpr double TAU = 2 * std::numbers::pi;

Vec2 on_circle(double angle, double radius) {
	return { Real(std::cos(angle) * radius), Real(std::sin(angle) * radius) };
}

Vec2 in_disk(Random &random, double radius) {
	const double angle = random.uniform(0, TAU);
	return on_circle(angle, radius * std::sqrt(random.uniform(0, 1)));
}

// The points between the axes of a random frame and the world's: `map` sees coordinates along and across a random
// direction.
template <typename Map>
void along_random_direction(Points &points, Random &random, Map map) {
	const softbody::Rotation frame = softbody::Rotation::from_angle(Real(random.uniform(0, TAU)));
	for (Vec2 &p : points) {
		p = frame.apply(map(frame.apply_inverse(p)));
	}
}

void add_spring(std::vector<Spring2D> &springs, const Points &points, std::size_t a, std::size_t b) {
	springs.push_back({ std::uint32_t(a), std::uint32_t(b), length(points[b] - points[a]), 1, 0 });
}

// Neighbors, center, and for half of the bodies about a chord a point.
std::vector<Spring2D> random_springs(const Points &points, std::size_t hull_count, Random &random) {
	std::vector<Spring2D> springs;
	for (std::size_t i = 0; i < hull_count; ++i) {
		add_spring(springs, points, i, (i + 1) % hull_count);
		if (points.size() > hull_count) {
			add_spring(springs, points, i, hull_count);
		}
	}
	if (hull_count < 5 || random.uniform(0, 1) < 0.5) {
		return springs;
	}
	std::set<std::pair<std::size_t, std::size_t>> chords;
	for (std::size_t i = 0; i < hull_count; ++i) {
		const std::size_t other = (i + std::size_t(random.integer(2, int(hull_count) - 2))) % hull_count;
		if (chords.insert({ std::min(i, other), std::max(i, other) }).second) {
			add_spring(springs, points, i, other);
		}
	}
	return springs;
}

} // namespace

std::uint64_t Random::next() {
	std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return z ^ (z >> 31);
}

double Random::uniform(double low, double high) {
	return low + (high - low) * double(next() >> 11) * 0x1p-53;
}

double Random::log_uniform(double low, double high) {
	return low * std::pow(high / low, uniform(0, 1));
}

int Random::integer(int low, int high) {
	return low + int(next() % std::uint64_t(high - low + 1));
}

Shape circle_shape(int hull_points, bool center_point, double stiffness, double damping_ratio) {
	softbody::StructureOptions options;
	options.mass = 1;
	options.stiffness = Real(stiffness);
	options.center_point = center_point;
	options.damping = softbody::damping_for_ratio(
			Real(damping_ratio), options.stiffness, options.mass, std::size_t(hull_points + (center_point ? 1 : 0)));
	return take(softbody::testing::circle_shape(Real(0.5), hull_points, options));
}

void set_shape_matching(BodySettings &settings, const SoftBodyShape &shape, double stiffness) {
	const double mass = double(shape.total_mass()) / double(shape.point_count());
	settings.shape_stiffness = Real(stiffness);
	settings.shape_damping = Real(2 * 0.25 * std::sqrt(stiffness * mass));
}

const char *deformation_name(Deformation deformation) {
	static constexpr std::array names = { "flattened", "point_through_centre", "folded", "crumpled", "mirrored" };
	return names[std::size_t(deformation)];
}

Points deformed(const SoftBodyShape &shape, Deformation deformation, Random &random) {
	Points points(shape.rest_positions().begin(), shape.rest_positions().end());
	const double radius = shape.radius();
	switch (deformation) {
		case Deformation::FLATTENED: {
			const auto squeeze = Real(random.uniform(0, 0.1));
			const auto stretch = Real(random.uniform(1, 1.3));
			along_random_direction(points, random, [=](Vec2 p) { return Vec2{ p.x * stretch, p.y * squeeze }; });
			break;
		}
		case Deformation::POINT_THROUGH_CENTER: {
			const auto point = std::size_t(random.integer(0, int(shape.hull_count()) - 1));
			points[point] *= -Real(random.uniform(0.3, 1.2));
			break;
		}
		case Deformation::FOLDED: {
			const auto line = Real(random.uniform(-0.4, 0.4) * radius);
			along_random_direction(
					points, random, [=](Vec2 p) { return Vec2{ p.x > line ? 2 * line - p.x : p.x, p.y }; });
			break;
		}
		case Deformation::CRUMPLED:
			for (Vec2 &p : points) {
				p = in_disk(random, radius);
			}
			break;
		case Deformation::MIRRORED:
			along_random_direction(points, random, [](Vec2 p) { return Vec2{ -p.x, p.y }; });
			for (Vec2 &p : points) {
				p += in_disk(random, 0.02 * radius);
			}
			break;
	}
	const softbody::Rotation turn = softbody::Rotation::from_angle(Real(random.uniform(0, TAU)));
	for (Vec2 &p : points) {
		p = turn.apply(p);
	}
	return points;
}

softbody::SoftBodyData body_at(const Shape &shape, const BodySettings &settings, const Points &points) {
	softbody::SoftBodyData body = take(softbody::SoftBodyData::create(shape, settings));
	for (std::size_t i = 0; i < points.size(); ++i) {
		check(body.set_point(std::uint32_t(i), points[i], {}));
	}
	return body;
}

const char *model_name(Model model) {
	static constexpr std::array names = { "springs", "shape_matching", "pressure", "both" };
	return names[std::size_t(model)];
}

RandomBody random_body(Random &random, double least_damping) {
	RandomBody body;
	SoftBodyShape::Description description;
	description.hull_count = std::size_t(std::lround(random.log_uniform(3, 64)));
	const double bumpiness = random.uniform(0, 0.5);
	const double start = random.uniform(0, TAU);
	for (std::size_t i = 0; i < description.hull_count; ++i) {
		const double angle = start + TAU * double(i) / double(description.hull_count);
		description.points.push_back(on_circle(angle, 0.5 * (1 - bumpiness * random.uniform(0, 1))));
	}
	if (random.uniform(0, 1) < 0.75) {
		description.points.push_back(Vec2{});
	}
	description.springs = random_springs(description.points, description.hull_count, random);

	body.mass_ratio = random.log_uniform(1, 1e4);
	double total = 0;
	for (std::size_t i = 0; i < description.points.size(); ++i) {
		description.masses.push_back(Real(random.log_uniform(1, body.mass_ratio)));
		total += description.masses.back();
	}
	for (Real &mass : description.masses) {
		mass = Real(mass / total);
	}

	body.stiffness_ratio = random.log_uniform(1, 1e6);
	body.damping_ratio = least_damping > 0 ? random.log_uniform(least_damping, 0.3) : 0;
	const double stiffness = random.log_uniform(10, 1e5);
	const double spread = std::sqrt(body.stiffness_ratio);
	for (Spring2D &spring : description.springs) {
		const double k = stiffness * random.log_uniform(1 / spread, spread);
		const double mass = std::min(description.masses[spring.a], description.masses[spring.b]);
		spring.stiffness = Real(k);
		spring.damping = Real(body.damping_ratio * std::sqrt(k * mass));
	}
	body.shape = take(SoftBodyShape::create(std::move(description)));

	body.model = MODELS[std::size_t(random.integer(0, 3))];
	if (body.model == Model::SHAPE_MATCHING || body.model == Model::BOTH) {
		set_shape_matching(body.settings, *body.shape, 0.4 * stiffness);
	}
	if (body.model == Model::PRESSURE || body.model == Model::BOTH) {
		body.settings.pressure_stiffness = Real(2 * stiffness);
	}
	return body;
}

} // namespace bench
