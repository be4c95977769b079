// SPDX-License-Identifier: MIT
// Checks and derived quantities of a soft body's structure.
#include "core/model/soft_body_shape.h"

#include "core/base/constants.h"
#include "core/base/elementary.h"
#include "core/geometry/polygon.h"
#include "core/geometry/round_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace softbody {

namespace {

Status check_spring(const Spring2D &spring, std::size_t index, std::size_t point_count) {
	const std::string name = "springs[" + std::to_string(index) + "]";
	if (spring.a >= point_count || spring.b >= point_count) {
		return Error{ name, "points " + std::to_string(spring.a) + " and " + std::to_string(spring.b),
			"must name points below " + std::to_string(point_count), "use indices of existing points" };
	}
	if (spring.a == spring.b) {
		return Error{ name, "point " + std::to_string(spring.a) + " twice", "must join two different points",
			"choose another end point" };
	}
	return first_error({ check_above(name + ".rest_length", spring.rest_length, 0, ""),
			check_at_least(name + ".stiffness", spring.stiffness, 0, "N/m"), check_at_least(name + ".damping", spring.damping, 0, "N·s/m") });
}

Status check_duplicates(const std::vector<Spring2D> &springs) {
	using Key = std::pair<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;
	std::vector<Key> keys;
	keys.reserve(springs.size());
	for (std::size_t i = 0; i < springs.size(); ++i) {
		keys.push_back({ std::minmax(springs[i].a, springs[i].b), i });
	}
	std::sort(keys.begin(), keys.end());
	for (std::size_t i = 1; i < keys.size(); ++i) {
		if (keys[i].first == keys[i - 1].first) {
			return Error{ "springs[" + std::to_string(keys[i].second) + "]",
				"points " + std::to_string(keys[i].first.first) + " and " + std::to_string(keys[i].first.second),
				"must not repeat spring " + std::to_string(keys[i - 1].second), "remove one of the two springs" };
		}
	}
	return {};
}

Status check_triangles(const SoftBodyShape::Description &description) {
	if (description.triangles == nullptr) {
		return {};
	}
	if (description.modes != nullptr) {
		return Error{ "triangles", "beside modes", "must be the only elastic model of a shape", "leave out one of the two" };
	}
	const std::vector<ElasticTriangle> &triangles = description.triangles->triangles;
	for (std::size_t i = 0; i < triangles.size(); ++i) {
		const std::string name = "triangles[" + std::to_string(i) + "]";
		for (const std::uint32_t corner : triangles[i].corners) {
			if (Status status = check_index(name, corner, description.points.size(), "use indices of existing points")) {
				return status;
			}
		}
		if (Status status = check_above(name + ".area", triangles[i].area, 0, "")) {
			return status;
		}
		if (!is_finite(triangles[i].gradients[0]) || !is_finite(triangles[i].gradients[1])) {
			return Error{ name, "non-finite gradients", "must be finite", "scale the outline" };
		}
	}
	return {};
}

Status check(const SoftBodyShape::Description &description) {
	const std::size_t count = description.points.size();
	if (description.hull_count > count) {
		return Error{ "hull_count", std::to_string(description.hull_count), "must be <= " + std::to_string(count),
			"add the missing points" };
	}
	const std::span<const Vec2> hull(description.points.data(), description.hull_count);
	if (Status status = first_error({ check_hull(hull), check_all_finite("points", description.points) })) {
		return status;
	}
	if (signed_area(hull) < 0) {
		return Error{ "hull", "negative winding", "must wind from x towards y (positive signed area)",
			"reverse the order of the hull points" };
	}
	if (description.masses.size() != count) {
		return Error{ "masses", std::to_string(description.masses.size()) + " entries",
			"must have " + std::to_string(count) + " entries", "give one mass a point" };
	}
	for (std::size_t i = 0; i < count; ++i) {
		if (Status status = check_above("masses[" + std::to_string(i) + "]", description.masses[i], 0, "kg")) {
			return status;
		}
	}
	for (std::size_t i = 0; i < description.springs.size(); ++i) {
		if (Status status = check_spring(description.springs[i], i, count)) {
			return status;
		}
	}
	if (description.modes != nullptr && (description.modes->shapes.size() != count * description.modes->count ||
												description.modes->dilation.size() != description.hull_count)) {
		return Error{ "modes", std::to_string(description.modes->shapes.size()) + " entries",
			"must have one a point and mode", "find the modes of these points" };
	}
	if (Status status = first_error({ check_triangles(description), check_duplicates(description.springs) })) {
		return status;
	}
	if (description.chain.empty()) {
		return {};
	}
	if (!description.springs.empty() || description.modes != nullptr || description.triangles != nullptr) {
		return Error{ "chain", "beside springs, modes or triangles", "must be the only structure of a shape", "leave out the others" };
	}
	return ChainShape(description.chain).check(description.hull_count, count);
}

} // namespace

