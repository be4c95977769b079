// SPDX-License-Identifier: MIT
// The broad phase finds every pair that a comparison of all circles finds, and colors them for threads.
#include "core/collision/broad_phase.h"
#include "support/random.h"
#include "core/geometry/circle.h"
#include "core/model/pose.h"
#include "support/threads.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

using Bodies = std::vector<BroadPhaseBody>;

Bodies random_bodies(Random &random, int count, double spread, double smallest, double largest) {
	Bodies bodies;
	for (int i = 0; i < count; ++i) {
		const Vec2 center = random.vector(spread);
		const double size = smallest * std::pow(largest / smallest, double(random.real(0, 1)));
		bodies.push_back({ center, Real(size) * random.real(0.05, 0.5), 1u << random.integer(0, 2), std::uint32_t(random.integer(0, 7)) });
	}
	return bodies;
}

bool overlap(const BroadPhaseBody &a, const BroadPhaseBody &b) {
	return length(a.center - b.center) <= a.radius + b.radius;
}

bool notice(const BroadPhaseBody &a, const BroadPhaseBody &b) {
	return (a.mask & b.layer) != 0 || (b.mask & a.layer) != 0;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> as_set(const BroadPhase &broad_phase) {
	std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
	for (const BodyPair pair : broad_phase.pairs()) {
		CHECK(pair.a < pair.b);
		CHECK(pairs.insert({ pair.a, pair.b }).second); // none twice
	}
	return pairs;
}

// Everything that overlaps now must be among the pairs, and nothing whose layers do not meet.
void check_complete(const BroadPhase &broad_phase, const Bodies &bodies) {
	const auto pairs = as_set(broad_phase);
	for (std::uint32_t a = 0; a < bodies.size(); ++a) {
		for (std::uint32_t b = a + 1; b < bodies.size(); ++b) {
			if (overlap(bodies[a], bodies[b]) && notice(bodies[a], bodies[b])) {
				CHECK(pairs.contains({ a, b }));
			}
			if (!notice(bodies[a], bodies[b])) {
				CHECK_FALSE(pairs.contains({ a, b }));
			}
		}
	}
}

} // namespace

TEST_CASE("every overlapping pair is found, at any mixture of sizes and far from the origin") {
	Random random(11);
	for (int round = 0; round < 60; ++round) {
		const double ratio = round % 3 == 0 ? 1 : (round % 3 == 1 ? 30 : 1e5);
		Bodies bodies = random_bodies(random, 120, 8, 1 / ratio, 4);
		const Vec2 away = random.vector(round % 2 == 0 ? 0 : 1000);
		for (BroadPhaseBody &body : bodies) {
			body.center += away;
		}
		BroadPhase broad_phase;
		broad_phase.update(bodies, 1);
		check_complete(broad_phase, bodies);
	}
}

TEST_CASE("circles that coincide, have no size, touch or are enormous are found like others") {
	const Real huge = std::numeric_limits<Real>::max() / 4;
	Bodies bodies;
	for (const Circle &circle : { Circle{ { 0, 0 }, 1 }, Circle{ { 0, 0 }, 1 }, Circle{ { 2, 0 }, 1 }, Circle{ { Real(0.5), 0 }, 0 },
				 Circle{ { 0, 0 }, huge }, Circle{ { huge, 0 }, huge / 2 } }) {
		bodies.push_back({ circle.center, circle.radius, 1, 1 });
	}
	BroadPhase broad_phase;
	broad_phase.update(bodies, 1);
	check_complete(broad_phase, bodies);
	CHECK(as_set(broad_phase).contains({ 0, 2 }));
	CHECK(as_set(broad_phase).contains({ 0, 4 }));

	Bodies points(50, { { 3, 3 }, 0, 1, 1 });
	broad_phase.update(points, 2);
	CHECK(broad_phase.pairs().size() == 50 * 49 / 2);
	broad_phase.update({}, 3);
	CHECK(broad_phase.pairs().empty());
}

