// SPDX-License-Identifier: MIT
// Claims about lists and touches made from contacts that are given: order, mirroring, and when a touch ends.
#include "core/base/constants.h"
#include "core/collision/contact_monitor.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <string>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TICK = Real(1) / 60;

// Bodies in a row, `gap` apart, on three borders of which the last two have one tag.
struct Scene {
	WorldData world;
	ColliderIndex surroundings;
	ContactMonitor monitor;
	ContactLog log;
	ContactLog other_log;
	std::vector<BodyId> ids;

	explicit Scene(std::size_t count = 3, Real gap = 1) {
		BodySettings settings;
		settings.contact_monitor = true;
		for (std::size_t i = 0; i < count; ++i) {
			const Pose pose{ { Real(i) * (2 * THESIS_RADIUS + gap), 0 }, {} };
			ids.push_back(world.add_soft_body(thesis_body(thesis_shape(), settings, pose)));
		}
		for (const std::uint64_t tag : { 0, 7, 7 }) {
			Border border{ { { 0, -1 }, { 0, 1 } }, {} };
			border.surface.tag = tag;
			world.add_border(border);
		}
	}
	void touch_border(std::uint32_t body, std::uint32_t border, std::uint32_t point = 0) {
		log.add({ body, ContactOther::Kind::BORDER, border, point, point, 0, {}, { 0, 1 }, 1, 0 });
	}
	void touch_body(std::uint32_t body, std::uint32_t other, std::uint32_t point = 0, ContactLog *where = nullptr) {
		(where == nullptr ? log : *where).add({ body, ContactOther::Kind::SOFT_BODY, other, point, point, 4, { 1, 2 }, { -1, 0 }, 3, Real(0.5) });
	}
	void set_monitoring(std::uint32_t body, bool monitors) {
		BodySettings settings = world.find(ids[body])->settings();
		settings.contact_monitor = monitors;
		world.find(ids[body])->set_settings(settings);
	}
	/// "+" for every touch begun, "-" for every one ended.
	std::string step() {
		monitor.begin_step();
		monitor.add(other_log);
		monitor.add(log);
		surroundings.update(world, TICK);
		monitor.end_step(surroundings, TICK);
		std::string events;
		for (const ContactEvent &event : monitor.events()) {
			events += event.kind == ContactEvent::Kind::BEGIN ? '+' : '-';
		}
		return events;
	}
	std::string rest(int count) {
		std::string events;
		for (int i = 0; i < count; ++i) {
			events += step();
		}
		return events;
	}
};

const int STEPS_TO_FORGET = int(TOUCH_MEMORY / TICK) + 2; ///< whatever the rounding

} // namespace

TEST_CASE("a contact between two bodies is told to each that monitors, mirrored") {
	Scene scene;
	scene.touch_body(1, 0, 5);
	scene.step();
	REQUIRE(scene.monitor.contacts().size() == 2);
	const Contact &first = scene.monitor.contacts()[0];
	const Contact &second = scene.monitor.contacts()[1];
	CHECK(first.body == scene.ids[0]);
	CHECK(first.other.body == scene.ids[1]);
	CHECK(second.body == scene.ids[1]);
	CHECK(second.other.body == scene.ids[0]);
	CHECK(first.normal == Vec2{ 1, 0 });
	CHECK(second.normal == Vec2{ -1, 0 });
	CHECK(first.hull_point == 4);
	CHECK(second.hull_point == 5);
	for (const Contact &contact : { first, second }) {
		CHECK(contact.point == Vec2{ 1, 2 });
		CHECK(contact.normal_impulse == 3);
		CHECK(contact.depth == Real(0.5));
	}

	scene.set_monitoring(0, false);
	scene.touch_body(1, 0, 5);
	scene.step();
	REQUIRE(scene.monitor.contacts().size() == 1);
	CHECK(scene.monitor.contacts()[0].body == scene.ids[1]);
}

TEST_CASE("the list is sorted by body, other and place, whichever log a contact was noted in and when") {
	const auto list_of = [](bool reversed) {
		Scene scene;
		for (int i = 0; i < 5; ++i) {
			switch (reversed ? 4 - i : i) {
				case 0: scene.touch_body(2, 0, 3); break;
				case 1: scene.touch_body(0, 1, 6, &scene.other_log); break;
				case 2: scene.touch_body(0, 1, 2); break;
				case 3: scene.touch_border(1, 2, 4); break;
				case 4: scene.touch_border(1, 0, 5); break;
			}
		}
		scene.step();
		std::string list;
		for (const Contact &contact : scene.monitor.contacts()) {
			list += std::to_string(contact.body.index) + (contact.other.kind == ContactOther::Kind::BORDER ? "b" : "s") +
					std::to_string(contact.other.kind == ContactOther::Kind::BORDER ? contact.other.index : contact.other.body.index) +
					"." + std::to_string(contact.hull_point) + " ";
		}
		return list;
	};
	// The border of tag 0 comes before the one of tag 7.
	CHECK(list_of(false) == "0s1.2 0s1.6 0s2.4 1s0.4 1s0.4 1b0.5 1b2.4 2s0.3 ");
	CHECK(list_of(true) == list_of(false));
}

TEST_CASE("a contact that is not finite is not told") {
	Scene scene;
	scene.log.add({ 0, ContactOther::Kind::BORDER, 0, 0, 0, 0, { NOT_A_NUMBER, 0 }, { 0, 1 }, 1, 0 });
	scene.log.add({ 1, ContactOther::Kind::BORDER, 0, 0, 0, 0, {}, { 0, 1 }, INFINITE, 0 });
	CHECK(scene.step().empty());
	CHECK(scene.monitor.contacts().empty());
}