Result<std::shared_ptr<const SoftBodyShape>> SoftBodyShape::create(Description description) {
	if (Status status = check(description)) {
		return *status;
	}
	// Not make_shared: the constructor is private, so that no unchecked shape can exist.
	std::shared_ptr<SoftBodyShape> shape(new SoftBodyShape());
	shape->rest_positions_ = std::move(description.points);
	shape->masses_ = std::move(description.masses);
	shape->springs_ = std::move(description.springs);
	shape->modes_ = std::move(description.modes);
	shape->triangles_ = std::move(description.triangles);
	shape->hull_count_ = description.hull_count;
	if (!description.chain.empty()) {
		shape->chain_.emplace(std::move(description.chain));
	}
	if (Status status = shape->derive()) {
		return *status;
	}
	return std::shared_ptr<const SoftBodyShape>(std::move(shape));
}

Status SoftBodyShape::derive() {
	double mass = 0;
	double x = 0;
	double y = 0;
	for (std::size_t i = 0; i < rest_positions_.size(); ++i) {
		mass += masses_[i];
		x += double(masses_[i]) * rest_positions_[i].x;
		y += double(masses_[i]) * rest_positions_[i].y;
	}
	inverse_masses_.clear();
	for (const Real each : masses_) {
		inverse_masses_.push_back(1 / each);
	}
	const Vec2 center{ Real(x / mass), Real(y / mass) };
	origin_offset_ += center;
	total_mass_ = Real(mass);
	for (Vec2 &position : rest_positions_) {
		position -= center;
	}
	is_tense_ = std::ranges::any_of(springs_, [this](const Spring2D &spring) {
		const Real line = length(rest_positions_[spring.b] - rest_positions_[spring.a]);
		return spring.stiffness > 0 && std::abs(spring.rest_length - line) > SLACK_SPRING * line;
	});
	measure();
	renew_bounds();
	if (Status status = chain_ ? chain_->measure(rest_positions_, masses_) : Status()) {
		return status;
	}
	return check_derived();
}

// What follows from rest positions and masses.
void SoftBodyShape::measure() {
	double inertia = 0;
	Real reach_squared = 0;
	for (std::size_t i = 0; i < rest_positions_.size(); ++i) {
		inertia += double(masses_[i]) * length_squared(rest_positions_[i]);
		reach_squared = std::max(reach_squared, length_squared(rest_positions_[i]));
	}
	rest_inertia_ = Real(inertia);
	radius_ = std::sqrt(reach_squared);
	rest_area_ = signed_area(rest_hull());
	width_ = 2 * rest_area_ / perimeter(rest_hull());

	area_inverse_mass_ = 0;
	least_hull_mass_ = masses_[0];
	Real shortest_squared = length_squared(rest_positions_[0] - rest_positions_[hull_count_ - 1]);
	for (std::size_t i = 0; i < hull_count_; ++i) {
		const Vec2 across = rest_positions_[(i + 1) % hull_count_] - rest_positions_[(i + hull_count_ - 1) % hull_count_];
		area_inverse_mass_ += length_squared(across) / (4 * masses_[i]);
		least_hull_mass_ = std::min(least_hull_mass_, masses_[i]);
		shortest_squared = std::min(shortest_squared, length_squared(rest_positions_[(i + 1) % hull_count_] - rest_positions_[i]));
	}
	shortest_hull_edge_ = std::sqrt(shortest_squared);
	bulges_ = edge_bulges(rest_hull());
	greatest_bulge_ = std::ranges::max(bulges_);
	if (!(greatest_bulge_ > 0)) {
		bulges_.clear();
	}
}

void SoftBodyShape::renew_bounds() {
	spring_frequency_squared_ = Real(largest_rate(&Spring2D::stiffness));
	spring_damping_rate_ = Real(largest_rate(&Spring2D::damping));
	rest_spring_frequency_squared_ = std::min(Real(rest_rate(&Spring2D::stiffness)), spring_frequency_squared_);
	rest_spring_damping_rate_ = std::min(Real(rest_rate(&Spring2D::damping)), spring_damping_rate_);
	const auto [shear, dilation] = largest_triangle_inverse_masses();
	triangle_shear_inverse_mass_ = Real(shear);
	triangle_dilation_inverse_mass_ = Real(dilation);
}

