// SPDX-License-Identifier: MIT
// Any sequence of calls of the public interface of a world.
#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "core/model/rigid_motion.h"
#include "fuzz/bytes.h"
#include "fuzz/targets.h"
#include "scenes/chain.h"
#include "scenes/mixed.h"
#include "scenes/ribbon.h"
#include "thesis/separation_force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace softbody::fuzzing {

namespace {

constexpr int MOST_CALLS = 48;
constexpr int MOST_STEPS = 12;
constexpr std::size_t MOST_BODIES = 6;
constexpr std::size_t MOST_COLLIDERS = 12;

std::shared_ptr<const SoftBodyShape> elastic(std::span<const Vec2> hull, Real mass) {
	StructureOptions options{ mass, 1, 1, hull.size() > 6 };
	options.elastic = true;
	return SoftBodyCreator::create_polygon(hull, options).value();
}

std::shared_ptr<const SoftBodyShape> of_triangles(std::span<const Vec2> hull, Real mass) {
	StructureOptions options{ mass, 1, 1, false };
	options.elastic_triangles = true;
	options.triangle_points = 5;
	return SoftBodyCreator::create_polygon(hull, options).value();
}

// Two of each number of points, so that one can take the other's place.
const std::vector<std::shared_ptr<const SoftBodyShape>> &shapes() {
	static const std::vector<std::shared_ptr<const SoftBodyShape>> all = [] {
		const std::array<Vec2, 3> triangle = { Vec2{ 0, 0 }, { 1, 0 }, { 0, 1 } };
		const std::array<Vec2, 6> dented = { Vec2{ -1, -1 }, { 0, Real(-0.2) }, { 1, -1 }, { 1, 1 }, { 0, Real(0.4) }, { -1, 1 } };
		return std::vector{ testing::octagon(Real(0.5), 100, 1), testing::octagon(Real(0.5), Real(1e6), 0),
			SoftBodyCreator::create_polygon(triangle, { 1, 100, 1, false }).value(),
			SoftBodyCreator::create_polygon(triangle, { Real(1e-3), 1000, 0, false }).value(),
			SoftBodyCreator::create_polygon(dented, { 1, 200, 1, false }).value(),
			SoftBodyCreator::create_polygon(dented, { 100, 0, 0, false }).value(), elastic(dented, 1), elastic(dented, 50),
			elastic(circle_hull(Real(0.5), 8).value(), 1), of_triangles(dented, 1), of_triangles(circle_hull(Real(0.5), 8).value(), 5) };
	}();
	return all;
}

class Session {
public:
	Session(std::span<const std::uint8_t> data, ParallelFor parallel_for, bool is_compared) :
			bytes_(data), simulator_(world_, std::move(parallel_for)), is_compared_(is_compared) {
		world_.set_gravity({ 0, Real(-9.81) });
	}

	std::uint64_t run() {
		for (int i = 0; i < MOST_CALLS && !bytes_.is_empty(); ++i) {
			call();
		}
		return hash_.value();
	}

private:
	SoftBodyData *body() {
		const std::span<SoftBodyData> bodies = world_.soft_bodies();
		return bodies.empty() ? nullptr : &bodies[bytes_.byte() % bodies.size()];
	}
	BodyId id() { // now and then of a body that is gone
		return ids_.empty() ? BodyId{} : ids_[bytes_.byte() % ids_.size()];
	}
	std::uint32_t point() { return bytes_.byte() % 12u; }

	BodySettings settings() {
		BodySettings s;
		const int kind = bytes_.integer(0, 7);
		const bool is_awful = kind == 0;
		const auto value = [&](double most) { return is_awful ? bytes_.any(most) : bytes_.positive(most); };
		s.shape_stiffness = value(100);
		s.shape_damping = value(5);
		s.pressure_stiffness = bytes_.chance() ? value(200) : Real(0);
		s.inflation = value(2);
		s.friction = value(1);
		s.rolling_resistance = value(0.1);
		s.restitution = bytes_.chance() ? value(1) : Real(0);
		s.gravity_scale = value(2);
		s.linear_damp = bytes_.chance() ? value(2) : Real(0);
		s.integrator = Integrator(bytes_.integer(0, INTEGRATOR_COUNT));
		s.substeps = bytes_.integer(-1, 6);
		const std::uint8_t bits = bytes_.byte();
		s.can_sleep = bits & 1;
		s.contact_monitor = bits & 2;
		s.self_collision = bits & 4;
		s.collision_layer = bits >> 4;
		s.collision_mask = 0xffffffffu >> (bits & 8);
		if (kind > 4) {
			add_terms_of_a_material(s);
		}
		return s;
	}

