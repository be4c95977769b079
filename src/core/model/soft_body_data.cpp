// SPDX-License-Identifier: MIT
// Creation and checked changes of a soft body's state.
#include "core/model/soft_body_data.h"

#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace softbody {

namespace {

// Time for which a body takes no damage after its shape was set or it was torn [s]: about as long as it takes to settle.
constexpr Real DAMAGE_PAUSE = Real(0.25);

// Cosine of the turn on the spot from which on a body counts as placed anew [1]. Corrections of its rotation are smaller.
constexpr double PLACED_TURN = 0.99;

Status check_pose(const Pose &pose) {
	const Vec2 rotation{ pose.rotation.c, pose.rotation.s };
	if (Status status = first_error({ check_finite("pose", pose.position), check_finite("pose", rotation) })) {
		return status;
	}
	return check_unit_length("pose", rotation, "make its rotation with Rotation::from_angle");
}

// The turn from one rotation to another, in double precision: in single precision it would scale what it turns by up to 1e-7, always
// in the same direction where the turn is the same, and many turns add up.
struct ExactTurn {
	double c = 1;
	double s = 0;

	ExactTurn(const Rotation &from, const Rotation &to) {
		c = double(to.c) * double(from.c) + double(to.s) * double(from.s);
		s = double(to.s) * double(from.c) - double(to.c) * double(from.s);
		const double size = std::sqrt(c * c + s * s);
		c /= size;
		s /= size;
	}
	/// `point` turned about `center`, which comes to lie at `place`.
	Vec2 apply(Vec2 point, Vec2 center, Vec2 place) const {
		const double x = double(point.x) - double(center.x);
		const double y = double(point.y) - double(center.y);
		return { Real(double(place.x) + c * x - s * y), Real(double(place.y) + s * x + c * y) };
	}
};

} // namespace

Result<SoftBodyData> SoftBodyData::create(std::shared_ptr<const SoftBodyShape> shape, const BodySettings &settings,
		const Pose &pose) {
	if (!shape) {
		return Error{ "shape", "null", "must be a shape", "create one with SoftBodyCreator" };
	}
	if (Status status = first_error({ check_settings(settings), check_pose(pose) })) {
		return *status;
	}
	SoftBodyData body;
	body.settings_ = settings;
	const std::size_t count = shape->point_count();
	body.memory_.previous_positions.reserve(count);
	for (const Vec2 rest : shape->rest_positions()) {
		body.memory_.previous_positions.push_back(pose.apply(rest + shape->origin_offset()));
	}
	body.state_.assign(2 * count + 1, Vec2{});
	std::ranges::copy(body.memory_.previous_positions, body.state_.begin());
	body.set_rotation_memory(pose.rotation);
	body.shape_ = std::move(shape);
	body.own_shape();
	return body;
}

void SoftBodyData::wake() {
	if (memory_.frozen) {
		return; // a frozen body does not sleep, and its contacts are no reason to wake
	}
	if (memory_.rest.asleep && changes_) {
		changes_->woken_islands.push_back({ memory_.rest.island, memory_.rest.restored });
	}
	memory_.rest.asleep = false;
	memory_.rest.rest_time = 0;
}

void SoftBodyData::disturb() {
	wake();
	if (memory_.frozen && changes_) {
		changes_->disturbed_boxes.push_back(bounding_box(hull())); // bodies that rest on it share no island with it
	}
}

void SoftBodyData::put_to_sleep() {
	// The step counts its islands from 1.
	constexpr std::uint64_t NOT_OF_A_STEP = std::uint64_t(1) << 63;
	if (memory_.frozen) {
		return;
	}
	std::ranges::fill(mutable_velocities(), Vec2{});
	clear_external_forces();
	note_change(); // the step determines sleeping bodies anew
	memory_.rest = {};
	memory_.rest.asleep = true;
	memory_.fluids = ANY_FLUIDS;
	memory_.rest.island = NOT_OF_A_STEP | (changes_ ? ++changes_->put_to_sleep : 0);
}

