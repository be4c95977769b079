// SPDX-License-Identifier: MIT
// Cuts of any body along any line: refused by name, or simple pieces that lose nothing.
#include "core/creator/body_cut.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "fuzz/bytes.h"
#include "fuzz/targets.h"
#include "scenes/cut_oracles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softbody::fuzzing {

namespace {

constexpr double EPSILON = double(std::numeric_limits<Real>::epsilon());

// Round about a middle, on a coarse grid, or of any places.
std::vector<Vec2> read_outline(Bytes &bytes) {
	const int kind = std::max(0, bytes.integer(-2, 2)); // most random places cross themselves
	const int count = bytes.integer(3, kind == 0 ? 64 : 9);
	std::vector<Vec2> points;
	for (int i = 0; i < count; ++i) {
		if (kind == 0) {
			const double angle = 2 * std::numbers::pi * i / count;
			const double radius = 5 + double(bytes.byte()) / 5;
			points.push_back({ Real(radius * std::cos(angle)), Real(radius * std::sin(angle)) });
		} else if (kind == 1) {
			const int byte = bytes.byte();
			points.push_back({ Real(byte % 16 * 5), Real(byte / 16 * 5) });
		} else {
			points.push_back(bytes.vector(50));
		}
	}
	return points;
}

struct Sums {
	double mass = 0;
	Vec2d momentum;
	double spin = 0;
	double size = 0; ///< of all that is summed in `momentum`
	double spin_size = 0;

	void add(const SoftBodyData &body) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			const double m = double(body.shape().masses()[i]);
			const Vec2d place(body.positions()[i]);
			const Vec2d velocity(body.velocities()[i]);
			mass += m;
			momentum += velocity * m;
			spin += m * cross(place, velocity);
			size += m * (std::abs(velocity.x) + std::abs(velocity.y));
			spin_size += m * (std::abs(place.x) + std::abs(place.y)) * (std::abs(velocity.x) + std::abs(velocity.y));
		}
	}
};

void require_named(const Error &error) {
	require(!error.name.empty() && !error.value.empty() && !error.bound.empty() && !error.remedy.empty(), "a refusal has a name, a value, a bound and a remedy");
}

} // namespace

void fuzz_cut(std::span<const std::uint8_t> data) {
	Bytes bytes(data);
	const std::vector<Vec2> outline = read_outline(bytes);
	StructureOptions options;
	options.center_point = bytes.chance();
	for (int i = bytes.integer(0, 4); i > 0; --i) {
		options.inner_points.push_back(bytes.vector(40));
	}
	const auto shape = SoftBodyCreator::create_polygon(outline, options);
	if (!shape) {
		return require_named(shape.error());
	}
	const Vec2 middle = bytes.vector(bytes.chance() ? 100 : 3000);
	SoftBodyData body = SoftBodyData::create(shape.value(), {}, { middle, Rotation::from_angle(bytes.real(3)) }).value();
	const Real strain = bytes.chance() ? bytes.positive(0.5) : Real(0);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 arm = body.positions()[i] - middle;
		const Vec2 moved = middle + Vec2{ arm.x * (1 + strain), arm.y } + Vec2{ Real(0), arm.x * arm.x * strain / 100 };
		(void)body.set_point(i, moved, bytes.vector(300));
	}
	for (int i = bytes.integer(0, 2); i > 0; --i) {
		(void)body.set_pinned(std::uint32_t(bytes.integer(0, int(std::min<std::size_t>(body.point_count(), 200)) - 1)), true);
	}
	BodyCutLimits limits;
	limits.smallest_piece = bytes.byte() < 40 ? bytes.any(0.5) : bytes.positive(0.1);
	limits.least_width = bytes.byte() < 40 ? bytes.any(5) : Real(0);
	limits.most_pieces = bytes.byte() < 40 ? bytes.integer(0, 3) : 64;
	std::vector<Vec2> blade;
	for (int i = bytes.integer(0, 9); i > 0; --i) {
		const int kind = bytes.byte();
		if (kind < 60) { // a corner
			blade.push_back(body.hull()[std::size_t(kind) % body.shape().hull_count()]);
		} else {
			blade.push_back(kind < 62 ? bytes.any_vector(100) : middle + bytes.vector(100));
		}
	}
	const auto cut = plan_cut(body, options, blade, limits);
	const auto made = cut_body(body, options, blade, limits);
	if (!cut) {
		require(!made, "what cannot be planned is not made");
		return require_named(cut.error());
	}
	const std::vector<Vec2> hull(body.hull().begin(), body.hull().end());
	std::vector<Vec2> rest;
	for (const Vec2 p : body.shape().rest_hull()) {
		rest.push_back(p + body.shape().origin_offset());
	}
	const testing::CutFacts facts = testing::facts_of(hull, rest, { .least_area = double(limits.smallest_piece) * double(body.shape().rest_area()) * (1 - 1e-5) }, cut.value().polygon);
	// Places have few digits far from the origin, and a slender body's area hangs on the last of them.
	double reach = 0;
	for (const Vec2 p : hull) {
		reach = std::max({ reach, double(std::abs(p.x)), double(std::abs(p.y)) });
	}
	const double rounding = 64 * EPSILON * reach * double(perimeter(hull)) / std::min(testing::shoelace(hull), testing::shoelace(rest));
	const bool is_rounding = facts.violation.starts_with("areas") && facts.area_error <= rounding;
	require(facts.violation.empty() || is_rounding, facts.violation.c_str());
	if (!made) {
		return require_named(made.error());
	}
	Sums before;
	before.add(body);
	Sums after;
	WorldData world;
	std::size_t pins = 0;
	for (const SoftBodyData &piece : made.value()) {
		after.add(piece);
		pins += piece.has_pins();
		require(!is_folded(piece.hull()), "a piece is not folded");
		for (const Vec2 velocity : piece.velocities()) {
			require(is_finite(velocity), "velocities are finite");
		}
		world.add_soft_body(piece);
	}
	require(std::abs(after.mass / before.mass - 1) <= 256 * EPSILON, "mass is divided");
	require((pins > 0) == body.has_pins(), "a pinned body leaves a pinned piece");
	if (!body.has_pins()) {
		require(std::hypot(after.momentum.x - before.momentum.x, after.momentum.y - before.momentum.y) <= 64 * EPSILON * (before.size + after.size), "momentum is kept");
		require(std::abs(after.spin - before.spin) <= 256 * EPSILON * (before.spin_size + after.spin_size), "angular momentum is kept");
	}
	Simulator simulator(world);
	simulator.simulate(Real(1) / 60);
	for (const SoftBodyData &piece : world.soft_bodies()) {
		require(std::ranges::all_of(piece.positions(), [](Vec2 p) { return is_finite(p); }), "the pieces go on");
	}
}

} // namespace softbody::fuzzing