// Each number may be in range and derived ones not: areas of hulls of 1e20, inverses of masses of 1e-40.
Status SoftBodyShape::check_derived() const {
	const auto is_usable = [](Real value) { return std::isfinite(value) && value >= std::numeric_limits<Real>::min(); };
	const auto check = [](bool is_good, const char *name, const char *value, const char *remedy) {
		return is_good ? Status() : Error{ name, value, "must stay within the range of numbers", remedy };
	};
	const bool has_size = is_usable(rest_area_) && is_usable(radius_ * radius_) && is_usable(width_) &&
			is_usable(shortest_hull_edge_ * shortest_hull_edge_) && is_finite(origin_offset_);
	const bool has_mass = is_usable(total_mass_) && std::ranges::all_of(inverse_masses_, is_usable) &&
			is_usable(rest_inertia_) && is_usable(area_inverse_mass_);
	return first_error({ check(has_size, "hull", "too large or too small", "scale the outline"),
			check(has_mass, "mass", "too large or too small", "give a mass that fits the body's size"),
			check(std::isfinite(spring_frequency_squared_), "stiffness", "too large for the masses", "give less stiffness or more mass"),
			check(std::isfinite(triangle_shear_inverse_mass_) && std::isfinite(triangle_dilation_inverse_mass_), "triangles",
					"too thin for the masses", "give more mass or fewer points"),
			check(std::isfinite(spring_damping_rate_), "damping", "too large for the masses", "give less damping or more mass") });
}

// Bound of the largest eigenvalue of M^-1 N for a non-negative symmetric matrix N; `apply` multiplies by N.
template <class Apply>
double SoftBodyShape::largest_eigenvalue(const Apply &apply) const {
	// 16 iterations: on wheels and lattices the quotient is then within 1 % of its limit.
	constexpr int ITERATIONS = 16;
	std::vector<double> x(point_count(), 1.0);
	std::vector<double> image(point_count());
	double bound = std::numeric_limits<double>::infinity();
	for (int iteration = 0; iteration < ITERATIONS; ++iteration) {
		std::fill(image.begin(), image.end(), 0.0);
		apply(x, image);
		double largest = 0;
		for (std::size_t i = 0; i < image.size(); ++i) {
			image[i] /= masses_[i];
			largest = std::max(largest, image[i] / x[i]);
		}
		bound = std::min(bound, largest);
		if (!(bound > 0)) {
			return 0;
		}
		if (!std::isfinite(bound)) {
			return bound; // otherwise NaN would pass for a bound
		}
		// A point without such springs keeps its entry positive, as it is divided by.
		for (std::size_t i = 0; i < image.size(); ++i) {
			x[i] = std::max(image[i] / bound, 1e-3 * x[i]);
		}
	}
	return bound;
}

double SoftBodyShape::largest_rate(Real Spring2D::*coefficient) const {
	return largest_eigenvalue([&](const std::vector<double> &x, std::vector<double> &image) {
		for (const Spring2D &spring : springs_) {
			const double sum = double(spring.*coefficient) * (x[spring.a] + x[spring.b]);
			image[spring.a] += sum;
			image[spring.b] += sum;
		}
	});
}

