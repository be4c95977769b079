// SPDX-License-Identifier: MIT
// A body of Godot's physics server in the place of a soft body.
#include "godot/surroundings/hull_proxy.h"

#include "godot/convert.h"

#include <godot_cpp/classes/physics_direct_space_state2d.hpp>
#include <godot_cpp/classes/physics_point_query_parameters2d.hpp>
#include <godot_cpp/variant/transform2d.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

// Largest distance of the polygons from the hull [px]. The engine is not told of smaller moves.
constexpr Real OUTLINE_TOLERANCE = Real(0.05);

// Largest distance of the engine body's origin, at which areas with point gravity pull, from the center of mass [px].
constexpr Real ORIGIN_TOLERANCE = Real(0.5);

// Depth from which on a dent is shown, as a share of the body's radius, and at least in px: that of a body alone, and of
// one that a kinematic body presses. Smaller: bodies that are squashed in a pile are many shapes each, and shape queries
// with few results miss bodies.
constexpr Real DENT_TOLERANCE = Real(0.08);
constexpr Real PRESSED_DENT_TOLERANCE = Real(0.03);
constexpr Real LEAST_DENT_TOLERANCE = 1;

// Ticks without a deep dent before a hull is shown in one piece again.
constexpr int SMOOTH_FOLLOWS = 30;

// Distance from a rider within which the outline is the hull [px].
constexpr Real RIDER_MARGIN = 8;

// Speeds below which the engine's body counts as still [px/s, rad/s]. A floor carries a character, and the character
// moves the floor by friction: with the tremor of a pressed jelly passed on, the two wander off together.
constexpr Real SPEED_TOLERANCE = 3;
constexpr Real SPIN_TOLERANCE = Real(0.05);

std::unordered_map<std::int64_t, RID> proxies; // by id
std::uint64_t made = 0;

// Outward unit normals of a hull's corners: between those of the two edges.
std::vector<Vec2> corner_normals(std::span<const Vec2> hull) {
	const std::size_t count = hull.size();
	std::vector<Vec2> normals(count);
	for (std::size_t i = 0; i < count; ++i) {
		const Vec2 before = hull[i] - hull[(i + count - 1) % count];
		const Vec2 after = hull[(i + 1) % count] - hull[i];
		const Vec2 along = before * (1 / length(before)) + after * (1 / length(after));
		const Real size = length(along);
		// At a spike that turns back, the normal is the direction of the spike.
		normals[i] = size > Real(1e-3) ? Vec2{ along.y, -along.x } * (1 / size) : before * (1 / length(before));
	}
	return normals;
}

} // namespace

HullProxy::Scratch HullProxy::scratch_;

bool is_hull_proxy(const RID &body) {
	return proxies.contains(body.get_id());
}

std::size_t hull_proxy_count() {
	return proxies.size();
}

void append_hull_proxies(TypedArray<RID> &list) {
	for (const auto &[id, proxy] : proxies) {
		list.push_back(proxy);
	}
}

std::uint64_t hull_proxies_made() {
	return made;
}

// Exchanged shapes wait in a list that the engine processes before it steps or moves a body, but not before a ray
// query. Turning a body by nothing makes the engine process it.
void flush_hull_proxies(const RID &any) {
	PhysicsServer2D::get_singleton()->body_apply_torque_impulse(any, 0);
}

// Commands wait in a queue. A question that the server's thread answers comes after them.
void await_hull_proxies(const RID &any) {
	PhysicsServer2D::get_singleton()->body_get_mode(any);
}

HullProxy::~HullProxy() {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	if (!rid_.is_valid() || server == nullptr) {
		return;
	}
	proxies.erase(rid_.get_id());
	server->free_rid(rid_);
	drop_slots(0);
}

RID HullProxy::rid() {
	if (!rid_.is_valid()) {
		PhysicsServer2D *server = PhysicsServer2D::get_singleton();
		rid_ = server->body_create();
		server->body_set_mode(rid_, PhysicsServer2D::BODY_MODE_KINEMATIC);
		server->body_set_collision_mask(rid_, 0);
		proxies.emplace(rid_.get_id(), rid_);
		is_new_ = true;
		++made;
	}
	return rid_;
}

