// SPDX-License-Identifier: MIT
// Scenes whose end is compared to the last bit.
#include "determinism/hashed_scenes.h"

#include "core/creator/body_cut.h"
#include "core/creator/hole_weights.h"
#include "core/creator/hulls.h"
#include "core/creator/rope_creator.h"
#include "core/creator/simplify_outline.h"
#include "core/dynamics/fluid_forces.h"
#include "core/model/rigid_motion.h"
#include "core/skin/hole_binding.h"
#include "core/skin/outline_binding.h"
#include "scenes/fine_outlines.h"
#include "scenes/metal.h"
#include "scenes/mixed.h"

#include <array>
#include <chrono>
#include <vector>

namespace softbody::testing {

namespace {

constexpr Real TICK = Real(1) / 60;

// Octagons tied in a row, rigidly and by springs, one end on a pin that is carried about, the other in the air.
WorldData chain_of_bodies() {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, -3 }, { 0, 1 } }, {} });
	BodySettings settings;
	settings.shape_stiffness = 200;
	settings.shape_damping = 2;
	const auto shape = octagon(Real(0.4), 800, 2);
	BodyId last;
	for (int i = 0; i < 10; ++i) {
		const BodyId id = world.add_soft_body(SoftBodyData::create(shape, settings, { { Real(i), 2 }, {} }).value());
		if (i > 0) {
			Joint joint;
			joint.first = JointAnchor::on_point(last, 0);
			joint.second = JointAnchor::on_point(id, 4);
			joint.rest_length = Real(0.2);
			joint.stiffness = i % 2 == 0 ? Real(500) : joint.stiffness;
			joint.damping = 1;
			(void)world.add_joint(joint);
		} else {
			world.find(id)->set_pinned(4, true);
		}
		last = id;
	}
	return world;
}

void carry_pin(WorldData &world, int tick) {
	const int phase = tick % 120; // there and back
	const Real along = Real(phase < 60 ? phase : 120 - phase) / 60;
	world.soft_bodies()[0].set_pin_target(4, { Real(-0.4) + along, 2 + along / 2 });
}