void SoftBodyData::note_change() {
	memory_.last_valid_hull.clear();
	disturb();
	count(&ChangeCounts::arrangement);
}

void SoftBodyData::set_frozen(bool frozen) {
	if (frozen == memory_.frozen) {
		return;
	}
	note_change();
	memory_.frozen = frozen;
	disturb();
	frozen_inverse_masses_.assign(frozen ? point_count() : 0, Real(0));
	std::ranges::fill(mutable_velocities(), Vec2{});
	memory_.touch = {};
	clear_external_forces();
	clear_pin_targets();
}

void SoftBodyData::set_active(bool active) {
	if (active != memory_.active) {
		memory_.active = active;
		note_change();
	}
}

void SoftBodyData::set_ignored_tags(std::span<const std::uint64_t> tags) {
	std::vector<std::uint64_t> wanted(tags.begin(), tags.end());
	std::ranges::sort(wanted);
	wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
	std::erase(wanted, 0u);
	if (wanted != ignored_tags_) {
		ignored_tags_ = std::move(wanted);
		note_change();
	}
}

bool SoftBodyData::ignores_tag(std::uint64_t tag) const {
	return !ignored_tags_.empty() && std::ranges::binary_search(ignored_tags_, tag);
}

Status SoftBodyData::set_settings(const BodySettings &settings) {
	if (Status status = check_settings(settings)) {
		return status;
	}
	settings_ = settings;
	own_shape();
	note_change();
	return {};
}

Status SoftBodyData::set_shape(std::shared_ptr<const SoftBodyShape> shape) {
	if (!shape || shape->point_count() != point_count() || shape->hull_count() != shape_->hull_count()) {
		return Error{ "shape", shape ? std::to_string(shape->point_count()) + " points" : "null",
			"must have the body's " + std::to_string(point_count()) + " points and " +
					std::to_string(shape_->hull_count()) + " hull points",
			"remove the body and create another" };
	}
	for (std::size_t i = 0; i < pinned_inverse_masses_.size(); ++i) {
		if (pinned_inverse_masses_[i] != 0) {
			pinned_inverse_masses_[i] = shape->inverse_masses()[i];
		}
	}
	const SoftBodyData before = own_shape_.has_value() ? *this : SoftBodyData();
	shape_ = std::move(shape);
	own_shape_ = {};
	own_shape();
	if (before.own_shape_.has_value()) {
		adopt_dents(before);
	}
	note_change();
	return {};
}

// A body that may be dented has a shape of its own; so has one that is dented and may be no more.
void SoftBodyData::own_shape() {
	if (settings_.can_dent() && !own_shape_.has_value()) {
		own_shape_ = OwnShape(*shape_);
	} else if (!settings_.can_dent() && !is_dented()) {
		own_shape_ = {};
	}
}

bool SoftBodyData::is_dented() const {
	return own_shape_.has_value() && !std::ranges::equal(own_shape_->rest_positions(), shape_->rest_positions());
}

Real SoftBodyData::dent() const {
	Real largest = 0;
	for (const Spring2D &spring : is_dented() ? shape_->springs() : std::span<const Spring2D>()) {
		const auto distance = [&](std::span<const Vec2> places) { return length(places[spring.b] - places[spring.a]); };
		largest = std::max(largest, std::abs(distance(own_shape_->rest_positions()) / distance(shape_->rest_positions()) - 1));
	}
	return largest;
}

void SoftBodyData::reset_dents() {
	if (is_dented()) {
		const std::vector<Vec2> before(shape().rest_positions().begin(), shape().rest_positions().end());
		const BodyFrame frame = measure_frame(*this);
		restore_dents({});
		follow_rest(before, frame);
		pause_damage();
		note_change();
	}
}

void SoftBodyData::pause_damage() {
	memory_.damage_pause = DAMAGE_PAUSE;
}