// Largest eigenvalue of M^-1 H, where H is the sum of c d dᵀ over the springs, d their directions at rest.
double SoftBodyShape::rest_rate(Real Spring2D::*coefficient) const {
	constexpr int ITERATIONS = 32;
	struct Vector {
		double x = 0, y = 0;
	};
	std::vector<Vector> moved(point_count());
	std::vector<Vector> image(point_count());
	for (std::size_t i = 0; i < moved.size(); ++i) {
		moved[i] = { double(i * 37 % 19) - 9.5, double(i * 53 % 23) - 11.5 }; // in no direction that a symmetric body prefers
	}
	double rate = 0;
	for (int iteration = 0; iteration < ITERATIONS; ++iteration) {
		std::fill(image.begin(), image.end(), Vector{});
		for (const Spring2D &spring : springs_) {
			const Vec2 way = rest_positions_[spring.b] - rest_positions_[spring.a];
			const double size_squared = double(way.x) * way.x + double(way.y) * way.y;
			const auto along = [&](const Vector &v) { return v.x * way.x + v.y * way.y; };
			const double force = size_squared > 0 ? double(spring.*coefficient) * (along(moved[spring.b]) - along(moved[spring.a])) / size_squared : 0;
			image[spring.a].x -= force * way.x;
			image[spring.a].y -= force * way.y;
			image[spring.b].x += force * way.x;
			image[spring.b].y += force * way.y;
		}
		// Rayleigh's quotient of `moved`, then the next one, of unit length weighted by mass.
		double product = 0;
		double size = 0;
		double image_size = 0;
		for (std::size_t i = 0; i < moved.size(); ++i) {
			product += moved[i].x * image[i].x + moved[i].y * image[i].y;
			size += masses_[i] * (moved[i].x * moved[i].x + moved[i].y * moved[i].y);
			image_size += (image[i].x * image[i].x + image[i].y * image[i].y) / masses_[i];
		}
		rate = product / size;
		if (!(image_size > 0) || !std::isfinite(image_size)) {
			break;
		}
		for (std::size_t i = 0; i < moved.size(); ++i) {
			const double factor = 1 / (masses_[i] * std::sqrt(image_size));
			moved[i] = { image[i].x * factor, image[i].y * factor };
		}
	}
	return rate;
}

namespace {

// Coupling of the two coordinates of one point with those of another: a 2 x 2 block of a Hessian.
struct Block {
	std::array<std::array<double, 2>, 2> entries{};

	/// Adds factor · p qᵀ.
	void add(Vec2 p, Vec2 q, double factor) {
		entries[0][0] += factor * p.x * q.x;
		entries[0][1] += factor * p.x * q.y;
		entries[1][0] += factor * p.y * q.x;
		entries[1][1] += factor * p.y * q.y;
	}
	/// Its largest singular value.
	double norm() const {
		const auto [top, bottom] = entries;
		return (hypotenuse(top[0] + bottom[1], bottom[0] - top[1]) + hypotenuse(top[0] - bottom[1], bottom[0] + top[1])) / 2;
	}
};

struct Coupling {
	std::uint32_t a, b; ///< points, a <= b
	Block shear;
	Block dilation;
};

// The Hessians, over μ and over K, of shear and of dilation at rest, by pairs of points. With g the gradient of a
// corner's linear function, u has the derivative (g.x, -g.y), v has (g.y, g.x), and J has g.
std::vector<Coupling> couplings_of(const ElasticTriangles &mesh) {
	std::vector<Coupling> parts;
	for (const ElasticTriangle &triangle : mesh.triangles) {
		const auto [g1, g2] = triangle.gradients;
		const std::array<Vec2, 3> gradients = { -(g1 + g2), g1, g2 };
		for (std::size_t k = 0; k < 3; ++k) {
			for (std::size_t l = 0; l < 3; ++l) {
				if (triangle.corners[k] > triangle.corners[l]) {
					continue;
				}
				const Vec2 p = gradients[k];
				const Vec2 q = gradients[l];
				Coupling part{ triangle.corners[k], triangle.corners[l], {}, {} };
				part.shear.add({ p.x, -p.y }, { q.x, -q.y }, triangle.area);
				part.shear.add({ p.y, p.x }, { q.y, q.x }, triangle.area);
				part.dilation.add(p, q, triangle.area);
				parts.push_back(part);
			}
		}
	}
	// Stable, as the parts of one pair are added up in this order and libraries sort equal ones differently.
	std::ranges::stable_sort(parts, {}, [](const Coupling &c) { return std::pair(c.a, c.b); });
	std::vector<Coupling> couplings;
	for (const Coupling &part : parts) {
		if (couplings.empty() || couplings.back().a != part.a || couplings.back().b != part.b) {
			couplings.push_back(part);
			continue;
		}
		for (std::size_t row = 0; row < 2; ++row) {
			for (std::size_t column = 0; column < 2; ++column) {
				couplings.back().shear.entries[row][column] += part.shear.entries[row][column];
				couplings.back().dilation.entries[row][column] += part.dilation.entries[row][column];
			}
		}
	}
	return couplings;
}

} // namespace

