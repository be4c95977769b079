// SPDX-License-Identifier: MIT
// The broad phase finds every pair that a comparison of all boxes finds, and groups them for threads.
#include "core/collision/broad_phase.h"
#include "support/random.h"
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
		const Vec2 half{ Real(size) * random.real(0.05, 0.5), Real(size) * random.real(0.05, 0.5) };
		bodies.push_back({ { center - half, center + half }, 1u << random.integer(0, 2), std::uint32_t(random.integer(0, 7)) });
	}
	return bodies;
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
			if (bodies[a].box.overlaps(bodies[b].box) && notice(bodies[a], bodies[b])) {
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
			body.box = { body.box.min + away, body.box.max + away };
		}
		BroadPhase broad_phase;
		broad_phase.update(bodies, 1);
		check_complete(broad_phase, bodies);
	}
}

TEST_CASE("boxes that coincide, have no size, touch or are enormous are found like others") {
	const Aabb unit{ { 0, 0 }, { 1, 1 } };
	const Real huge = std::numeric_limits<Real>::max() / 4;
	Bodies bodies;
	for (const Aabb &box : { unit, unit, Aabb{ { 1, 1 }, { 2, 2 } }, Aabb{ { Real(0.5), Real(0.5) }, { Real(0.5), Real(0.5) } },
				 Aabb{ { -huge, -huge }, { huge, huge } }, Aabb{ { huge / 2, 0 }, { huge, 1 } } }) {
		bodies.push_back({ box, 1, 1 });
	}
	BroadPhase broad_phase;
	broad_phase.update(bodies, 1);
	check_complete(broad_phase, bodies);
	CHECK(as_set(broad_phase).contains({ 0, 4 }));

	Bodies points(50, { { { 3, 3 }, { 3, 3 } }, 1, 1 });
	broad_phase.update(points, 2);
	CHECK(broad_phase.pairs().size() == 50 * 49 / 2);
	broad_phase.update({}, 3);
	CHECK(broad_phase.pairs().empty());
}

TEST_CASE("a box that is no number hides no pair of others, and meets whom it meets when it is one again") {
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	const Real inf = std::numeric_limits<Real>::infinity();
	const std::vector<Aabb> bad = { { { nan, nan }, { nan, nan } }, { { nan, 0 }, { 1, 1 } }, { { 0, 0 }, { 1, nan } },
		{ { 0, 0 }, { inf, 1 } }, { { -inf, -inf }, { inf, inf } }, { { inf, inf }, { inf, inf } } };
	Random random(17);
	for (int round = 0; round < 20; ++round) {
		const Bodies sound = random_bodies(random, 80, 4, 0.1, 2);
		Bodies bodies = sound;
		BroadPhase broad_phase;
		broad_phase.update(bodies, 1);
		// A few of them: those alone are sought anew. Most of them: all are.
		const int count = round % 2 == 0 ? 3 : 60;
		for (int i = 0; i < count; ++i) {
			bodies[std::size_t(random.integer(0, 79))].box = bad[std::size_t(random.integer(0, int(bad.size()) - 1))];
		}
		broad_phase.update(bodies, 1);
		for (BroadPhaseBody &body : bodies) {
			if (!std::isfinite(length(body.box.min) + length(body.box.max))) {
				body = { { { nan, nan }, { nan, nan } }, 0, 0 }; // about which nothing is claimed: it meets nobody
			}
		}
		const auto pairs = as_set(broad_phase);
		for (std::uint32_t a = 0; a < bodies.size(); ++a) {
			for (std::uint32_t b = a + 1; b < bodies.size(); ++b) {
				CHECK((!bodies[a].box.overlaps(bodies[b].box) || !notice(bodies[a], bodies[b]) || pairs.contains({ a, b })));
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
			body.box = { body.box.min + way, body.box.max + way };
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
				body.box = { body.box.min + way, body.box.max + way };
			}
			broad_phase.update(bodies, 1);
			check_complete(broad_phase, bodies);
			for (const BodyPair pair : broad_phase.pairs()) {
				const auto reach = [&](std::uint32_t i) { // of a margin on either side, in a box that kept its size
					const Vec2 size = bodies[i].box.max - bodies[i].box.min;
					return bodies[i].box.grown(Real(0.17) * std::max(size.x, size.y));
				};
				CHECK(reach(pair.a).overlaps(reach(pair.b)));
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
		REQUIRE(divided.color_count() == alone.color_count());
		for (std::size_t color = 0; color < alone.color_count(); ++color) {
			CHECK(std::ranges::equal(alone.groups(color), divided.groups(color), {}, &BroadPhase::Group::end,
					&BroadPhase::Group::end));
		}
	}
}

TEST_CASE("no two groups of one color share a body, and the groups hold each pair once") {
	Random random(13);
	for (const double largest : { 1.0, 3.0, 20.0, 400.0 }) {
		Bodies bodies = random_bodies(random, 1500, 25, 0.8, largest);
		for (BroadPhaseBody &body : bodies) {
			body.layer = body.mask = 1;
		}
		BroadPhase broad_phase;
		broad_phase.update(bodies, 1);
		std::vector<int> seen(broad_phase.pairs().size());
		std::size_t most_groups = 0;
		for (std::size_t color = 0; color < broad_phase.color_count(); ++color) {
			std::vector<int> group_of(bodies.size(), -1);
			int number = 0;
			for (const BroadPhase::Group group : broad_phase.groups(color)) {
				const auto pairs = broad_phase.pairs().subspan(group.begin, group.end - group.begin);
				CHECK(std::ranges::is_sorted(pairs)); // so that their order does not tell how they were found
				for (std::uint32_t i = group.begin; i < group.end; ++i) {
					++seen[i];
					for (const std::uint32_t body : { broad_phase.pairs()[i].a, broad_phase.pairs()[i].b }) {
						CHECK((group_of[body] == -1 || group_of[body] == number));
						group_of[body] = number;
					}
				}
				++number;
			}
			most_groups = std::max(most_groups, broad_phase.groups(color).size());
		}
		CHECK(std::ranges::count(seen, 1) == std::ptrdiff_t(seen.size()));
		if (largest == 1) {
			CHECK(most_groups > 20); // there is work for many threads
		}
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
			body.box = { body.box.min + Vec2{ 5000, 0 }, body.box.max + Vec2{ 5000, 0 } };
			body.layer = body.mask = 1u << 31;
			bodies.push_back(body);
		}
		const Real far = round % 2 == 0 ? Real(1e30) : std::numeric_limits<Real>::quiet_NaN();
		bodies.back().box = { { 5000, far }, { far, far } };
		BroadPhase together;
		together.update(bodies, 1);
		std::vector<BodyPair> ours;
		std::ranges::copy_if(together.pairs(), std::back_inserter(ours), [&](BodyPair pair) { return pair.b < heap.size(); });
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
