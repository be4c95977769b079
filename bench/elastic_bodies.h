// SPDX-License-Identifier: MIT
// Bodies of an elastic material under every model that can stand for it, and outlines to make them of.
#pragma once

#include "bodies.h"

#include "core/model/body_settings.h"
#include "core/model/material.h"

#include <span>
#include <string>

namespace bench {

inline constexpr double PIXELS_A_METER = 100; ///< as Godot's 2D physics counts
inline constexpr double TICK = 1.0 / 60; ///< [s]

/// A model, and how result files name it. A new ElasticModel is one more entry of `elastic_models`.
struct ModelChoice {
	std::string name;
	softbody::ElasticModel model = softbody::ElasticModel::MODES;
	double inner_points = 0; ///< inside a body of triangles, for each of its hull points
	bool is_old_network = false; ///< no material at all: the network of springs that was the default before there were any
};
std::span<const ModelChoice> elastic_models();
/// The one that a node has by default.
const ModelChoice &default_model();

struct ElasticBody {
	Shape shape;
	softbody::BodySettings settings; ///< limits as in a game, friction 0, never asleep, automatic plan
};

/// A body of that outline [px]. The old network has k = 100 N/m, c = 0.12 N s/m and shape matching whatever the material says;
/// of the material it takes only whether there is damping to speak of. With `balanced` the center of mass is the area's centroid, as a
/// node has it for a hull that stands for an outline of more points.
ElasticBody elastic_body(const ModelChoice &choice, const Points &hull, double mass, const softbody::Material &material, bool balanced = false);

/// Evenly on a circle; with `on_edge` an edge is lowest, else a corner. For counts that are multiples of four.
Points circle(double radius, int count, bool on_edge);
/// The sides divided evenly, always the one with the longest pieces, until there are `count` points. As bench/fem does it.
Points divided(const Points &corners, int count);
/// `count` points evenly along a closed outline, the first half a piece from its start.
Points spaced(const Points &outline, int count);

} // namespace bench