// Bodies that collide with themselves, fall into a narrow box and fold.
WorldData folding_ribbons() {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	world.add_border({ { { -1, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { 1, 0 }, { -1, 0 } }, {} });
	const std::vector<Vec2> hull = box_hull({ Real(0.2), 3 }, Real(0.25)).value();
	const auto shape = SoftBodyCreator::create_polygon(hull, { 1, 400, 2, false }).value();
	for (int i = 0; i < 4; ++i) {
		BodySettings settings;
		settings.self_collision = true;
		settings.shape_stiffness = 20;
		settings.integrator = i == 3 ? Integrator::XPBD : Integrator::AUTOMATIC;
		world.add_soft_body(SoftBodyData::create(shape, settings, { { Real(-0.6) + Real(0.4) * Real(i), Real(1.8) + Real(0.3) * Real(i) }, {} }).value());
	}
	return world;
}

// Enough like bodies to be stepped side by side and divided over threads; they fall asleep in the end.
WorldData large_pile() {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	world.add_border({ { { -6, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { 6, 0 }, { -1, 0 } }, {} });
	for (int i = 0; i < 20; ++i) { // tiles and one-way platforms
		Collider tile{ { { 0, 0 }, { Real(0.5), 0 }, { Real(0.5), Real(0.2) }, { 0, Real(0.2) } }, 0, {} };
		for (Vec2 &p : tile.vertices) {
			p += Vec2{ Real(-5) + Real(0.5) * Real(i), Real(0.6) + Real(0.8) * Real(i % 3) };
		}
		tile.one_way = i % 2 == 0 ? Vec2{ 0, 1 } : Vec2{};
		world.add_collider(tile);
	}
	BodySettings settings;
	settings.shape_stiffness = 400;
	settings.shape_damping = 4;
	settings.rolling_resistance = Real(0.05);
	const auto shape = octagon(Real(0.25), 1000, 2);
	for (int i = 0; i < 300; ++i) {
		world.add_soft_body(SoftBodyData::create(shape, settings,
				{ { Real(-5.6) + Real(0.56) * Real(i % 20) + Real(0.02) * Real(i / 20), Real(3) + Real(0.56) * Real(i / 20) }, {} })
						.value());
	}
	return world;
}

// Discs of metal under every elastic model that fall, dent, and rain on one another.
WorldData dented_metal() {
	WorldData world = floor_world();
	for (int i = 0; i < 25; ++i) {
		Metal metal{ MODELS[std::size_t(i) % MODELS.size()] };
		metal.by = DentBy(i % 3);
		metal.yield = Real(0.02) + Real(0.01) * Real(i % 4);
		world.add_soft_body(metal_disc(metal, { Real(i % 5) * 104, -80 - Real(i / 5) * 130 }));
	}
	return world;
}

// Planks that are rigid bodies, each on two wheels that it is joined to, roll down a slope into a paddle that turns. Wheels are of
// every elastic model, some under XPBD, all damped; on the planks lie the pieces of a disc that was cut.
WorldData carts() {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, Rotation::from_angle(Real(0.15)).apply({ 0, 1 }) }, {} });
	world.add_border({ { { -14, 0 }, { 1, 0 } }, {} });
	const auto add_box = [&](const RigidBody &body, Vec2 half) {
		Collider box{ { { -half.x, -half.y }, { half.x, -half.y }, half, { -half.x, half.y } }, 0, {} };
		box.rigid_body = world.add_rigid_body(body).value();
		world.add_collider(box);
	};
	RigidBody paddle;
	paddle.pose = { { -11, Real(0.5) }, Rotation::from_angle(Real(0.3)) };
	paddle.angular_velocity = 2;
	add_box(paddle, { Real(1.5), Real(0.2) });

	const std::vector<Vec2> disc = circle_hull(Real(0.4), 14).value();
	for (int i = 0; i < 6; ++i) {
		const Vec2 place{ Real(-7) + Real(2.4) * Real(i), Real(1.2) + Real(0.5) * Real(i) };
		RigidBody plank;
		plank.pose.position = place;
		plank.acceleration = world.gravity();
		plank.inverse_mass = Real(0.5) + Real(0.25) * Real(i);
		plank.inverse_inertia = 2 * plank.inverse_mass;
		plank.tag = std::uint64_t(i) + 1;
		add_box(plank, { Real(0.9), Real(0.1) });
		for (const Real side : { Real(-0.7), Real(0.7) }) {
			Metal metal{ MODELS[std::size_t(i) % MODELS.size()] };
			metal.yield = 0;
			SoftBodyData wheel = metal_body(disc, metal, place + Vec2{ side, Real(-0.7) });
			BodySettings settings = wheel.settings();
			settings.integrator = i >= 4 && side > 0 ? Integrator::XPBD : Integrator::AUTOMATIC;
			settings.linear_damp = Real(0.1) * Real(i);
			settings.angular_damp = Real(0.3);
			(void)wheel.set_settings(settings);
			const auto last = std::uint32_t(wheel.point_count() - 1); // the center, if there is one
			const BodyId id = world.add_soft_body(std::move(wheel));
			Joint axle;
			axle.first = JointAnchor::on_rigid_body(plank.tag, { side, Real(-0.1) });
			axle.second = JointAnchor::on_point(id, last);
			axle.rest_length = Real(0.6);
			axle.stiffness = i % 2 == 0 ? Real(800) : axle.stiffness;
			axle.damping = 2;
			(void)world.add_joint(axle);
		}
		const StructureOptions options{ 1, 300, 3, true };
		const auto whole = SoftBodyCreator::create_polygon(disc, options).value();
		const SoftBodyData load = SoftBodyData::create(whole, {}, { place + Vec2{ 0, Real(0.7) }, Rotation::from_angle(Real(i)) }).value();
		const Vec2 along = Rotation::from_angle(Real(0.4) * Real(i)).apply({ 1, 0 });
		const Vec2 middle = place + Vec2{ Real(0.03), Real(0.68) };
		std::vector<SoftBodyData> pieces = cut_body(load, options, std::array{ middle - along, middle + along }, {}).value();
		for (SoftBodyData &piece : pieces) {
			world.add_soft_body(std::move(piece));
		}
	}
	return world;
}