void HullProxy::set_collider(std::uint64_t instance_id) {
	PhysicsServer2D::get_singleton()->body_attach_object_instance_id(rid(), instance_id);
}

void HullProxy::set_layer(std::uint32_t layer) {
	PhysicsServer2D::get_singleton()->body_set_collision_layer(rid(), layer);
}

void HullProxy::enter(const RID &space, const SoftBodyData &body, Real inset) {
	in_space_ = true;
	space_ = space;
	still_ = false;
	placed_ = false;
	follow(body, inset, false);
	PhysicsServer2D::get_singleton()->body_set_space(rid(), space);
}

void HullProxy::leave() {
	if (!in_space_) {
		return;
	}
	in_space_ = false;
	PhysicsServer2D::get_singleton()->body_set_space(rid_, RID());
	begin_near();
	end_near();
}

// Crowds come of one kind at a time, so the last division is the one that is asked for again.
std::shared_ptr<const HullProxy::Division> HullProxy::division_of(std::span<const Vec2> rest_hull) {
	static std::shared_ptr<const Division> last;
	if (last == nullptr || !std::ranges::equal(last->rest_hull, rest_hull)) {
		last = std::make_shared<const Division>(Division{
				{ rest_hull.begin(), rest_hull.end() }, divide_hull(rest_hull), corner_normals(rest_hull) });
	}
	return last;
}

// Existing slots are kept, so that areas do not see the body leave and come back as its size changes.
void HullProxy::divide(const SoftBodyData &body) {
	division_ = division_of(body.shape().rest_hull());
	shown_.clear();
	divided_ = false;
	has_cuts_ = false;
	drop_slots(parts().convex.size());
}

// The outline to be shown: the hull, drawn in where a kinematic body may come.
void HullProxy::trace(const SoftBodyData &body, const BodyFrame &frame, Real inset) {
	const std::span<const Vec2> hull = body.hull();
	scratch_.outline.assign(hull.begin(), hull.end());
	if (!(inset > 0)) {
		return;
	}
	const std::span<const Vec2> rest = body.shape().rest_hull();
	mark_at_riders(hull, riders_, RIDER_MARGIN, scratch_.under_rider);
	for (std::size_t i = 0; i < hull.size(); ++i) {
		if (scratch_.under_rider[i]) {
			continue; // the step has pressed it in
		}
		const Vec2 normal = frame.rotation.apply(division_->rest_normals[i]);
		const Real pressed_in = dot(frame.center + frame.rotation.apply(rest[i]) - hull[i], normal);
		scratch_.outline[i] -= normal * std::clamp(inset - pressed_in, Real(0), inset);
	}
}

// The engine takes a kinematic body's transform over at the end of its step, but its first one at once, and the first
// one after another mode counts as that.
bool HullProxy::place(const BodyFrame &frame, bool exactly) {
	const Real tolerance = exactly ? OUTLINE_TOLERANCE : ORIGIN_TOLERANCE;
	if (placed_ && length_squared(frame.center - origin_) <= tolerance * tolerance) {
		return false;
	}
	placed_ = true;
	origin_ = frame.center;
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	const RID body = rid();
	if (std::exchange(is_new_, false)) {
		server->body_set_state(body, PhysicsServer2D::BODY_STATE_TRANSFORM, transform_to(origin_));
		return true; // `send_velocity` comes after
	}
	server->body_set_mode(body, PhysicsServer2D::BODY_MODE_RIGID);
	server->body_set_mode(body, PhysicsServer2D::BODY_MODE_KINEMATIC);
	server->body_set_state(body, PhysicsServer2D::BODY_STATE_TRANSFORM, transform_to(origin_));
	server->body_set_state(rid(), PhysicsServer2D::BODY_STATE_LINEAR_VELOCITY, to_godot(velocity_));
	server->body_set_state(rid(), PhysicsServer2D::BODY_STATE_ANGULAR_VELOCITY, double(angular_velocity_));
	return true;
}