void SoftBodyData::follow_rest(std::span<const Vec2> before, const BodyFrame &frame) {
	for (const std::span<Vec2> points : { mutable_positions(), mutable_previous_positions() }) {
		for (std::size_t i = 0; i < points.size(); ++i) {
			if (inverse_masses()[i] > 0) {
				points[i] += frame.rotation.apply(shape().rest_positions()[i] - before[i]);
			}
		}
	}
}

Status SoftBodyData::set_rest_positions(std::span<const Vec2> places) {
	if (places.size() != point_count()) {
		return Error{ "rest_positions", std::to_string(places.size()) + " entries", "must have one a point, " + std::to_string(point_count()),
			"give each point a place" };
	}
	if (Status status = check_all_finite("rest_positions", places)) {
		return status;
	}
	if (is_folded(places.first(shape_->hull_count()))) {
		return Error{ "rest_positions", "a folded hull", "must be a simple polygon of positive area", "move the points less" };
	}
	const std::vector<Vec2> before(shape().rest_positions().begin(), shape().rest_positions().end());
	const BodyFrame frame = measure_frame(*this);
	restore_dents(places);
	follow_rest(before, frame);
	pause_damage();
	note_change();
	return {};
}

void SoftBodyData::restore_dents(std::span<const Vec2> rest_positions) {
	own_shape_ = {};
	own_shape();
	if (!rest_positions.empty()) {
		own_shape_ = OwnShape(*shape_);
		own_shape_->move_rest(rest_positions, *shape_);
		own_shape_->renew_bounds();
	}
}

void SoftBodyData::adopt_dents(const SoftBodyData &other) {
	if (!other.is_dented() || other.point_count() != point_count() || other.shape_->hull_count() != shape_->hull_count()) {
		return;
	}
	std::vector<Vec2> places(shape_->rest_positions().begin(), shape_->rest_positions().end());
	const Real size = shape_->radius() / other.shape_->radius();
	for (std::size_t i = 0; i < places.size(); ++i) {
		places[i] += (other.own_shape_->rest_positions()[i] - other.shape_->rest_positions()[i]) * size;
	}
	if (!is_folded(std::span<const Vec2>(places).first(shape_->hull_count()))) {
		restore_dents(places);
		note_change();
	}
}

Point2D SoftBodyData::point(std::size_t index) const {
	Point2D point{ positions()[index], velocities()[index], {}, shape_->masses()[index], inverse_masses()[index] };
	for (const ExternalForce &external : memory_.external_forces) {
		if (external.point == index) {
			point.force += external.force;
		}
	}
	return point;
}

Status SoftBodyData::check_point(std::uint32_t point, const char *what, Vec2 value) const {
	return first_error({ check_index("point", point, point_count(), "use an index of an existing point"), check_finite(what, value) });
}

Status SoftBodyData::add_external_force(std::uint32_t point, Vec2 force) {
	if (Status status = check_point(point, "force", force)) {
		return status;
	}
	if (memory_.frozen) {
		return {};
	}
	wake();
	memory_.external_forces.push_back({ point, force });
	count(&ChangeCounts::forces);
	return {};
}

Status SoftBodyData::set_acceleration(Vec2 acceleration) {
	if (Status status = check_finite("acceleration", acceleration)) {
		return status;
	}
	if (acceleration != memory_.acceleration) {
		memory_.acceleration = acceleration;
		wake();
		count(&ChangeCounts::forces);
	}
	return {};
}

void SoftBodyData::set_fluids(std::uint64_t fluids) {
	const std::uint64_t before = std::exchange(memory_.fluids, fluids);
	if (before != fluids && before != ANY_FLUIDS) {
		wake();
	}
}

Status SoftBodyData::add_fluid_force(std::uint32_t point, Vec2 force) {
	if (Status status = check_point(point, "force", force)) {
		return status;
	}
	if (!memory_.frozen && !memory_.rest.asleep) {
		memory_.external_forces.push_back({ point, force });
		count(&ChangeCounts::forces);
	}
	return {};
}