	// Any of the terms, fitting or not: springs or modes, area, limits.
	void add_terms_of_a_material(BodySettings &s) {
		const bool is_awful = bytes_.integer(0, 7) == 0;
		const auto value = [&](double most) { return is_awful ? bytes_.any(most) : bytes_.positive(most); };
		s.spring_stiffness_scale = value(3);
		s.spring_damping_scale = value(3);
		s.shear_modulus = value(1000);
		s.poisson_ratio = value(0.49);
		s.area_stiffness = value(10000);
		s.elastic_damping_time = value(0.1);
		s.least_area = value(1);
		s.least_stretch = value(1);
		s.most_stretch = bytes_.chance() ? 1 + value(3) : std::numeric_limits<Real>::infinity();
	}

	Pose pose() {
		const Vec2 place = bytes_.integer(0, 15) == 0 ? bytes_.any_vector(1000) : bytes_.vector(4);
		return { place, Rotation::from_angle(bytes_.real(3)) };
	}

	void add_body() {
		if (world_.soft_bodies().size() >= MOST_BODIES) {
			return;
		}
		const auto &shape = shapes()[bytes_.byte() % shapes().size()];
		const BodySettings chosen = settings();
		Result<SoftBodyData> made = SoftBodyData::create(shape, chosen, pose());
		if (made) {
			ids_.push_back(world_.add_soft_body(std::move(made.value())));
			require(world_.find(ids_.back()) != nullptr, "what was added is found");
		}
	}

	void change_world() {
		switch (bytes_.integer(0, 6)) {
			case 0: world_.set_gravity(bytes_.any_vector(20)); break;
			case 1: world_.set_length_unit(bytes_.any(100)); break;
			case 2: world_.set_contact_substeps(bytes_.integer(-1, 8)); break;
			case 3: world_.set_sleeping(bytes_.chance()); break;
			case 4: bytes_.chance(); break; // keeps the meaning of the corpus
			case 5: (void)add_separation_forces(world_, SEPARATION_STIFFNESS * Real(bytes_.integer(0, 1))); break;
			case 6: world_.wake_all(); break;
		}
	}

	Surface surface() {
		Surface surface;
		surface.friction = bytes_.positive(1);
		surface.restitution = bytes_.chance() ? bytes_.positive(1) : Real(0);
		surface.linear_velocity = bytes_.integer(0, 3) == 0 ? bytes_.any_vector(5) : Vec2{};
		surface.tag = bytes_.byte() % 4u;
		return surface;
	}