TEST_CASE("a touch that misses a step or two goes on; one that is missed for longer ends, once") {
	Scene scene;
	scene.touch_border(0, 1);
	CHECK(scene.step() == "+");
	for (int i = 0; i < 20; ++i) {
		CHECK(scene.step().empty());
		CHECK(scene.step().empty());
		scene.touch_border(0, 1);
		CHECK(scene.step().empty());
	}
	REQUIRE(scene.monitor.touches().size() == 1);
	CHECK(scene.rest(STEPS_TO_FORGET) == "-");
	CHECK(scene.monitor.touches().empty());
	CHECK(scene.rest(20).empty());
	scene.touch_border(0, 1);
	CHECK(scene.step() == "+");
}

TEST_CASE("surfaces of one tag are one thing to touch; another tag is another") {
	Scene scene;
	scene.touch_border(0, 1);
	scene.touch_border(0, 2);
	CHECK(scene.step() == "+");
	CHECK(scene.monitor.events()[0].other.tag == 7);
	CHECK(scene.monitor.contacts().size() == 2);
	for (int i = 0; i < 30; ++i) {
		scene.touch_border(0, 1 + std::uint32_t(i / 10 % 2));
		CHECK(scene.step().empty());
	}
	scene.touch_border(0, 0);
	CHECK(scene.step() == "+");
	CHECK(scene.monitor.events()[0].other.tag == 0);
}

TEST_CASE("bodies that have not parted by more than a sliver still touch") {
	const auto events_of = [](Real gap) {
		Scene scene(2, gap);
		scene.touch_body(0, 1);
		return scene.step() + scene.rest(100);
	};
	// Each of the two tells of itself.
	CHECK(events_of(Real(0.9) * TOUCH_GAP * THESIS_RADIUS) == "++");
	CHECK(events_of(Real(1.1) * TOUCH_GAP * THESIS_RADIUS) == "++--");
}

TEST_CASE("a corner close to the middle of an edge is near for both") {
	Scene scene(2, 0);
	const Real apothem = THESIS_RADIUS * Real(0.92387953);
	const Rotation half_a_corner = Rotation::from_angle(Real(0.39269908));
	// The corner of the second is a hundredth of the radius from an edge of the first.
	scene.world.find(scene.ids[0])->teleport({}, { {}, half_a_corner });
	scene.world.find(scene.ids[1])->teleport({ { 2 * THESIS_RADIUS, 0 }, {} }, { { apothem + Real(1.01) * THESIS_RADIUS, 0 }, {} });
	scene.touch_body(0, 1);
	CHECK(scene.step() == "++");
	CHECK(scene.rest(20).empty());
}

TEST_CASE("a touch ends at once, and once, when a side goes, is set inactive, or no longer monitors") {
	const auto ends = [](const auto &change, std::size_t least, std::size_t most) {
		Scene scene(2, Real(0.001));
		scene.touch_body(0, 1);
		scene.touch_border(0, 1);
		CHECK(scene.step() == "+++");
		change(scene);
		const std::string at_once = scene.step();
		CHECK(at_once.size() >= least);
		CHECK(at_once.size() <= most);
		CHECK(at_once == std::string(at_once.size(), '-'));
		return at_once + scene.rest(30);
	};
	CHECK(ends([](Scene &scene) { scene.world.remove_soft_body(scene.ids[0]); }, 3, 3) == "---");
	CHECK(ends([](Scene &scene) { scene.world.find(scene.ids[0])->set_active(false); }, 3, 3) == "---");
	// The border is left, and forgotten in its time.
	CHECK(ends([](Scene &scene) { scene.world.remove_soft_body(scene.ids[1]); }, 2, 2) == "---");
	CHECK(ends([](Scene &scene) { scene.world.find(scene.ids[1])->set_active(false); }, 2, 2) == "---");
	// The other goes on being told of the body that no longer monitors.
	CHECK(ends([](Scene &scene) { scene.set_monitoring(0, false); }, 2, 2) == "--");
}

TEST_CASE("another body in the place of a removed one begins a touch of its own") {
	Scene scene;
	scene.touch_border(2, 1);
	CHECK(scene.step() == "+");
	const BodyId old = scene.ids[2];
	const SoftBodyData copy = *scene.world.find(old);
	scene.world.remove_soft_body(old);
	const BodyId fresh = scene.world.add_soft_body(copy);
	REQUIRE(fresh.index == old.index);
	scene.touch_border(2, 1);
	CHECK(scene.step() == "-+");
	CHECK(scene.monitor.events()[0].body == old);
	CHECK(scene.monitor.events()[1].body == fresh);
}

TEST_CASE("what sleeps goes on touching surroundings and what sleeps too, not what has left it") {
	Scene scene;
	for (const std::uint32_t body : { 0, 1 }) {
		scene.world.find(scene.ids[body])->rest_state().asleep = true;
	}
	scene.touch_border(0, 1);
	scene.touch_body(0, 1);
	scene.touch_body(1, 2);
	CHECK(scene.step() == "+++++");
	CHECK(scene.rest(100) == "--"); // bodies 1 and 2, of which one is awake and 1 away
	CHECK(scene.monitor.touches().size() == 3);
}
