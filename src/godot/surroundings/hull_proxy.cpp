// SPDX-License-Identifier: MIT
// A body of Godot's physics server in the place of a soft body.
#include "godot/surroundings/hull_proxy.h"

#include "godot/convert.h"

#include <godot_cpp/variant/transform2d.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

using namespace godot;

namespace softbody {

namespace {

// Largest distance of the polygons from the hull [px]. The engine is not told of smaller moves.
constexpr Real OUTLINE_TOLERANCE = Real(0.05);

// Largest distance of the engine body's origin, at which areas with point gravity pull, from the center of mass [px].
constexpr Real ORIGIN_TOLERANCE = Real(0.5);

// Depth from which on a dent is shown, as a share of the body's radius, and at least in px.
constexpr Real DENT_TOLERANCE = Real(0.03);
constexpr Real LEAST_DENT_TOLERANCE = 1;

// Ticks without a deep dent before a hull is shown in one piece again.
constexpr int SMOOTH_FOLLOWS = 30;

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

// Existing slots are kept, so that areas do not see the body leave and come back as its size changes.
void HullProxy::divide(const SoftBodyData &body) {
	parts_ = divide_hull(body.shape().rest_hull());
	polygons_.resize(parts_.convex.size());
	rest_normals_ = corner_normals(body.shape().rest_hull());
	shown_.clear();
	wedged_ = false;
	drop_slots(parts_.convex.size());
}

// The outline to be shown: the hull, drawn in where a kinematic body may come.
void HullProxy::trace(const SoftBodyData &body, const BodyFrame &frame, Real inset) {
	const std::span<const Vec2> hull = body.hull();
	outline_.assign(hull.begin(), hull.end());
	if (!(inset > 0)) {
		return;
	}
	const std::span<const Vec2> rest = body.shape().rest_hull();
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Vec2 normal = frame.rotation.apply(rest_normals_[i]);
		const Real pressed_in = dot(frame.center + frame.rotation.apply(rest[i]) - hull[i], normal);
		outline_[i] -= normal * std::clamp(inset - pressed_in, Real(0), inset);
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
	server->body_set_mode(rid(), PhysicsServer2D::BODY_MODE_RIGID);
	server->body_set_mode(rid(), PhysicsServer2D::BODY_MODE_KINEMATIC);
	server->body_set_state(rid(), PhysicsServer2D::BODY_STATE_TRANSFORM, Transform2D(0, to_godot(origin_)));
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
		if (moved_[part[i % part.size()]]) {
			return true;
		}
	}
	return false;
}

// Wedges come a tick before the convex parts go, and go a tick after those have come back: no area sees the body leave
// in between. The first slots show either; the slots behind them are for wedges only.
void HullProxy::show(bool may_detail) {
	const std::size_t part_count = parts_.convex.size();
	Real radius = 0;
	for (const Vec2 point : outline_) {
		radius = std::max(radius, length_squared(point));
	}
	Real deepest = 0;
	for (std::size_t i = 0; i < part_count; ++i) {
		deepest = std::max(deepest, gather_part(outline_, parts_.convex[i], workspace_, polygons_[i]));
	}
	const bool has_wedges = is_detailed();
	const bool is_deep = deepest > std::max(LEAST_DENT_TOLERANCE, DENT_TOLERANCE * std::sqrt(radius)) &&
			(may_detail || pressed_ || has_wedges);
	smooth_follows_ = is_deep ? 0 : smooth_follows_ + 1;

	const bool dented = is_deep || (has_wedges && smooth_follows_ < SMOOTH_FOLLOWS);
	const bool was_wedged = wedged_;
	wedged_ = dented && has_wedges;
	for (std::size_t i = 0; i < part_count; ++i) {
		const HullParts::Wedge &wedge = parts_.wedges[i];
		if (wedged_ && (!was_wedged || has_moved(parts_.convex[wedge.part], wedge.first, wedge.count))) {
			gather_wedge(outline_, parts_, wedge, workspace_, polygons_[i]);
			show_slot(i, polygons_[i]);
		} else if (!wedged_ && (was_wedged || has_moved(parts_.convex[i], 0, parts_.convex[i].size()))) {
			show_slot(i, polygons_[i]);
		}
	}
	if (!dented && !was_wedged) {
		drop_slots(part_count);
		return;
	}
	for (std::size_t i = part_count; i < parts_.wedges.size(); ++i) {
		const HullParts::Wedge &wedge = parts_.wedges[i];
		if (i >= slots_.size() || has_moved(parts_.convex[wedge.part], wedge.first, wedge.count)) {
			gather_wedge(outline_, parts_, wedge, workspace_, polygon_);
			show_slot(i, polygon_);
		}
	}
}

void HullProxy::send_velocity(const BodyFrame &frame, bool asleep) {
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
	if (!in_space_ || (still_ && body.is_asleep() && wanted == inset_ && !parts_.convex.empty())) {
		return false;
	}
	if (parts_.convex.empty()) {
		divide(body);
	}
	inset_ = wanted;
	const BodyFrame frame = measure_frame(body);
	const bool asleep = body.is_asleep();
	const bool rests = asleep || body.is_frozen() || !body.is_active();
	const bool is_placed = place(frame, asleep);
	trace(body, frame, inset_);
	const bool is_new = shown_.empty();
	shown_.resize(outline_.size());
	moved_.assign(outline_.size(), is_new);
	bool is_changed = is_new;
	for (std::size_t i = 0; i < outline_.size(); ++i) {
		outline_[i] -= origin_;
		if (is_new || length_squared(outline_[i] - shown_[i]) > OUTLINE_TOLERANCE * OUTLINE_TOLERANCE) {
			moved_[i] = true;
			is_changed = true;
			shown_[i] = outline_[i];
		} else {
			outline_[i] = shown_[i];
		}
	}
	if (is_changed || is_detailed()) {
		show(may_detail);
	}
	send_velocity(frame, asleep);
	if (!asleep && !is_placed) {
		stir(); // the engine updates areas for bodies that seem to move
	}
	still_ = rests && (!is_detailed() || (wedged_ && smooth_follows_ == 0));
	return slots_.size() > 1;
}

void HullProxy::stir() {
	PhysicsServer2D::get_singleton()->body_set_state(rid(), PhysicsServer2D::BODY_STATE_TRANSFORM,
			Transform2D(0, to_godot(origin_)));
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
