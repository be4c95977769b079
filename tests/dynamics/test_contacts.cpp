// SPDX-License-Identifier: MIT
// What a simulation tells about contacts: how hard bodies rest on things, and when touches begin and end.
#include "core/base/constants.h"
#include "core/dynamics/simulator.h"
#include "scenes/chain.h"
#include "scenes/mixed.h"
#include "scenes/thesis_body.h"
#include "support/batches.h"
#include "support/compare.h"
#include "support/threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TICK = Real(1) / 60;
constexpr Real PULL = Real(9.81);
const Rotation HALF_A_CORNER = Rotation::from_angle(Real(0.39269908)); // a body turned by it lies on an edge

BodySettings monitored(Real restitution = 0) {
	BodySettings settings;
	settings.shape_stiffness = 400;
	settings.shape_damping = 4;
	settings.rolling_resistance = Real(0.05);
	settings.restitution = restitution;
	settings.contact_monitor = true;
	return settings;
}

SoftBodyData ball(Vec2 place, const BodySettings &settings = monitored()) {
	return thesis_body(thesis_shape_with_ratio(1000, Real(0.1)), settings, { place, HALF_A_CORNER });
}

Surface tagged(std::uint64_t tag) {
	Surface surface;
	surface.tag = tag;
	return surface;
}

struct Scene {
	WorldData world;
	Simulator simulator{ world };

	explicit Scene(Vec2 gravity = { 0, -PULL }) { world.set_gravity(gravity); }
	void step(int count = 1) {
		for (int i = 0; i < count; ++i) {
			simulator.simulate(TICK);
			for (const ContactEvent &event : simulator.contact_events()) {
				history.push_back(event);
			}
		}
	}
	/// What was told since this was last asked: "+tag" or "+sN" for begins, "-" likewise for ends.
	std::string told() {
		std::string text;
		for (const ContactEvent &event : history) {
			const ContactOther &other = event.other;
			text += event.kind == ContactEvent::Kind::BEGIN ? '+' : '-';
			text += other.kind == ContactOther::Kind::SOFT_BODY ? "s" + std::to_string(other.body.index) : std::to_string(other.tag);
		}
		history.clear();
		return text;
	}
	bool sleeps(BodyId id) {
		for (int i = 0; i < 1200 && !world.find(id)->is_asleep(); ++i) {
			step();
		}
		return world.find(id)->is_asleep();
	}
	void push(BodyId id, Vec2 velocity) {
		SoftBodyData &body = *world.find(id);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i], velocity);
		}
	}

	std::vector<ContactEvent> history;
};

// A floor whose top is at y = 0, in every way in which there can be one, with tag 5.
const std::vector<std::pair<std::string, std::function<void(WorldData &)>>> FLOORS = {
	{ "border", [](WorldData &world) { world.add_border({ { { 0, 0 }, { 0, 1 } }, tagged(5) }); } },
	{ "box", [](WorldData &world) {
		 world.add_collider({ { { -20, -1 }, { 20, -1 }, { 20, 0 }, { -20, 0 } }, 0, tagged(5) });
	 } },
	{ "chain", [](WorldData &world) {
		 Collider link;
		 link.surface = tagged(5);
		 add_chain(world, std::vector<Vec2>{ { -20, 0 }, { 0, 0 }, { 20, 0 } }, false, link);
	 } },
	{ "kinematic", [](WorldData &world) {
		 Collider box{ { { -20, -1 }, { 20, -1 }, { 20, 0 }, { -20, 0 } }, 0, tagged(5) };
		 box.rigid_body = world.add_rigid_body({}).value();
		 world.add_collider(box);
	 } },
	{ "dynamic", [](WorldData &world) {
		 Collider box{ { { -20, -1 }, { 20, -1 }, { 20, 0 }, { -20, 0 } }, 0, tagged(5) };
		 RigidBody heavy;
		 heavy.inverse_mass = Real(1e-6);
		 box.rigid_body = world.add_rigid_body(heavy).value();
		 world.add_collider(box);
	 } },
};

} // namespace

