// SPDX-License-Identifier: MIT
// Discs that dent, and their drop onto a floor.
#pragma once

#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "core/model/material.h"
#include "scenes/jelly.h"

#include <array>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace softbody::testing {

inline constexpr std::array<ElasticModel, 5> MODELS = { ElasticModel::SPRINGS, ElasticModel::SPRINGS_AND_SHAPE,
	ElasticModel::SPRINGS_SHAPE_AND_AREA, ElasticModel::MODES, ElasticModel::TRIANGLES };

inline std::vector<Vec2> circle_of(Real radius, int count) {
	std::vector<Vec2> hull;
	for (int i = 0; i < count; ++i) {
		const Real angle = 2 * std::numbers::pi_v<Real> * Real(i) / Real(count);
		const Rotation turn = Rotation::from_angle(angle);
		hull.push_back(Vec2{ turn.c, turn.s } * radius);
	}
	return hull;
}

struct Metal {
	ElasticModel model = ElasticModel::MODES;
	Real yield = Real(0.05);
	Real rate = 40;
	Real most = Real(0.5);
	DentBy by = DentBy::BOTH;
	Material material = { 2000, Real(0.3), Real(0.3) };
};

inline SoftBodyData metal_body(std::span<const Vec2> hull, const Metal &metal, Vec2 center) {
	StructureOptions options;
	options.stiffness = 1;
	options.damping = 1;
	options.elastic = metal.model == ElasticModel::MODES;
	options.elastic_triangles = metal.model == ElasticModel::TRIANGLES;
	const auto shape = SoftBodyCreator::create_polygon(hull, options).value();
	BodySettings settings;
	if (apply_material(metal.material, metal.model, *shape, settings)) {
		throw std::logic_error("the metal's material is refused");
	}
	settings.yield_strain = metal.yield;
	settings.flow_rate = metal.rate;
	settings.max_dent = metal.most;
	settings.dent_by = metal.by;
	settings.rolling_resistance = Real(0.03);
	return SoftBodyData::create(shape, settings, { center, {} }).value();
}

inline SoftBodyData metal_disc(const Metal &metal, Vec2 center) {
	return metal_body(circle_of(50, 16), metal, center);
}

inline WorldData floor_world() {
	WorldData world = pixel_world();
	if (world.add_border(floor_at(0))) {
		throw std::logic_error("the floor is refused");
	}
	return world;
}

/// Drops a disc from `height` above the floor for `seconds`, in a world of its own. Returns that world.
inline WorldData drop_metal(const Metal &metal, Real height, int rate, double seconds) {
	WorldData world = floor_world();
	world.add_soft_body(metal_disc(metal, { 0, -50 - height }));
	Simulator simulator(world);
	for (int i = 0; i < int(seconds * rate); ++i) {
		simulator.simulate(Real(1) / Real(rate));
	}
	return world;
}

} // namespace softbody::testing
