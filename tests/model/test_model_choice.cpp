// SPDX-License-Identifier: MIT
// Which elastic model is enough: whatever the number of points, the cheapest that no player can tell from a solid.
#include "core/model/model_choice.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace softbody;

TEST_CASE("the model chosen is the cheapest whose error is invisible, for any number of points") {
	for (std::size_t points = 3; points <= 4096; ++points) {
		const ElasticModel chosen = choose_elastic_model(points);
		REQUIRE(expected_error(chosen, points) < VISIBLE_ERROR);
		for (int cheaper = 0; cheaper < int(chosen); ++cheaper) {
			REQUIRE(expected_error(ElasticModel(cheaper), points) >= VISIBLE_ERROR);
		}
	}
}

TEST_CASE("errors between two measured numbers of points lie between theirs, and beyond them stay") {
	for (const ElasticModel model : { ElasticModel::SPRINGS, ElasticModel::MODES }) {
		const double one = expected_error(model, 16);
		const double other = expected_error(model, 24);
		CHECK(expected_error(model, 20) > std::min(one, other));
		CHECK(expected_error(model, 20) < std::max(one, other));
		CHECK(expected_error(model, 3) == expected_error(model, 8));
		CHECK(expected_error(model, 1000) == expected_error(model, 128));
	}
}