TEST_CASE("a circle that is no number hides no pair of others, and meets whom it meets when it is one again") {
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	const Real inf = std::numeric_limits<Real>::infinity();
	const std::vector<Circle> bad = { { { nan, nan }, nan }, { { nan, 0 }, 1 }, { { 0, 0 }, nan }, { { 0, 0 }, inf }, { { inf, 0 }, inf },
		{ { inf, inf }, 1 } };
	Random random(17);
	for (int round = 0; round < 20; ++round) {
		const Bodies sound = random_bodies(random, 80, 4, 0.1, 2);
		Bodies bodies = sound;
		BroadPhase broad_phase;
		broad_phase.update(bodies, 1);
		// A few of them: those alone are sought anew. Most of them: all are.
		const int count = round % 2 == 0 ? 3 : 60;
		for (int i = 0; i < count; ++i) {
			BroadPhaseBody &body = bodies[std::size_t(random.integer(0, 79))];
			const Circle &circle = bad[std::size_t(random.integer(0, int(bad.size()) - 1))];
			body.center = circle.center;
			body.radius = circle.radius;
		}
		broad_phase.update(bodies, 1);
		for (BroadPhaseBody &body : bodies) {
			if (!std::isfinite(length(body.center) + body.radius)) {
				body = { { nan, nan }, nan, 0, 0 }; // about which nothing is claimed: it meets nobody
			}
		}
		const auto pairs = as_set(broad_phase);
		for (std::uint32_t a = 0; a < bodies.size(); ++a) {
			for (std::uint32_t b = a + 1; b < bodies.size(); ++b) {
				CHECK((!overlap(bodies[a], bodies[b]) || !notice(bodies[a], bodies[b]) || pairs.contains({ a, b })));
			}
		}
		broad_phase.update(sound, 1);
		check_complete(broad_phase, sound);
	}
}

TEST_CASE("pairs hold while bodies stay within their margins, and are complete when they do not") {
	Random random(12);
	Bodies bodies = random_bodies(random, 200, 10, 0.5, 2);
	BroadPhase broad_phase;
	broad_phase.update(bodies, 1);
	const std::uint64_t first = broad_phase.rebuild_count();
	broad_phase.update(bodies, 1);
	CHECK(broad_phase.rebuild_count() == first);
	int kept = 0;
	for (int step = 0; step < 200; ++step) {
		for (BroadPhaseBody &body : bodies) {
			const Vec2 way = random.vector(step < 100 ? 0.0005 : 0.05);
			body.center += way;
		}
		const std::uint64_t before = broad_phase.rebuild_count();
		broad_phase.update(bodies, 1);
		kept += int(broad_phase.rebuild_count() == before);
		check_complete(broad_phase, bodies);
	}
	CHECK(kept > 50);
	CHECK(kept < 150);
	broad_phase.update(bodies, 2); // other bodies, though their boxes are the same
	bodies.pop_back();
	broad_phase.update(bodies, 3);
	check_complete(broad_phase, bodies);
}

TEST_CASE("where a few bodies move, of any size, their new pairs come and their old ones go") {
	Random random(14);
	for (const double largest : { 2.0, 40.0 }) {
		Bodies bodies = random_bodies(random, 300, 15, 0.5, largest);
		BroadPhase broad_phase;
		broad_phase.update(bodies, 1);
		for (int step = 0; step < 150; ++step) {
			for (int k = 0; k < 12; ++k) {
				BroadPhaseBody &body = bodies[std::size_t(random.integer(0, 299))];
				const Vec2 way = random.vector(k < 10 ? 1 : 30);
				body.center += way;
			}
			broad_phase.update(bodies, 1);
			check_complete(broad_phase, bodies);
			for (const BodyPair pair : broad_phase.pairs()) {
				CHECK(overlap(bodies[pair.a], bodies[pair.b]));
			}
		}
		CHECK(broad_phase.rebuild_count() > 140);
		CHECK(broad_phase.sought_bodies() < 300 + 150 * 12 + 1); // never all again
	}
}

TEST_CASE("pairs and groups are the same for any number of threads" * doctest::test_suite("threads")) {
	Random random(15);
	const Bodies bodies = random_bodies(random, 3000, 40, 0.5, 3);
	BroadPhase alone;
	alone.update(bodies, 1);
	for (const std::size_t threads : { 2u, 3u, 8u }) {
		BroadPhase divided;
		divided.update(bodies, 1, on_threads(threads));
		CHECK(std::ranges::equal(alone.pairs(), divided.pairs()));
		REQUIRE(divided.phase_count() == alone.phase_count());
		for (std::size_t phase = 0; phase < alone.phase_count(); ++phase) {
			CHECK(std::ranges::equal(alone.groups(phase), divided.groups(phase), {}, &BroadPhase::Group::end, &BroadPhase::Group::end));
		}
	}
}