// A drawn character of 160 points with a mouth, and the few points that stand for it, finer at its ears.
struct Drawn {
	std::vector<Vec2> outline = character_outline(160);
	Holes holes = { { { -20, 10 }, { 0, 20 }, { 20, 10 }, { 12, 26 }, { -12, 26 } } };
	SimplifiedOutline simple;

	explicit Drawn(float fineness) {
		SimplifyOptions options;
		for (const Vec2 point : outline) {
			options.weights.push_back(point.y < -40 ? fineness : 1.0f);
		}
		simple = simplify_outline(outline, options).value();
	}
};

constexpr int CHARACTERS = 10;
constexpr Real WATER = -70; // its surface; y is down

float fineness_of(int character) {
	return 1 + 0.5f * float(character % 3);
}

// Characters of every elastic model fall past ropes into water.
WorldData characters() {
	WorldData world = floor_world();
	for (int i = 0; i < 3; ++i) {
		const std::array<Vec2, 3> path = { Vec2{ Real(-120 + 160 * i), -260 }, { Real(-50 + 160 * i), -230 }, { Real(20 + 160 * i), -260 } };
		const std::vector<Vec2> points = divide_path(path, 12).value();
		const std::vector<Real> widths(points.size(), Real(6));
		const auto rope = create_rope(points, widths, Real(0.5)).value();
		const BodyId id = world.add_soft_body(SoftBodyData::create(rope, {}).value());
		const std::span<const ChainSection> sections = rope->chain()->sections();
		world.find(id)->set_pinned(sections.front().center, true);
		world.find(id)->set_pinned(sections.back().center, i == 1);
	}
	for (int i = 0; i < CHARACTERS; ++i) {
		Metal metal{ MODELS[std::size_t(i) % MODELS.size()] };
		metal.yield = i % 2 == 0 ? Real(0) : Real(0.1);
		world.add_soft_body(metal_body(Drawn(fineness_of(i)).simple.hull, metal, { Real(i % 5) * 90 - 150, -360 - Real(i / 5) * 180 }));
	}
	return world;
}

void flood(WorldData &world, int) {
	const Fluid water{ Real(0.0004), 1, Real(0.5), { 30, 0 }, world.gravity() };
	const std::array<Vec2, 4> sea = { Vec2{ -1000, WATER }, { 1000, WATER }, { 1000, 0 }, { -1000, 0 } };
	for (SoftBodyData &body : world.soft_bodies()) {
		const std::size_t count = body.shape().hull_count();
		std::vector<Vec2> forces(count);
		add_fluid_forces(water, sea, body.positions().first(count), body.velocities().first(count), 1 / Real(count), TICK, forces);
		for (std::uint32_t i = 0; i < count; ++i) {
			(void)body.add_external_force(i, forces[i]);
		}
	}
}

void draw_characters(const WorldData &world, BitHash &hash) {
	const std::span<const SoftBodyData> bodies = world.soft_bodies();
	for (int i = 0; i < CHARACTERS; ++i) {
		const Drawn drawn(fineness_of(i));
		const std::vector<Vec2> &hull = drawn.simple.hull;
		const std::span<const Vec2> now = bodies[bodies.size() - CHARACTERS + std::size_t(i)].positions().first(hull.size());
		std::vector<Vec2> outline(drawn.outline.size());
		OutlineBinding(drawn.outline, hull, drawn.simple.places).place(now, outline);
		const HoleBinding binding(drawn.holes, hull, hole_weights(hull, drawn.holes));
		std::vector<Vec2> holes(binding.point_count());
		binding.place(now, holes);
		for (const auto *places : { &outline, &holes }) {
			for (const Vec2 place : *places) {
				hash.add(place);
			}
		}
	}
}

