// SPDX-License-Identifier: MIT
// A world as a new project has it, bodies as new nodes are, and what the scenes of the field are judged by.
#include "field_stage.h"

#include "core/creator/hulls.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/substep_plan.h"
#include "core/geometry/aabb.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "thesis/polygon_overlap.h"

#include <algorithm>
#include <cmath>

namespace bench {

using nlohmann::json;
using softbody::Real;
using softbody::SoftBodyData;
using softbody::Vec2;

namespace {

constexpr int POINTS = 16;
constexpr int SAMPLE = 6; // ticks from one look at penetration to the next
constexpr double JOULE = PIXELS_A_METER * PIXELS_A_METER; // kg px²/s²

} // namespace

Points rectangle(double width, double height) {
	const Real x = Real(width / 2);
	const Real y = Real(height / 2);
	return divided({ { -x, -y }, { x, -y }, { x, y }, { -x, y } }, POINTS);
}

Vec2 center_outline(Points &outline) {
	const Vec2 center = softbody::area_centroid(outline);
	for (Vec2 &p : outline) {
		p = p - center;
	}
	return center;
}

Stage::Stage(const Firmness &firmness, double gravity) : simulator_(world_), firmness_(firmness) {
	check(world_.set_length_unit(Real(PIXELS_A_METER)));
	check(world_.set_gravity({ 0, Real(gravity) }));
}

void Stage::add_wall(Vec2 at, Vec2 normal, Vec2 velocity) {
	softbody::Border border;
	border.plane = { at, normal };
	border.surface.linear_velocity = velocity;
	check(world_.add_border(border));
}

void Stage::add_floor() {
	add_wall({ 0, 0 }, { 0, -1 });
}

softbody::BodyId Stage::add(const Points &outline, Vec2 at, double mass, double angle) {
	softbody::Material material;
	material.youngs_modulus *= Real(firmness_.times);
	material.damping_ratio = Real(values.damping_ratio);
	ElasticBody node = elastic_body(default_model(), outline, mass, material);
	node.settings.friction = Real(values.friction);
	node.settings.restitution = Real(values.restitution);
	node.settings.rolling_resistance = Real(values.rolling_resistance);
	node.settings.linear_damp = Real(values.linear_damp);
	node.settings.angular_damp = Real(values.angular_damp);
	node.settings.can_sleep = values.can_sleep;
	node.settings.integrator = values.integrator;
	node.settings.substeps = values.substeps;
	node.settings.self_collision = softbody::has_deep_dents(outline);
	if (softbody::plan_substeps(*node.shape, node.settings, Real(TICK), true).substeps < values.least_substeps) {
		node.settings.substeps = values.least_substeps;
	}
	const softbody::Pose pose{ at, softbody::Rotation::from_angle(Real(angle)) };
	return world_.add_soft_body(take(SoftBodyData::create(node.shape, node.settings, pose)));
}

softbody::JointAnchor Stage::anchor(softbody::BodyId id, Vec2 place) const {
	return softbody::nearest_anchor(body(id), id, place);
}

void Stage::join(const softbody::JointAnchor &first, const softbody::JointAnchor &second) {
	softbody::Joint joint;
	joint.first = first;
	joint.second = second;
	take(world_.add_joint(joint));
	if (first.is_soft() && second.is_soft()) {
		const auto bodies = world_.soft_bodies();
		const auto a = std::size_t(world_.find(first.body) - bodies.data());
		const auto b = std::size_t(world_.find(second.body) - bodies.data());
		joined_.insert(std::minmax(a, b));
	}
}

void Stage::step() {
	const bool is_awake = !all_asleep();
	const Stopwatch watch;
	const softbody::StepReport report = simulator_.simulate(Real(TICK));
	if (is_awake) {
		awake_time_ += watch.elapsed().cpu;
		++awake_ticks_;
	}
	++ticks_;
	resets_ += report.reset_bodies.size();
	widest_gap_ = std::max(widest_gap_, gap());
	if (ticks_ % SAMPLE == 0) {
		deepest_ = std::max(deepest_, penetration());
	}
	if (asleep_after_.is_null() && all_asleep()) {
		asleep_after_ = seconds();
	}
}

void Stage::run(double seconds, const std::function<bool()> &is_over) {
	const int last = ticks_ + int(std::lround(seconds / TICK));
	while (ticks_ < last && !all_asleep()) {
		step();
		if (is_over && is_over()) {
			break;
		}
	}
}

Vec2 Stage::center(softbody::BodyId id) const {
	return softbody::measure_frame(body(id)).center;
}

bool Stage::all_asleep() const {
	return std::ranges::all_of(world_.soft_bodies(), [](const SoftBodyData &body) { return body.is_asleep(); });
}

double Stage::us_per_body_step() const {
	return 1e6 * awake_time_ / (double(std::max(awake_ticks_, 1)) * double(world_.soft_bodies().size()));
}

int Stage::contact_substeps() const {
	int substeps = world_.contact_substeps();
	for (const SoftBodyData &body : world_.soft_bodies()) {
		substeps = std::max(substeps, std::min(simulator_.plan(body, Real(TICK)).substeps, softbody::MAX_CONTACT_SUBSTEPS));
	}
	return substeps;
}

double Stage::gap() const {
	const auto place = [&](const softbody::JointAnchor &anchor) {
		return anchor.is_soft() ? softbody::position_of(anchor, body(anchor.body)) : anchor.position;
	};
	double widest = 0;
	for (const softbody::Joint &joint : world_.joints()) {
		widest = std::max(widest, double(length(place(joint.second) - place(joint.first))));
	}
	return widest;
}

double Stage::penetration() const {
	const auto bodies = world_.soft_bodies();
	std::vector<softbody::Aabb> boxes;
	double worst = 0;
	for (const SoftBodyData &body : bodies) {
		boxes.push_back(softbody::bounding_box(body.hull()));
		for (const softbody::Border &border : world_.borders()) {
			for (const Vec2 p : body.hull()) {
				const double depth = -double(softbody::signed_distance(border.plane, p));
				worst = std::max(worst, depth / double(body.shape().width()));
			}
		}
	}
	for (std::size_t i = 0; i < bodies.size(); ++i) {
		for (std::size_t j = 0; j < i; ++j) {
			if (boxes[i].overlaps(boxes[j]) && !joined_.contains({ j, i })) {
				const double width = std::min(bodies[i].shape().width(), bodies[j].shape().width());
				worst = std::max(worst, softbody::penetration_depth(bodies[i].hull(), bodies[j].hull()) / width);
			}
		}
	}
	return worst;
}

double Stage::speed() const {
	double sum = 0;
	for (const SoftBodyData &body : world_.soft_bodies()) {
		sum += double(length_squared(softbody::measure_frame(body).velocity));
	}
	return std::sqrt(sum / double(world_.soft_bodies().size()));
}

double Stage::kinetic_energy() const {
	double sum = 0;
	for (const SoftBodyData &body : world_.soft_bodies()) {
		sum += softbody::measure_energy(body, {}).kinetic;
	}
	return sum / JOULE / double(world_.soft_bodies().size());
}

double Stage::area(softbody::BodyId id) const {
	return double(softbody::signed_area(body(id).hull())) / double(body(id).shape().rest_area());
}

double Stage::least_area() const {
	double least = 1e30;
	for (std::size_t i = 0; i < world_.soft_bodies().size(); ++i) {
		least = std::min(least, area(world_.id_at(i)));
	}
	return least;
}

json Stage::row(const char *scene) const {
	const std::size_t count = world_.soft_bodies().size();
	std::size_t folded = 0;
	for (const SoftBodyData &body : world_.soft_bodies()) {
		folded += softbody::is_folded(body.hull()) ? 1 : 0;
	}
	return { { "scene", scene }, { "material", firmness_.name }, { "bodies", count }, { "seconds", seconds() },
		{ "us_per_body_step", us_per_body_step() }, { "worst_penetration_R", worst_penetration() },
		{ "penetration_at_end_R", penetration() },
		{ "least_area", least_area() }, { "folded", folded }, { "resets", resets_ }, { "asleep_after_s", asleep_after_ },
		{ "energy_at_end_J", kinetic_energy() } };
}

} // namespace bench