TEST_CASE("no two groups of one phase share a body, and the groups hold each pair once") {
	Random random(13);
	for (const double largest : { 1.0, 3.0, 20.0, 400.0 }) {
		Bodies bodies = random_bodies(random, 1500, 25, 0.8, largest);
		for (BroadPhaseBody &body : bodies) {
			body.layer = body.mask = 1;
		}
		BroadPhase broad_phase;
		broad_phase.update(bodies, 1);
		std::uint32_t end = 0;
		std::size_t most_groups = 0;
		for (std::size_t phase = 0; phase < broad_phase.phase_count(); ++phase) {
			std::vector<int> group_of(bodies.size(), -1);
			int number = 0;
			for (const BroadPhase::Group group : broad_phase.groups(phase)) {
				CHECK(group.begin == end);
				CHECK(group.begin < group.end);
				end = group.end;
				const auto pairs = broad_phase.pairs().subspan(group.begin, group.end - group.begin);
				CHECK(std::ranges::is_sorted(pairs)); // so that their order does not tell how they were found
				for (const BodyPair pair : pairs) {
					for (const std::uint32_t body : { pair.a, pair.b }) {
						CHECK((group_of[body] == -1 || group_of[body] == number));
						group_of[body] = number;
					}
				}
				++number;
			}
			most_groups = std::max(most_groups, broad_phase.groups(phase).size());
		}
		CHECK(end == broad_phase.pairs().size());
		if (largest == 1) {
			CHECK(most_groups >= 4); // there is work for several threads
		}
	}
}

TEST_CASE("pairs and their order do not depend on the direction from which bodies are seen") {
	Random random(18);
	for (int round = 0; round < 200; ++round) {
		const Bodies bodies = random_bodies(random, 60, 6, 0.5, 3);
		Bodies turned = bodies;
		const Rotation turn = Rotation::from_angle(random.real(-3, 3));
		for (BroadPhaseBody &body : turned) {
			body.center = turn.apply(body.center);
		}
		bool is_close_call = false; // a pair whose circles touch within rounding
		for (std::size_t a = 0; a < bodies.size(); ++a) {
			for (std::size_t b = 0; b < a; ++b) {
				is_close_call |= std::abs(length(bodies[a].center - bodies[b].center) - bodies[a].radius - bodies[b].radius) < Real(1e-4);
			}
		}
		BroadPhase straight;
		straight.update(bodies, 1);
		BroadPhase slanted;
		slanted.update(turned, 1);
		CHECK((is_close_call || std::ranges::equal(straight.pairs(), slanted.pairs())));
	}
}

TEST_CASE("the order of a heap's pairs does not depend on what is elsewhere") {
	Random random(16);
	const Bodies heap = random_bodies(random, 400, 12, 0.8, 3);
	BroadPhase alone;
	alone.update(heap, 1);
	for (int round = 0; round < 20; ++round) {
		// Others far away, of quite other sizes; one of them has blown up, or is nowhere.
		Bodies bodies = heap;
		for (BroadPhaseBody body : random_bodies(random, random.integer(1, 800), 30, 0.8, random.real(0.01, 40))) {
			body.center += Vec2{ 5000, 0 };
			bodies.push_back(body);
		}
		// It overlaps all others, until it is reset.
		const Real far = round % 2 == 0 ? Real(1e15) : std::numeric_limits<Real>::quiet_NaN();
		bodies.back().center.y = far;
		bodies.back().radius = far;
		BroadPhase together;
		together.update(bodies, 1);
		std::vector<BodyPair> ours;
		std::ranges::copy_if(together.pairs(), std::back_inserter(ours), [&](BodyPair pair) { return pair.b < heap.size(); });
		CHECK(ours.size() == alone.pairs().size());
		// As far as it matters: of each body.
		for (std::uint32_t body = 0; body < heap.size(); ++body) {
			const auto has_body = [&](BodyPair pair) { return pair.a == body || pair.b == body; };
			std::vector<BodyPair> expected;
			std::vector<BodyPair> found;
			std::ranges::copy_if(alone.pairs(), std::back_inserter(expected), has_body);
			std::ranges::copy_if(ours, std::back_inserter(found), has_body);
			REQUIRE(found == expected);
		}
	}
}