TEST_CASE("the impulses of a body at rest add up to its weight times the step, upwards, whatever it rests on") {
	for (const auto &[name, add_floor] : FLOORS) {
		CAPTURE(name);
		Scene scene;
		scene.world.set_sleeping(false);
		add_floor(scene.world);
		std::vector<BodyId> ids; // a batch, stepped side by side where there is only a border, and one beside it
		for (int i = 0; i < 5; ++i) {
			ids.push_back(scene.world.add_soft_body(ball({ Real(2 * i) - 5, Real(0.47) })));
		}
		scene.step(240);
		std::vector<double> impulses(ids.size());
		for (int tick = 0; tick < 60; ++tick) {
			scene.step();
			for (const Contact &contact : scene.simulator.contacts()) {
				impulses[contact.body.index] += contact.normal_impulse;
				CHECK(distance(contact.normal, { 0, 1 }) < 0.005); // a chain's is found across a slop, by rounded places
				CHECK(std::abs(contact.point.y) < 2 * LINEAR_SLOP);
				CHECK(contact.depth >= 0);
				CHECK(contact.depth < 0.01);
				CHECK(contact.other.tag == 5);
				CHECK(distance(contact.point, scene.world.find(contact.body)->positions()[contact.hull_point]) < 0.01);
			}
		}
		for (const double impulse : impulses) {
			CHECK(impulse / (THESIS_MASS * PULL) == doctest::Approx(1).epsilon(0.01));
		}
	}
}

TEST_CASE("of like bodies, stepped side by side, each that monitors tells of its own weight and the others of nothing") {
	Scene scene;
	scene.world.set_sleeping(false);
	FLOORS[0].second(scene.world);
	const auto shape = thesis_shape_with_ratio(1000, Real(0.1));
	for (int i = 0; i < 8; ++i) {
		BodySettings settings = monitored();
		settings.contact_monitor = i % 3 != 0;
		scene.world.add_soft_body(thesis_body(shape, settings, { { Real(2 * i), Real(0.47) }, HALF_A_CORNER }));
	}
	REQUIRE(std::ranges::count(batch_sizes(scene.world), PACK_WIDTH) == 1); // of the five that monitor
	scene.step(240);
	std::vector<double> impulses(8);
	for (int tick = 0; tick < 60; ++tick) {
		scene.step();
		for (const Contact &contact : scene.simulator.contacts()) {
			impulses[contact.body.index] += contact.normal_impulse;
			CHECK(distance(contact.point, scene.world.find(contact.body)->positions()[contact.hull_point]) < 0.01);
		}
	}
	for (std::size_t i = 0; i < impulses.size(); ++i) {
		CHECK(impulses[i] / (THESIS_MASS * PULL) == doctest::Approx(i % 3 != 0 ? 1 : 0).epsilon(0.01));
	}
}