Vec2 SoftBodyData::total_acceleration(Vec2 gravity) const {
	const Vec2 falling = gravity * settings_.gravity_scale;
	if (memory_.acceleration == Vec2{}) {
		return falling;
	}
	const Vec2 total = falling + memory_.acceleration;
	const Real rounding = 4 * std::numeric_limits<Real>::epsilon();
	return length_squared(total) > rounding * rounding * length_squared(falling) ? total : Vec2{};
}

void SoftBodyData::queue_load(const RigidLoad &load) {
	if (is_frozen()) {
		return;
	}
	wake();
	memory_.load.force += load.force;
	memory_.load.torque += load.torque;
	count(&ChangeCounts::forces);
}

Status SoftBodyData::apply_impulse(std::uint32_t point, Vec2 impulse) {
	if (Status status = check_point(point, "impulse", impulse)) {
		return status;
	}
	if (memory_.frozen) {
		return {};
	}
	wake();
	mutable_velocities()[point] += impulse * inverse_masses()[point];
	return {};
}

Status SoftBodyData::set_point(std::uint32_t point, Vec2 position, Vec2 velocity) {
	if (Status status = first_error({ check_point(point, "position", position), check_finite("velocity", velocity) })) {
		return status;
	}
	disturb();
	memory_.last_valid_hull.clear();
	memory_.one_ways.clear();
	mutable_positions()[point] = position;
	mutable_velocities()[point] = memory_.frozen ? Vec2{} : velocity;
	disturb();
	return {};
}

Status SoftBodyData::set_pinned(std::uint32_t point, bool pinned) {
	if (Status status = check_point(point, "position", {})) {
		return status;
	}
	if (pinned && !has_pins()) {
		pinned_inverse_masses_.assign(shape_->inverse_masses().begin(), shape_->inverse_masses().end());
	}
	std::erase_if(memory_.pin_targets, [point](const PinTarget &target) { return target.point == point; });
	if (pinned) {
		pinned_inverse_masses_[point] = 0;
		mutable_velocities()[point] = {};
	} else if (has_pins()) {
		pinned_inverse_masses_[point] = shape_->inverse_masses()[point];
		if (std::ranges::find(pinned_inverse_masses_, Real(0)) == pinned_inverse_masses_.end()) {
			pinned_inverse_masses_.clear();
		}
	}
	note_change();
	return {};
}

Status SoftBodyData::set_pin_target(std::uint32_t point, Vec2 position) {
	if (Status status = check_point(point, "position", position)) {
		return status;
	}
	if (!is_pinned(point)) {
		return Error{ "point", std::to_string(point), "must be pinned", "pin it with set_pinned first" };
	}
	if (memory_.frozen) {
		return {};
	}
	std::erase_if(memory_.pin_targets, [point](const PinTarget &target) { return target.point == point; });
	if (position == positions()[point]) {
		return {};
	}
	wake();
	memory_.pin_targets.push_back({ point, position });
	count(&ChangeCounts::pin_targets);
	return {};
}

Status SoftBodyData::teleport(const Pose &reference, const Pose &pose) {
	if (Status status = first_error({ check_pose(reference), check_pose(pose) })) {
		return status;
	}
	disturb();
	const ExactTurn turn(reference.rotation, pose.rotation);
	for (const std::span<Vec2> points : { mutable_positions(), mutable_previous_positions() }) {
		for (Vec2 &p : points) {
			p = turn.apply(p, reference.position, pose.position);
		}
	}
	disturb();
	memory_.last_valid_hull.clear();
	memory_.placed |= pose.position != reference.position || turn.c < PLACED_TURN;
	memory_.touch = {};
	memory_.one_ways.clear();
	const Rotation memory = rotation_memory();
	const double c = turn.c * double(memory.c) - turn.s * double(memory.s);
	const double s = turn.s * double(memory.c) + turn.c * double(memory.s);
	const double size = std::sqrt(c * c + s * s);
	set_rotation_memory({ Real(c / size), Real(s / size) });
	return {};
}

} // namespace softbody