void HullProxy::show_slot(std::size_t index, const std::vector<Vec2> &outline) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	if (index == slots_.size()) {
		slots_.push_back({ server->convex_polygon_shape_create(), RID() });
		PackedVector2Array points = to_godot(std::span<const Vec2>(outline));
		if (outline.size() < 3) { // a shape must not be empty: until the part has an area, a speck in the middle
			points = { Vector2(), Vector2(OUTLINE_TOLERANCE, 0), Vector2(0, OUTLINE_TOLERANCE) };
		}
		server->shape_set_data(slots_[index].shape, points);
		server->body_add_shape(rid(), slots_[index].shape);
		return;
	}
	if (outline.size() < 3) {
		return; // pressed flat: the last polygon stays
	}
	const PackedVector2Array points = to_godot(std::span<const Vec2>(outline));
	Slot &slot = slots_[index];
	if (slots_.size() == 1) {
		server->shape_set_data(slot.shape, points);
		return;
	}
	if (!slot.spare.is_valid()) {
		slot.spare = server->convex_polygon_shape_create();
	}
	server->shape_set_data(slot.spare, points);
	server->body_set_shape(rid(), int(index), slot.spare);
	std::swap(slot.shape, slot.spare);
}

void HullProxy::drop_slots(std::size_t count) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	for (; slots_.size() > count; slots_.pop_back()) {
		server->free_rid(slots_.back().shape);
		if (slots_.back().spare.is_valid()) {
			server->free_rid(slots_.back().spare);
		}
	}
}

bool HullProxy::has_moved(const std::vector<std::uint32_t> &part, std::size_t first, std::size_t count) const {
	for (std::size_t i = first; i < first + count; ++i) {
		if (scratch_.moved[part[i % part.size()]]) {
			return true;
		}
	}
	return false;
}

// Wedges and pieces come a tick before the convex parts go, and go a tick after those have come back: no area sees the
// body leave in between. The first slots show either; the slots behind them are for wedges and pieces only.
void HullProxy::show(bool may_detail) {
	Real radius = 0;
	for (const Vec2 point : scratch_.outline) {
		radius = std::max(radius, length_squared(point));
	}
	Dent deepest;
	scratch_.polygons.resize(parts().convex.size());
	for (std::size_t i = 0; i < parts().convex.size(); ++i) {
		const Dent dent = gather_part(scratch_.outline, parts().convex[i], scratch_.workspace, scratch_.polygons[i]);
		deepest = dent.depth > deepest.depth ? dent : deepest;
	}
	const Real tolerance = std::max(LEAST_DENT_TOLERANCE, (pressed_ ? PRESSED_DENT_TOLERANCE : DENT_TOLERANCE) * std::sqrt(radius));
	const bool is_deep = deepest.depth > tolerance &&
			(pressed_ || ((may_detail || is_detailed()) && !is_filled(deepest.middle + origin_)));
	smooth_follows_ = is_deep ? 0 : smooth_follows_ + 1;
	if (!scratch_.sinking.empty()) {
		show_cuts();
	} else if (is_deep || (is_detailed() && smooth_follows_ < SMOOTH_FOLLOWS)) {
		show_wedges();
	} else {
		show_whole(std::exchange(divided_, false));
	}
}

// Whether another body is in the dent: what looks into it finds that one.
bool HullProxy::is_filled(Vec2 place) const {
	PhysicsDirectSpaceState2D *state = PhysicsServer2D::get_singleton()->space_get_direct_state(space_);
	if (state == nullptr) {
		return false;
	}
	Ref<PhysicsPointQueryParameters2D> query;
	query.instantiate();
	query->set_position(to_godot(place));
	query->set_exclude(Array::make(rid_));
	return !state->intersect_point(query, 1).is_empty();
}