// Shear, then dilation.
std::array<double, 2> SoftBodyShape::largest_triangle_inverse_masses() const {
	if (triangles_ == nullptr) {
		return { 0, 0 };
	}
	const std::vector<Coupling> couplings = couplings_of(*triangles_);
	const auto bound_of = [&](Block Coupling::*block) {
		return largest_eigenvalue([&](const std::vector<double> &x, std::vector<double> &image) {
			for (const Coupling &coupling : couplings) {
				const double norm = (coupling.*block).norm();
				image[coupling.a] += norm * x[coupling.b];
				if (coupling.a != coupling.b) {
					image[coupling.b] += norm * x[coupling.a];
				}
			}
		});
	};
	return { bound_of(&Coupling::shear), bound_of(&Coupling::dilation) };
}

Result<std::shared_ptr<const SoftBodyShape>> SoftBodyShape::resized(Real factor, Real total_mass) const {
	if (Status status = first_error({ check_above("factor", factor, 0, ""), check_above("mass", total_mass, 0, "kg") })) {
		return *status;
	}
	std::shared_ptr<SoftBodyShape> copy(new SoftBodyShape(*this));
	const Real mass_factor = total_mass / total_mass_;
	for (Real &mass : copy->masses_) {
		mass *= mass_factor;
	}
	if (factor != 1) {
		copy->enlarge(factor);
	}
	if (Status status = copy->derive()) {
		return *status;
	}
	return std::shared_ptr<const SoftBodyShape>(std::move(copy));
}

void SoftBodyShape::move_rest(std::span<const Vec2> places, const SoftBodyShape &first) {
	std::ranges::copy(places, rest_positions_.begin());
	for (std::size_t i = 0; i < springs_.size(); ++i) {
		const Spring2D &before = first.springs_[i];
		const Real distance = length(first.rest_positions_[before.b] - first.rest_positions_[before.a]);
		springs_[i].rest_length = before.rest_length * (length(places[before.b] - places[before.a]) / distance);
	}
	measure();
	if (first.modes_ != nullptr) {
		auto modes = std::make_shared<ElasticModes>(*first.modes_);
		double gradient_norm = 0;
		for (std::size_t i = 0; i < hull_count_; ++i) {
			const Vec2 last = places[i == 0 ? hull_count_ - 1 : i - 1];
			const Vec2 next = places[i + 1 == hull_count_ ? 0 : i + 1];
			modes->dilation[i] = Vec2{ next.y - last.y, last.x - next.x } * (1 / (4 * rest_area_));
			gradient_norm += double(length_squared(modes->dilation[i])) / masses_[i];
		}
		for (std::size_t j = 0; j < modes->count; ++j) {
			double overlap = 0;
			for (std::size_t i = 0; i < places.size(); ++i) {
				overlap += double(dot(modes->shapes[i * modes->count + j], places[i]));
			}
			modes->dilation_overlap[j] = Real(overlap);
		}
		modes->projection_bound = Real(std::max(1.0, gradient_norm * rest_inertia_));
		modes_ = std::move(modes);
	}
	if (first.triangles_ != nullptr) {
		auto mesh = std::make_shared<ElasticTriangles>(*first.triangles_);
		for (ElasticTriangle &triangle : mesh->triangles) {
			const auto [a, b, c] = triangle.corners;
			const Vec2 e1 = places[b] - places[a];
			const Vec2 e2 = places[c] - places[a];
			const Real twice_area = cross(e1, e2);
			triangle.area = twice_area / 2;
			triangle.gradients = { Vec2{ e2.y, -e2.x } * (1 / twice_area), Vec2{ -e1.y, e1.x } * (1 / twice_area) };
		}
		triangles_ = std::move(mesh);
	}
}

void SoftBodyShape::enlarge(Real factor) {
	const Real inverse = 1 / factor;
	origin_offset_ *= factor;
	for (Vec2 &position : rest_positions_) {
		position *= factor;
	}
	for (Spring2D &spring : springs_) {
		spring.rest_length *= factor;
	}
	if (modes_ != nullptr) {
		auto modes = std::make_shared<ElasticModes>(*modes_);
		for (Vec2 &derivative : modes->dilation) {
			derivative *= inverse;
		}
		for (Real &overlap : modes->dilation_overlap) {
			overlap *= factor;
		}
		modes_ = std::move(modes);
	}
	if (triangles_ != nullptr) {
		auto mesh = std::make_shared<ElasticTriangles>(*triangles_);
		for (ElasticTriangle &triangle : mesh->triangles) {
			triangle.area *= factor * factor;
			triangle.gradients[0] *= inverse;
			triangle.gradients[1] *= inverse;
		}
		triangles_ = std::move(mesh);
	}
}

} // namespace softbody