TEST_CASE("a body on another is told of it with its weight, and the other with the same contacts, mirrored") {
	Scene scene;
	scene.world.set_sleeping(false);
	FLOORS[0].second(scene.world);
	BodySettings wide = monitored();
	const std::vector<Vec2> plank = { { -2, -Real(0.3) }, { 2, -Real(0.3) }, { 2, Real(0.3) }, { -2, Real(0.3) } };
	const auto shape = SoftBodyCreator::create_polygon(plank, { 3, 4000, 20, true }).value();
	const BodyId below = scene.world.add_soft_body(SoftBodyData::create(shape, wide, { { 0, Real(0.3) }, {} }).value());
	const BodyId above = scene.world.add_soft_body(ball({ 0, Real(1.1) }));
	scene.step(360);
	double weight = 0;
	double ground = 0;
	for (int tick = 0; tick < 60; ++tick) {
		scene.step();
		std::vector<Contact> seen[2];
		for (const Contact &contact : scene.simulator.contacts()) {
			if (contact.other.kind == ContactOther::Kind::SOFT_BODY) {
				seen[contact.body == above].push_back(contact);
				weight += contact.body == above ? contact.normal_impulse : Real(0);
			} else {
				CHECK(contact.body == below);
				ground += contact.normal_impulse;
			}
		}
		REQUIRE(seen[0].size() == seen[1].size());
		for (std::size_t i = 0; i < seen[0].size(); ++i) {
			CHECK(seen[0][i].body == below);
			CHECK(seen[0][i].other.body == above);
			CHECK(seen[1][i].other.body == below);
			const auto twin = std::ranges::find(seen[1], seen[0][i].point, &Contact::point);
			REQUIRE(twin != seen[1].end());
			CHECK(twin->normal == -seen[0][i].normal);
			CHECK(twin->normal_impulse == seen[0][i].normal_impulse);
			CHECK(twin->depth == seen[0][i].depth);
			CHECK(twin->normal.y > Real(0.9));
		}
	}
	CHECK(weight / (THESIS_MASS * PULL) == doctest::Approx(1).epsilon(0.02));
	CHECK(ground / ((THESIS_MASS + 3) * PULL) == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("a place that touches in several substeps is one contact") {
	WorldData world = mixed_world(2);
	Simulator simulator(world);
	std::size_t most = 0;
	for (int tick = 0; tick < 60; ++tick) {
		simulator.simulate(TICK);
		std::set<std::tuple<std::uint32_t, int, std::uint32_t, std::uint32_t, Real, Real>> places;
		for (const Contact &contact : simulator.contacts()) {
			const bool is_soft = contact.other.kind == ContactOther::Kind::SOFT_BODY;
			places.insert({ contact.body.index, int(contact.other.kind), is_soft ? contact.other.body.index : contact.other.index,
					contact.hull_point, contact.point.x, contact.point.y });
		}
		CHECK(places.size() == simulator.contacts().size());
		most = std::max(most, places.size());
	}
	CHECK(most > 20);
}

TEST_CASE("contacts and events are the same, in the same order, for any number of threads" *
		doctest::test_suite("threads")) {
	const auto run = [](const ParallelFor &threads) {
		WorldData world = mixed_world(2);
		Simulator simulator(world, threads);
		std::vector<std::uint64_t> hashes;
		for (int tick = 0; tick < 120; ++tick) {
			simulator.simulate(TICK);
			hashes.push_back(hash_of_contacts(simulator));
		}
		return hashes;
	};
	const std::vector<std::uint64_t> alone = run({});
	for (const std::size_t threads : { 2, 3, 8 }) {
		CHECK(run(on_threads(threads)) == alone);
	}
}

TEST_CASE("bodies move to the same bits whether they monitor or not") {
	WorldData watched = mixed_world(2, true);
	WorldData unwatched = mixed_world(2, false);
	Simulator watching(watched);
	Simulator blind(unwatched);
	for (int tick = 0; tick < 180; ++tick) {
		watching.simulate(TICK);
		blind.simulate(TICK);
		CHECK(blind.contacts().empty());
		CHECK(blind.contact_events().empty());
	}
	CHECK(hash_of_state(watched) == hash_of_state(unwatched));
}

TEST_CASE("a body that drops, rests, sleeps and is woken begins to touch the ground once") {
	for (const auto &[name, add_floor] : FLOORS) {
		CAPTURE(name);
		const bool may_sleep = name != "dynamic"; // nothing sleeps beside what can be pushed
		Scene scene;
		add_floor(scene.world);
		BodySettings dull = monitored(); // others leave the ground again by more than a sliver
		dull.shape_damping = 12;
		const BodyId id = scene.world.add_soft_body(ball({ 0, Real(0.55) }, dull));
		scene.step(5);
		CHECK(scene.told() == "");
		scene.step(30);
		CHECK(scene.told() == "+5");
		if (may_sleep) {
			REQUIRE(scene.sleeps(id));
		}
		scene.step(100);
		CHECK(scene.simulator.touches().size() == 1);
		CHECK((scene.simulator.contacts().empty() == may_sleep));
		scene.world.find(id)->wake();
		scene.step(100);
		CHECK(scene.told() == "");

		if (may_sleep) {
			REQUIRE(scene.sleeps(id));
		}
		scene.world.clear_environment();
		scene.step(30);
		CHECK(scene.told() == "-5");
		CHECK(scene.simulator.touches().empty());
	}
}

TEST_CASE("lists of the surroundings that are made anew every step, in any order, begin and end nothing") {
	Scene scene;
	scene.world.add_soft_body(ball({ 0, Real(0.5) }));
	for (int tick = 0; tick < 200; ++tick) {
		scene.world.clear_environment();
		Collider left{ { { -3, -1 }, { 0, -1 }, { 0, 0 }, { -3, 0 } }, 0, tagged(1) };
		Collider right{ { { 0, -1 }, { 3, -1 }, { 3, 0 }, { 0, 0 } }, 0, tagged(2) };
		scene.world.add_collider(tick % 2 == 0 ? left : right);
		scene.world.add_collider(tick % 2 == 0 ? right : left);
		scene.step();
	}
	CHECK(scene.told() == "+1+2");
}

TEST_CASE("a sleeping body is told when the ground becomes another that is like it") {
	Scene scene;
	FLOORS[1].second(scene.world);
	const BodyId id = scene.world.add_soft_body(ball({ 0, Real(0.5) }));
	REQUIRE(scene.sleeps(id));
	CHECK(scene.told() == "+5");
	Collider other = scene.world.colliders()[0];
	other.surface.tag = 6;
	scene.world.clear_environment();
	scene.world.add_collider(other);
	scene.step(30);
	CHECK(scene.told() == "+6-5");
}

TEST_CASE("a body that bounces off a wall touches it once, and the end is told soon after it has left") {
	Scene scene(Vec2{});
	scene.world.add_border({ { { 0, 0 }, { 1, 0 } }, tagged(9) });
	const BodyId id = scene.world.add_soft_body(ball({ 1, 0 }, monitored(Real(0.8))));
	scene.push(id, { -5, 0 });
	int last_contact = -1;
	int end = -1;
	double impulse = 0;
	for (int tick = 0; tick < 120; ++tick) {
		scene.step();
		for (const Contact &contact : scene.simulator.contacts()) {
			impulse += contact.normal_impulse;
			last_contact = tick;
		}
		end = !scene.simulator.contact_events().empty() ? tick : end;
	}
	CHECK(scene.told() == "+9-9");
	CHECK(end > last_contact);
	CHECK(Real(end - last_contact) * TICK <= TOUCH_MEMORY + TICK);
	CHECK(impulse > 5 * THESIS_MASS); // it came with 5 and left the other way
}

TEST_CASE("bodies that pass by one another touch once, each in its own view") {
	Scene scene(Vec2{});
	const BodyId still = scene.world.add_soft_body(ball({ 0, 0 }));
	const BodyId moving = scene.world.add_soft_body(ball({ -2, Real(0.85) }));
	scene.push(moving, { 4, 0 });
	scene.step(120);
	REQUIRE(scene.history.size() == 4);
	for (const std::size_t i : { 0, 1 }) {
		CHECK(scene.history[i].kind == ContactEvent::Kind::BEGIN);
		CHECK(scene.history[i].body == (i == 0 ? still : moving));
	}
	CHECK(scene.told() == "+s1+s0-s1-s0");

	BodySettings deaf = monitored();
	deaf.contact_monitor = false;
	Scene half(Vec2{});
	half.world.add_soft_body(ball({ 0, 0 }));
	half.push(half.world.add_soft_body(ball({ -2, Real(0.85) }, deaf)), { 4, 0 });
	half.step(120);
	CHECK(half.told() == "+s1-s1");
}

TEST_CASE("bodies that lie across each other touch, though no point is inside the other") {
	Scene scene(Vec2{});
	const std::vector<Vec2> plank = { { -2, -Real(0.2) }, { 2, -Real(0.2) }, { 2, Real(0.2) }, { -2, Real(0.2) } };
	const auto shape = SoftBodyCreator::create_polygon(plank, { 1, 1000, 2, true }).value();
	for (const Rotation turn : { Rotation{}, Rotation{ 0, 1 } }) {
		scene.world.add_soft_body(SoftBodyData::create(shape, monitored(), { {}, turn }).value());
	}
	scene.step();
	CHECK(scene.told() == "+s1+s0");
}

TEST_CASE("removing, deactivating or no longer monitoring a body ends its touches once, asleep or awake") {
	const std::vector<std::function<void(Scene &, BodyId)>> changes = {
		[](Scene &scene, BodyId id) { scene.world.remove_soft_body(id); },
		[](Scene &scene, BodyId id) { scene.world.find(id)->set_active(false); },
		[](Scene &scene, BodyId id) {
			BodySettings settings = monitored();
			settings.contact_monitor = false;
			scene.world.find(id)->set_settings(settings);
		},
	};
	for (std::size_t i = 0; i < changes.size(); ++i) {
		for (const bool asleep : { false, true }) {
			CAPTURE(i);
			CAPTURE(asleep);
			Scene scene;
			FLOORS[0].second(scene.world);
			const BodyId id = scene.world.add_soft_body(ball({ 0, Real(0.5) }));
			scene.step(20);
			if (asleep) {
				REQUIRE(scene.sleeps(id));
			}
			CHECK(scene.told() == "+5");
			changes[i](scene, id);
			scene.step();
			REQUIRE(scene.history.size() == 1);
			CHECK(scene.history[0].body == id);
			scene.step(100);
			CHECK(scene.told() == "-5");
		}
	}
}

TEST_CASE("in a pile that has settled no touch both begins and ends, though its bodies go on creeping") {
	Scene scene;
	scene.world.set_sleeping(false);
	scene.world.add_border({ { { 0, 0 }, { 0, 1 } }, tagged(1) });
	scene.world.add_border({ { { -3, 0 }, { 1, 0 } }, tagged(2) });
	scene.world.add_border({ { { 3, 0 }, { -1, 0 } }, tagged(3) });
	for (int i = 0; i < 24; ++i) {
		scene.world.add_soft_body(ball({ Real(i % 6) - Real(2.5) + Real(0.05) * Real(i / 6 % 2), Real(0.5) + Real(i / 6) }));
	}
	scene.step(480);
	CHECK(scene.history.size() > 50);
	scene.history.clear();
	scene.step(600);
	std::set<std::pair<std::uint32_t, std::string>> pairs;
	for (const ContactEvent &event : scene.history) {
		const bool is_soft = event.other.kind == ContactOther::Kind::SOFT_BODY;
		pairs.insert({ event.body.index, (is_soft ? "s" : "") + std::to_string(is_soft ? event.other.body.index : event.other.tag) });
	}
	CHECK(pairs.size() == scene.history.size());
}

TEST_CASE("a step that is refused tells no event twice") {
	Scene scene;
	FLOORS[0].second(scene.world);
	scene.world.add_soft_body(ball({ 0, Real(0.45) }));
	scene.step();
	CHECK(scene.simulator.contact_events().size() == 1);
	CHECK(scene.simulator.simulate(-1).refused);
	CHECK(scene.simulator.contact_events().empty());
	CHECK(scene.simulator.contacts().empty());
	CHECK(scene.simulator.touches().size() == 1);
}