// Discs and boxes of elastic material thrown up between walls. They fly as rigid bodies while the world lets them, and wobble on
// each time that it no longer does, in the air, at the floor and on one another.
WorldData flyers() {
	WorldData world = floor_world();
	world.add_border({ { { -700, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { 700, 0 }, { -1, 0 } }, {} });
	const std::vector<Vec2> box = box_hull({ 90, 60 }, 15).value();
	for (int i = 0; i < 30; ++i) {
		Metal metal{ i % 4 == 3 ? ElasticModel::TRIANGLES : ElasticModel::MODES };
		metal.yield = 0;
		const Vec2 place{ Real(i % 10) * 135 - 605, -200 - Real(i / 10) * 150 };
		SoftBodyData body = i % 3 == 1 ? metal_body(box, metal, place) : metal_disc(metal, place);
		(void)set_linear_velocity(body, { Real(30 * (i % 5) - 60), Real(-500 - 40 * (i / 10)) });
		(void)set_angular_velocity(body, Real(0.4) * Real(i % 7 - 3));
		world.add_soft_body(std::move(body));
	}
	return world;
}

void change_level(WorldData &world, int tick) {
	world.set_rigid_flight(tick % 40 < 30);
}

class Run {
public:
	Run(const HashedScene &scene, const ParallelFor &parallel_for) :
			scene_(scene), world_(scene.make()), simulator_(world_, parallel_for) {}

	void advance(int ticks) {
		for (int i = 0; i < ticks; ++i) {
			if (scene_.drive) {
				scene_.drive(world_, tick_);
			}
			simulator_.simulate(TICK);
			hash_.add(hash_of_contacts(simulator_));
			++tick_;
		}
	}
	void make_detour(int ticks) {
		std::vector<BodyState> states;
		for (const SoftBodyData &body : world_.soft_bodies()) {
			states.push_back(body.save_state());
		}
		const std::vector<RigidBody> rigid(world_.rigid_bodies().begin(), world_.rigid_bodies().end());
		const BitHash hash = hash_;
		const int tick = tick_;
		advance(ticks);
		for (std::size_t i = 0; i < states.size(); ++i) {
			world_.soft_bodies()[i].restore_state(states[i]);
		}
		for (std::uint32_t i = 0; i < rigid.size(); ++i) {
			world_.set_rigid_body(i, rigid[i]);
		}
		hash_ = hash;
		tick_ = tick;
	}
	// What was told of touches is no part of a state: after a detour touches may be told to begin anew.
	std::uint64_t state() const { return hash_of_state(world_); }
	std::uint64_t all() {
		hash_.add(state());
		if (scene_.draw) {
			scene_.draw(world_, hash_);
		}
		return hash_.value();
	}

private:
	const HashedScene &scene_;
	WorldData world_;
	Simulator simulator_;
	BitHash hash_;
	int tick_ = 0;
};

} // namespace

std::span<const HashedScene> hashed_scenes() {
	static const std::array<HashedScene, 9> scenes = { HashedScene{ "mixed", [] { return mixed_world(); }, {} },
		HashedScene{ "chain", chain_of_bodies, carry_pin }, HashedScene{ "ribbons", folding_ribbons, {} },
		HashedScene{ "pile", large_pile, {} }, HashedScene{ "metal", dented_metal, {} },
		HashedScene{ "turning", [] { return mixed_world(2); }, {} }, HashedScene{ "carts", carts, {} },
		HashedScene{ "characters", characters, flood, draw_characters }, HashedScene{ "flyers", flyers, change_level } };
	return scenes;
}

std::uint64_t run_hashed(const HashedScene &scene, int ticks, const ParallelFor &parallel_for) {
	Run run(scene, parallel_for);
	run.advance(ticks);
	return run.all();
}

double time_hashed(const HashedScene &scene, int ticks) {
	Run run(scene, {});
	const auto start = std::chrono::steady_clock::now();
	run.advance(ticks);
	return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count() / ticks;
}

std::uint64_t run_hashed_with_detour(const HashedScene &scene, int ticks, int detour, const ParallelFor &parallel_for) {
	Run run(scene, parallel_for);
	run.advance(ticks / 3);
	if (detour > 0) {
		run.make_detour(detour);
	}
	run.advance(ticks - ticks / 3);
	return run.state();
}

} // namespace softbody::testing
