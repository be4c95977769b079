// SPDX-License-Identifier: MIT
// Claims about the notes of contacts: one for each place, with all its impulses.
#include "core/collision/contact_log.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <map>
#include <tuple>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("a place seen again adds its impulse and keeps what was seen last") {
	ContactLog log;
	log.add({ 3, ContactOther::Kind::BORDER, 0, 5, 5, 0, { 1, 2 }, { 0, 1 }, 2, Real(0.1) });
	log.add({ 3, ContactOther::Kind::BORDER, 0, 5, 6, 0, { 3, 4 }, { 1, 0 }, 5, Real(0.2) });
	REQUIRE(log.contact_points().size() == 1);
	const ContactPoint &seen = log.contact_points()[0];
	CHECK(seen.normal_impulse == 7);
	CHECK(seen.point == Vec2{ 3, 4 });
	CHECK(seen.normal == Vec2{ 1, 0 });
	CHECK(seen.depth == Real(0.2));
	CHECK(seen.hull_point == 6);
}

TEST_CASE("places that differ in body, other, its kind or the part that touches stay apart") {
	ContactLog log;
	log.add({ 1, ContactOther::Kind::BORDER, 2, 3 });
	log.add({ 2, ContactOther::Kind::BORDER, 2, 3 });
	log.add({ 1, ContactOther::Kind::BORDER, 1, 3 });
	log.add({ 1, ContactOther::Kind::COLLIDER, 2, 3 });
	log.add({ 1, ContactOther::Kind::SOFT_BODY, 2, 3 });
	log.add({ 1, ContactOther::Kind::COLLIDER, 2, ContactPoint::CORNER | 3 });
	CHECK(log.contact_points().size() == 6);
}

TEST_CASE("thousands of contact_points are noted as a map would note them, in the order of first sight, also after clearing") {
	ContactLog log;
	Random random(1);
	for (int round = 0; round < 3; ++round) {
		using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
		std::map<Key, Real> impulses;
		std::vector<Key> order;
		for (int i = 0; i < 5000; ++i) {
			const Key key{ std::uint32_t(random.integer(0, 40)), std::uint32_t(random.integer(0, 6)), std::uint32_t(random.integer(0, 15)) };
			if (!impulses.contains(key)) {
				order.push_back(key);
			}
			impulses[key] += Real(i % 8); // whole numbers: their sums are exact
			ContactPoint seen{ std::get<0>(key), ContactOther::Kind::COLLIDER, std::get<1>(key), std::get<2>(key) };
			seen.normal_impulse = Real(i % 8);
			log.add(seen);
		}
		REQUIRE(log.contact_points().size() == order.size());
		for (std::size_t i = 0; i < order.size(); ++i) {
			const ContactPoint &seen = log.contact_points()[i];
			CHECK(Key{ seen.body, seen.other, seen.feature } == order[i]);
			CHECK(seen.normal_impulse == impulses[order[i]]);
		}
		log.clear();
		CHECK(log.contact_points().empty());
	}
}