// The parts, and nothing else once they have been shown for a tick.
void HullProxy::show_whole(bool is_new) {
	for (std::size_t i = 0; i < parts().convex.size(); ++i) {
		if (is_new || has_moved(parts().convex[i], 0, parts().convex[i].size())) {
			show_slot(i, scratch_.polygons[i]);
		}
	}
	if (!is_new) {
		drop_slots(parts().convex.size());
		has_cuts_ = false;
	}
}

void HullProxy::show_wedges() {
	const std::size_t part_count = parts().convex.size();
	const bool is_ready = is_detailed();
	const bool is_new = !divided_ || has_cuts_;
	for (std::size_t i = 0; i < parts().wedges.size(); ++i) {
		const HullParts::Wedge &wedge = parts().wedges[i];
		if (i < part_count && !is_ready) {
			if (divided_ || has_moved(parts().convex[i], 0, parts().convex[i].size())) {
				show_slot(i, scratch_.polygons[i]);
			}
		} else if (i >= slots_.size() || is_new || has_moved(parts().convex[wedge.part], wedge.first, wedge.count)) {
			gather_wedge(scratch_.outline, parts(), wedge, scratch_.workspace, scratch_.polygon);
			show_slot(i, scratch_.polygon);
		}
	}
	divided_ = is_ready;
	has_cuts_ = false;
	drop_slots(std::max(part_count, parts().wedges.size()));
}

// An empty piece is shown as another piece once more: as a speck it could be in the way.
void HullProxy::show_cuts() {
	const std::size_t part_count = parts().convex.size();
	const std::size_t more = pieces_for(scratch_.sinking.size()) - 1;
	const bool is_ready = has_cuts_ && slots_.size() >= part_count * (1 + more);
	has_cuts_ = true;
	scratch_.pieces.resize(part_count);
	const std::vector<Vec2> *filler = nullptr;
	for (std::size_t part = 0; part < part_count; ++part) {
		cut_for_riders(scratch_.polygons[part], scratch_.sinking, scratch_.pieces[part]);
		for (const std::vector<Vec2> &piece : scratch_.pieces[part]) {
			filler = filler != nullptr || piece.empty() ? filler : &piece;
		}
	}
	const auto filled = [&](const std::vector<Vec2> &piece) { return piece.empty() && filler != nullptr ? *filler : piece; };
	for (std::size_t part = 0; part < part_count; ++part) {
		show_slot(part, is_ready ? filled(scratch_.pieces[part].front()) : scratch_.polygons[part]);
	}
	for (std::size_t i = 0; i < part_count * more; ++i) {
		show_slot(part_count + i, filled(scratch_.pieces[i / more][1 + i % more]));
	}
	divided_ = is_ready;
	drop_slots(part_count * (1 + more));
}

void HullProxy::send_velocity(const SoftBodyData &body, BodyFrame frame) {
	const bool asleep = body.is_asleep();
	move_with_riders(body.hull(), body.velocities(), riders_, frame);
	Real spin = asleep ? 0 : frame.angular_velocity;
	Vec2 velocity = asleep ? Vec2{} : frame.velocity + perpendicular(origin_ - frame.center) * spin;
	if (length_squared(velocity) < SPEED_TOLERANCE * SPEED_TOLERANCE && std::abs(spin) < SPIN_TOLERANCE) {
		velocity = {};
		spin = 0;
	}
	if (velocity == velocity_ && spin == angular_velocity_) {
		return;
	}
	velocity_ = velocity;
	angular_velocity_ = spin;
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	server->body_set_state(rid(), PhysicsServer2D::BODY_STATE_LINEAR_VELOCITY, to_godot(velocity_));
	server->body_set_state(rid(), PhysicsServer2D::BODY_STATE_ANGULAR_VELOCITY, double(angular_velocity_));
}