	void add_environment() {
		if (world_.colliders().size() + world_.borders().size() > MOST_COLLIDERS) {
			world_.clear_environment();
		}
		if (bytes_.integer(0, 3) == 0) {
			const Vec2 place = bytes_.any_vector(3);
			const Vec2 normal = Rotation::from_angle(bytes_.real(3)).apply({ 1, 0 });
			world_.add_border({ { place, normal }, surface() });
			return;
		}
		Collider collider;
		switch (bytes_.integer(0, 3)) {
			case 0: collider.vertices = { { 0, 0 } }; break;
			case 1: collider.vertices = { { -1, 0 }, bytes_.any_vector(2) }; break;
			case 2: collider.vertices = { { -1, Real(-0.2) }, { 1, Real(-0.2) }, { 1, Real(0.2) }, { -1, Real(0.2) } }; break;
			case 3:
				collider.vertices = { { -1, -1 }, { 0, bytes_.real(1) }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
				collider.concave = true;
				break;
		}
		collider.radius = bytes_.chance() ? bytes_.any(0.5) : Real(0);
		collider.surface = surface();
		if (bytes_.integer(0, 3) == 0) {
			collider.one_way = Rotation::from_angle(bytes_.real(3)).apply({ 1, 0 });
		}
		if (bytes_.chance()) {
			if (const auto rigid = world_.add_rigid_body(rigid_body())) {
				collider.rigid_body = rigid.value();
			}
		}
		if (collider.vertices.size() == 2 && bytes_.chance()) {
			testing::add_chain(world_, collider.vertices, false, collider);
			return;
		}
		world_.add_collider(std::move(collider));
	}

	RigidBody rigid_body() {
		RigidBody rigid;
		rigid.pose = { bytes_.vector(4), Rotation::from_angle(bytes_.real(3)) };
		rigid.linear_velocity = bytes_.any_vector(10);
		rigid.angular_velocity = bytes_.any(10);
		rigid.acceleration = bytes_.vector(10);
		rigid.inverse_mass = bytes_.chance() ? bytes_.any(10) : Real(0);
		rigid.inverse_inertia = bytes_.chance() ? bytes_.any(10) : Real(0);
		rigid.tag = bytes_.byte() % 4u;
		return rigid;
	}

	JointAnchor anchor() {
		switch (bytes_.integer(0, 3)) {
			case 0: return JointAnchor::at_place(bytes_.any_vector(4));
			case 1: {
				const std::uint64_t tag = bytes_.byte() % 4u;
				return JointAnchor::on_rigid_body(tag, bytes_.vector(1));
			}
			case 2: {
				const BodyId body = id();
				const std::uint32_t edge = point();
				return JointAnchor::on_edge(body, edge, bytes_.any(1));
			}
			default: {
				const BodyId body = id();
				return JointAnchor::on_point(body, point());
			}
		}
	}

	void change_joints() {
		Joint joint;
		joint.first = anchor();
		joint.second = anchor();
		joint.rest_length = bytes_.chance() ? bytes_.any(2) : Real(0);
		joint.stiffness = bytes_.chance() ? bytes_.any(1000) : joint.stiffness;
		joint.damping = bytes_.positive(2);
		joint.break_force = bytes_.chance() ? bytes_.any(100) : joint.break_force;
		joint.collide_joined = bytes_.chance();
		const std::size_t count = world_.joints().size();
		const JointId existing = count > 0 ? world_.joint_id_at(bytes_.byte() % count) : JointId{};
		switch (bytes_.integer(0, 3)) {
			case 0: world_.remove_joint(existing); break;
			case 1: world_.set_joint(existing, joint); break;
			default:
				if (count < 8) {
					(void)world_.add_joint(joint);
				}
		}
	}

	void push(SoftBodyData &body) {
		const Vec2 value = bytes_.any_vector(20);
		switch (bytes_.integer(0, 7)) {
			case 0: body.add_external_force(point(), value); break;
			case 1: body.apply_impulse(point(), value); break;
			case 2: apply_rigid_impulse(body, value, bytes_.any_vector(2)); break;
			case 3: apply_angular_impulse(body, value.x); break;
			case 4: add_rigid_force(body, value, bytes_.any_vector(2)); break;
			case 5: add_torque(body, value.x); break;
			case 6: set_linear_velocity(body, value); break;
			case 7: body.set_acceleration(value); break;
		}
	}

	void change_body(SoftBodyData &body) {
		switch (bytes_.integer(0, 10)) {
			case 0: body.set_settings(settings()); break;
			case 1: {
				const Vec2 place = bytes_.any_vector(4);
				body.set_point(point(), place, bytes_.any_vector(10));
				break;
			}
			case 2: body.set_pinned(point(), bytes_.chance()); break;
			case 3: {
				const std::uint32_t pin = point();
				body.set_pinned(pin, true);
				body.set_pin_target(pin, bytes_.any_vector(4));
				break;
			}
			case 4: body.set_active(bytes_.chance()); break;
			case 5: body.set_frozen(bytes_.chance()); break;
			case 6: body.put_to_sleep(); break;
			case 7: body.wake(); break;
			case 8: {
				const Pose from = pose();
				body.teleport(from, pose());
				break;
			}
			case 9: body.set_shape(shapes()[bytes_.byte() % shapes().size()]); break;
			case 10: body.set_ignored_tags(std::array{ std::uint64_t(bytes_.byte() % 4u) }); break;
		}
	}

	void save() {
		saved_.clear();
		for (std::size_t i = 0; i < world_.soft_bodies().size(); ++i) {
			saved_.push_back({ world_.id_at(i), world_.soft_bodies()[i].save_state() });
		}
	}

	void restore() {
		for (const auto &[id, state] : saved_) {
			SoftBodyData *body = world_.find(id);
			if (body != nullptr && !body->restore_state(state)) {
				require(body->save_state() == state, "what was put back is there");
			}
		}
	}

	void step() {
		if (++steps_ > MOST_STEPS) {
			return;
		}
		constexpr std::array<Real, 5> TICKS = { Real(1) / 60, Real(1) / 240, Real(1) / 30, Real(1e-4), 1 };
		const std::uint8_t choice = bytes_.byte();
		const Real dt = choice == 255 ? bytes_.any(1) : TICKS[choice % TICKS.size()];
		const StepReport report = simulator_.simulate(dt);
		require(report.refused.has_value() == !(std::isfinite(dt) && dt > 0), "steps are refused for their time alone");
		if (report.refused) {
			return;
		}
		for (const BodyId reset : report.reset_bodies) {
			require(world_.find(reset) != nullptr, "bodies that were reset are there");
			hash_.add(reset.index);
		}
		for (const JointId broken : report.broken_joints) {
			require(world_.find_joint(broken) == nullptr, "broken joints are gone");
		}
		for (const SoftBodyData &body : world_.soft_bodies()) {
			if (!body.is_active()) {
				continue; // it keeps what it was given: an impulse may have been too large for its mass
			}
			require(std::ranges::all_of(body.positions(), [](Vec2 p) { return is_finite(p); }), "positions are finite after a step");
			require(std::ranges::all_of(body.velocities(), [](Vec2 v) { return is_finite(v); }), "velocities are finite after a step");
			require(!(body.is_asleep() && body.is_frozen()), "what is frozen does not sleep");
		}
		for (const RigidBody &rigid : world_.rigid_bodies()) {
			require(is_finite(rigid.pose.position) && is_finite(rigid.linear_velocity) && std::isfinite(rigid.angular_velocity),
					"rigid bodies are finite after a step");
		}
		for (const Contact &contact : simulator_.contacts()) {
			require(world_.find(contact.body) != nullptr, "contacts are of bodies that are there");
			require(is_finite(contact.point), "contacts have a place");
			require(is_finite(contact.normal), "contacts have a normal");
			require(std::isfinite(contact.normal_impulse) && contact.normal_impulse >= 0, "contacts have an impulse, and do not pull");
			require(std::isfinite(contact.depth) && contact.depth >= 0, "contacts have a depth");
		}
		if (is_compared_) {
			hash_.add(testing::hash_of_state(world_));
			hash_.add(testing::hash_of_contacts(simulator_));
		}
	}

	void call() {
		const int choice = bytes_.integer(0, 31);
		SoftBodyData *chosen = choice >= 8 && choice < 20 ? body() : nullptr;
		if (choice < 5) {
			add_body();
		} else if (choice == 5) {
			const BodyId removed = id();
			world_.remove_soft_body(removed);
			require(world_.find(removed) == nullptr, "what was removed is gone");
		} else if (choice == 6) {
			add_environment();
		} else if (choice == 7) {
			change_world();
		} else if (choice < 14) {
			if (chosen != nullptr) {
				change_body(*chosen);
			}
		} else if (choice < 20) {
			if (chosen != nullptr) {
				push(*chosen);
			}
		} else if (choice == 20) {
			save();
		} else if (choice == 21) {
			restore();
		} else if (choice == 22) {
			change_joints();
		} else if (choice == 23) {
			const BodyId a = id();
			const BodyId b = id();
			bytes_.chance() ? (void)world_.add_collision_exception(a, b) : (void)world_.remove_collision_exception(a, b);
		} else if (choice == 24 && !world_.rigid_bodies().empty()) {
			world_.set_rigid_body(bytes_.byte() % std::uint32_t(world_.rigid_bodies().size() + 1), rigid_body());
		} else if (choice == 25) {
			world_.clear_environment();
		} else {
			step();
		}
	}

	struct Saved {
		BodyId id;
		BodyState state;
	};
	Bytes bytes_;
	WorldData world_;
	Simulator simulator_;
	std::vector<BodyId> ids_;
	std::vector<Saved> saved_;
	int steps_ = 0;
	bool is_compared_;
	testing::BitHash hash_;
};

} // namespace

void fuzz_world(std::span<const std::uint8_t> data) {
	// A second run and the hashes of both take two thirds of the time, so one input in four has them, by its length.
	const bool is_compared = data.size() % 4 == 0;
	const std::uint64_t forwards = Session(data, {}, is_compared).run();
	if (!is_compared) {
		return;
	}
	// Whoever relies on the order of tasks is found out by the other order.
	const ParallelFor backwards = [](std::size_t count, const std::function<void(std::size_t)> &task) {
		for (std::size_t i = count; i > 0; --i) {
			task(i - 1);
		}
	};
	require(Session(data, backwards, is_compared).run() == forwards, "the order of tasks changes no bit");
}

} // namespace softbody::fuzzing
