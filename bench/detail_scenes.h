// SPDX-License-Identifier: MIT
// Outlines of many points and the bodies that stand for them, for the parts of the bench `detail`.
#pragma once

#include "elastic_bodies.h"
#include "soft_pile.h"

#include "core/creator/simplify_outline.h"
#include "core/model/world_data.h"

#include <string>
#include <vector>

namespace bench {

inline constexpr double DETAIL_GRAVITY = 980; ///< [px/s²]
inline constexpr double DETAIL_TOLERANCE = 0.03; ///< of the radius, the default of a node

/// A drawn outline about its centroid [px].
struct OutlineKind {
	std::string name;
	Points outline;
};
/// A character, and unless `is_quick` a circle, a blob and a traced blob: 200 to 300 points.
std::vector<OutlineKind> fine_outlines(bool is_quick);

/// A body with a node's default values and the drawn outline's kind of self-collision; it does not fall asleep.
ElasticBody outline_body(const Points &hull, bool has_deep_dents, bool balanced = false);

/// The hull at a tolerance; `most_points` as in `SimplifyOptions`.
softbody::SimplifiedOutline simplified(const Points &outline, double tolerance, int most_points = 0);

/// The largest distance of the one from the other [px], by brute force and in both directions.
double outline_distance(const Points &a, const Points &b);

/// Sets places and velocities of a body's hull; a center point goes to their means, as a node puts it there.
void place_points(softbody::SoftBodyData &body, const Points &positions, const Points &velocities);

/// An empty world as nodes have it, with weight.
softbody::WorldData weighty_world();

} // namespace bench
