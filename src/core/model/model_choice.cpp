// SPDX-License-Identifier: MIT
// Chooses an elastic model whose error a player does not see.
#include "core/model/model_choice.h"

#include "core/base/elementary.h"

#include <algorithm>
#include <array>

namespace softbody {

namespace {

constexpr std::array<double, 7> POINTS = { 8, 12, 16, 24, 32, 64, 128 };

// A row a model, from the cheapest to the dearest.
constexpr std::array<std::array<double, POINTS.size()>, 5> ERRORS = { {
		{ 0.113, 0.086, 0.104, 0.320, 0.465, 0.722, 0.861 }, // springs
		{ 0.117, 0.099, 0.098, 0.189, 0.259, 0.353, 0.382 }, // springs and shape
		{ 0.061, 0.054, 0.066, 0.189, 0.259, 0.353, 0.382 }, // springs, shape and area
		{ 0.037, 0.035, 0.028, 0.025, 0.029, 0.024, 0.024 }, // modes
		{ 0.048, 0.031, 0.025, 0.017, 0.014, 0.011, 0.012 }, // triangles, three points inside for two of the hull; XPBD from 64 on
} };

} // namespace

double expected_error(ElasticModel model, std::size_t hull_points) {
	const std::array<double, POINTS.size()> &row = ERRORS[std::size_t(model)];
	const double count = std::clamp(double(hull_points), POINTS.front(), POINTS.back());
	std::size_t above = 1;
	while (POINTS[above] < count) {
		++above;
	}
	const double share = logarithm(count / POINTS[above - 1]) / logarithm(POINTS[above] / POINTS[above - 1]);
	return row[above - 1] + share * (row[above] - row[above - 1]);
}

ElasticModel choose_elastic_model(std::size_t hull_points) {
	ElasticModel best = ElasticModel::SPRINGS;
	for (const ElasticModel model : { ElasticModel::SPRINGS, ElasticModel::SPRINGS_AND_SHAPE, ElasticModel::SPRINGS_SHAPE_AND_AREA, ElasticModel::MODES }) {
		const double error = expected_error(model, hull_points);
		if (error < VISIBLE_ERROR) {
			return model;
		}
		best = error < expected_error(best, hull_points) ? model : best;
	}
	return best;
}

} // namespace softbody
