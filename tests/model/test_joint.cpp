// SPDX-License-Identifier: MIT
// Anchors of joints on a body.
#include "core/model/joint.h"

#include "core/creator/soft_body_creator.h"
#include "core/model/soft_body_data.h"

#include <doctest/doctest.h>

#include <vector>

using namespace softbody;

namespace {

// A square of side 2 with a point in its middle.
SoftBodyData square() {
	const std::vector<Vec2> hull{ { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
	return SoftBodyData::create(SoftBodyCreator::create_polygon(hull, {}).value(), {}).value();
}

} // namespace

TEST_CASE("the nearest anchor of a body is on its hull or one of its inner points") {
	const SoftBodyData body = square();
	const BodyId id{ 3, 4 };
	CHECK(nearest_anchor(body, id, { 5, Real(0.5) }) == JointAnchor::on_edge(id, 1, Real(0.75)));
	CHECK(nearest_anchor(body, id, { Real(0.25), 9 }) == JointAnchor::on_edge(id, 2, Real(0.375)));
	CHECK(nearest_anchor(body, id, { Real(0.1), Real(0.1) }) == JointAnchor::on_point(id, 4));
	CHECK_FALSE(nearest_anchor(body, id, { 5, 0 }) == nearest_anchor(body, id, { 5, Real(0.5) }));
}

TEST_CASE("an anchor moves with the body that it is on") {
	SoftBodyData body = square();
	const JointAnchor on_edge = JointAnchor::on_edge({}, 3, Real(0.25)); // from (-1, 1) to (-1, -1)
	CHECK(position_of(on_edge, body) == Vec2{ -1, Real(0.5) });
	CHECK(position_of(JointAnchor::on_point({}, 4), body) == Vec2{ 0, 0 });
	REQUIRE(!body.set_point(0, { -1, -3 }, {}));
	CHECK(position_of(on_edge, body) == Vec2{ -1, 0 });
}
