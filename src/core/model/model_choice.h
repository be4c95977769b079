// SPDX-License-Identifier: MIT
// Which elastic model is enough for what a player sees.
#pragma once

#include "core/model/material.h"

#include <cstddef>

namespace softbody {

/// Error of an outline, as a share of the body's radius [1], from which a player sees it.
inline constexpr double VISIBLE_ERROR = 0.05;

/// Measured error of a model whose hull has that many points [1]: the largest of the RMS distances of hull points from a solid
/// of the same material, over the radius, at rest under its weight, pressed to 0.9 and 0.75 of its height, hung from a point
/// and dropped; and of the error of its lowest frequency. The solid is a disk of finite elements (`scripts/bench.sh model`, which
/// compares these figures with what it measures). Between the measured numbers of points it is interpolated, beyond them constant.
double expected_error(ElasticModel model, std::size_t hull_points);

/// The cheapest model whose error no player sees; where there is none, that of the least error. Models that need inner points,
/// which the body may not have, are left out.
ElasticModel choose_elastic_model(std::size_t hull_points);

} // namespace softbody
