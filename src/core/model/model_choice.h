// SPDX-License-Identifier: MIT
// Chooses an elastic model whose error a player does not see.
#pragma once

#include "core/model/material.h"

#include <cstddef>

namespace softbody {

/// Error of an outline, as a share of the body's radius [1], from which a player sees it.
inline constexpr double VISIBLE_ERROR = 0.05;

/// Measured error of a model with `hull_points` [1], the largest of: RMS distance of hull points from a solid of that
/// material over the radius, at rest under its weight, pressed to 0.9 and 0.75 of its height, hung from a point and
/// dropped; and the error of its lowest frequency. The solid is a disk of finite elements; `scripts/bench.sh model`
/// compares these figures with its measurements. Interpolated between measured numbers of points, constant beyond them.
double expected_error(ElasticModel model, std::size_t hull_points);

/// The cheapest model whose error is not visible; if there is none, the one of the least error. Models that need inner
/// points, which the body may not have, are left out.
ElasticModel choose_elastic_model(std::size_t hull_points);

} // namespace softbody