bool HullProxy::follow(const SoftBodyData &body, Real inset, bool may_detail) {
	const Real wanted = pressed_ ? std::min(inset, body.shape().width() / 4) : 0;
	asked_inset_ = inset;
	const bool has_new_riders = std::exchange(has_new_riders_, false);
	if (!in_space_ || (still_ && body.is_asleep() && wanted == inset_ && !has_new_riders && division_ != nullptr)) {
		return false;
	}
	if (division_ == nullptr) {
		divide(body);
	}
	inset_ = wanted;
	const BodyFrame frame = measure_frame(body);
	const bool asleep = body.is_asleep();
	const bool rests = asleep || body.is_frozen() || !body.is_active();
	const bool is_placed = place(frame, asleep);
	trace(body, frame, inset_);
	const bool is_new = shown_.empty();
	shown_.resize(scratch_.outline.size());
	scratch_.moved.assign(scratch_.outline.size(), is_new);
	bool is_changed = is_new;
	for (std::size_t i = 0; i < scratch_.outline.size(); ++i) {
		scratch_.outline[i] -= origin_;
		if (is_new || length_squared(scratch_.outline[i] - shown_[i]) > OUTLINE_TOLERANCE * OUTLINE_TOLERANCE) {
			scratch_.moved[i] = true;
			is_changed = true;
			shown_[i] = scratch_.outline[i];
		} else {
			scratch_.outline[i] = shown_[i];
		}
	}
	gather_riders(body.hull());
	if (is_changed || is_detailed() || has_cuts_ || !scratch_.sinking.empty()) {
		show(may_detail);
	}
	send_velocity(body, frame);
	if (!asleep && !is_placed) {
		stir(); // the engine updates areas for bodies that seem to move
	}
	still_ = rests && riders_.empty() && !has_cuts_ && (!is_detailed() || (divided_ && smooth_follows_ == 0));
	return slots_.size() > 1;
}

bool HullProxy::set_riders(const std::vector<Rider> &riders) {
	if (riders == riders_) {
		return false;
	}
	riders_ = riders;
	has_new_riders_ = true;
	return true;
}

// Riders in the frame of the shapes.
void HullProxy::gather_riders(std::span<const Vec2> hull) {
	scratch_.sinking.clear();
	for (const Rider &rider : riders_) {
		if (sinks_in(hull, rider)) {
			scratch_.sinking.push_back(rider);
			scratch_.sinking.back().box = { rider.box.min - origin_, rider.box.max - origin_ };
		}
	}
}

void HullProxy::stir() {
	PhysicsServer2D::get_singleton()->body_set_state(rid(), PhysicsServer2D::BODY_STATE_TRANSFORM,
			transform_to(origin_));
}

void HullProxy::begin_near() {
	pressed_ = false;
	near_.clear();
}

void HullProxy::note_near(const RID &body, PhysicsServer2D::BodyMode mode) {
	if (mode == PhysicsServer2D::BODY_MODE_KINEMATIC) {
		pressed_ = true;
	} else if (mode != PhysicsServer2D::BODY_MODE_STATIC) {
		near_.push_back(body);
	}
}

void HullProxy::end_near() {
	std::sort(near_.begin(), near_.end());
	near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
	if (near_ == kept_apart_) {
		return;
	}
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	for (const RID &body : kept_apart_) {
		const bool is_wanted = std::find(exceptions_.begin(), exceptions_.end(), body) != exceptions_.end();
		if (!is_wanted && !std::binary_search(near_.begin(), near_.end(), body)) {
			server->body_remove_collision_exception(rid(), body);
		}
	}
	for (const RID &body : near_) {
		if (!std::binary_search(kept_apart_.begin(), kept_apart_.end(), body)) {
			server->body_add_collision_exception(rid(), body);
		}
	}
	std::swap(kept_apart_, near_);
}

void HullProxy::add_exception(const RID &body) {
	if (std::find(exceptions_.begin(), exceptions_.end(), body) == exceptions_.end()) {
		exceptions_.push_back(body);
		PhysicsServer2D::get_singleton()->body_add_collision_exception(rid(), body);
	}
}

void HullProxy::remove_exception(const RID &body) {
	if (std::erase(exceptions_, body) > 0 && !std::binary_search(kept_apart_.begin(), kept_apart_.end(), body)) {
		PhysicsServer2D::get_singleton()->body_remove_collision_exception(rid(), body);
	}
}

} // namespace softbody
