// SPDX-License-Identifier: MIT
// A body of the engine as it was last read, with its shapes translated for the core.
#include "godot/surroundings/body_record.h"

#include "godot/convert.h"
#include "godot/surroundings/hull_query.h"

#include <godot_cpp/classes/character_body2d.hpp>
#include <godot_cpp/classes/collision_object2d.hpp>
#include <godot_cpp/classes/static_body2d.hpp>
#include <godot_cpp/classes/tile_map_layer.hpp>
#include <godot_cpp/core/math.hpp>
#include <godot_cpp/core/object.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace godot;

namespace softbody {

namespace {

// Speed [px/s] above which a body moved by the game counts as teleported. Larger: a short teleport hits like a hammer.
// Smaller: fast pistons pass through.
constexpr double TELEPORT_SPEED = 6000;

// Ticks after which a driven body at rest becomes a static collider, which costs the core nothing as long as nothing
// comes near. Shorter: a body that stops and goes makes the core's lists anew.
constexpr int TICKS_TO_SETTLE = 60;

// Largest change of a scale for which shapes are not translated anew, over its size.
constexpr double SCALE_TOLERANCE = 1e-5;

// Farther than anything [px]: where the bounds of a border end.
constexpr Real EVERYWHERE = Real(1e15);

} // namespace

BodyRecord::BodyRecord(const RID &p_rid, const RID &p_space, int64_t p_tick) : rid_(p_rid), space_(p_space) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	object_id_ = server->body_get_object_instance_id(rid_);
	Object *node = ObjectDB::get_instance(object_id_);
	is_tile_ = Object::cast_to<TileMapLayer>(node) != nullptr;
	is_told_by_node_ = is_tile_ || Object::cast_to<CollisionObject2D>(node) != nullptr;
	if (Object::cast_to<CharacterBody2D>(node) != nullptr) {
		character_.emplace();
	}
	surface_.tag = object_id_;
	mode_ = server->body_get_mode(rid_);
	transform_ = server->body_get_state(rid_, PhysicsServer2D::BODY_STATE_TRANSFORM);
	scale_ = scale_and_skew(transform_);
	rigid_body_.pose = to_core_pose(transform_);
	rigid_body_.tag = object_id_;
	reread(p_tick);
}

Transform2D BodyRecord::frame() const {
	return has_rigid_body() ? transform_ * scale_.affine_inverse() : Transform2D();
}

// Counterpart of surface_in_motion for a plane.
Border BodyRecord::border_in_world(const Plane &p_border, double p_delta) const {
	if (!has_rigid_body()) {
		return { p_border, surface_ };
	}
	const Pose end = is_rigid() ? rigid_body_.pose : rigid_body_.pose_after(Real(p_delta));
	return { { end.apply(p_border.position), end.rotation.apply(p_border.normal) }, surface_in_motion(surface_, rigid_body_, end) };
}

Aabb BodyRecord::bounds() const {
	if (has_border_) {
		return { { -EVERYWHERE, -EVERYWHERE }, { EVERYWHERE, EVERYWHERE } };
	}
	if (!has_rigid_body() || !(bounds_.min.x <= bounds_.max.x)) {
		return bounds_;
	}
	const Transform2D to_world = frame();
	const Vector2 middle = to_world.xform(to_godot(bounds_.center()));
	const Vector2 half = to_godot(bounds_.half_size());
	const Vector2 extent = to_world.columns[0].abs() * half.x + to_world.columns[1].abs() * half.y;
	return { to_core(middle - extent), to_core(middle + extent) };
}

void BodyRecord::measure_bounds() {
	bounds_ = {};
	has_border_ = false;
	for (const ShapeRecord &shape : shapes_) {
		has_border_ |= shape.translated.border.has_value();
		for (const Collider &collider : shape.translated.colliders) {
			bounds_.include(collider.bounds());
		}
	}
}

bool BodyRecord::read_surface() {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	// PhysicsMaterial hands "rough" and "absorbent" to the server as a negative sign.
	const double friction = server->body_get_param(rid_, PhysicsServer2D::BODY_PARAM_FRICTION);
	const double bounce = server->body_get_param(rid_, PhysicsServer2D::BODY_PARAM_BOUNCE);
	Surface surface = surface_;
	surface.layer = server->body_get_collision_layer(rid_);
	surface.friction = Real(Math::abs(friction));
	surface.rough = friction < 0;
	surface.restitution = Real(std::clamp(Math::abs(bounce), 0.0, 1.0));
	surface.absorbent = bounce < 0;
	// Motion of the surface while the body stays in place. The server adds the motion of a driven body to it, so there
	// the node is asked.
	surface.linear_velocity = {};
	surface.angular_velocity = 0;
	if (StaticBody2D *node = Object::cast_to<StaticBody2D>(ObjectDB::get_instance(object_id_))) {
		surface.linear_velocity = to_core(node->get_constant_linear_velocity());
		surface.angular_velocity = Real(node->get_constant_angular_velocity());
	} else if (mode_ == PhysicsServer2D::BODY_MODE_STATIC) {
		surface.linear_velocity = to_core(Vector2(server->body_get_state(rid_, PhysicsServer2D::BODY_STATE_LINEAR_VELOCITY)));
		surface.angular_velocity = Real(double(server->body_get_state(rid_, PhysicsServer2D::BODY_STATE_ANGULAR_VELOCITY)));
	}
	return std::exchange(surface_, surface) != surface;
}

bool BodyRecord::is_enabled(const ShapeRecord &p_shape, int64_t p_since) const {
	return is_told_by_node_ ? !p_shape.traits.disabled : p_shape.seen >= p_since;
}

// The up direction of a one-way shape, out of its holding side, by its own transform.
void BodyRecord::translate(ShapeRecord &r_shape) const {
	const Transform2D to_frame = (has_rigid_body() ? scale_ : transform_) * r_shape.transform;
	r_shape.translated = r_shape.traits.disabled ? TranslatedShape() : translate_shape(r_shape.type, r_shape.data, to_frame);
	if (r_shape.traits.one_way_margin) {
		make_border_finite(to_core(to_frame.get_origin()), r_shape.translated);
		for (Collider &collider : r_shape.translated.colliders) {
			collider.one_way = to_core(-to_frame.columns[1].normalized());
			collider.one_way_margin = Real(*r_shape.traits.one_way_margin);
		}
	}
}

void BodyRecord::translate_all() {
	for (ShapeRecord &shape : shapes_) {
		translate(shape);
	}
	measure_bounds();
}

void BodyRecord::read_shape(int32_t p_index, const ShapeTraits &p_traits, ShapeRecord &r_shape) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	r_shape.shape = server->body_get_shape(rid_, p_index);
	r_shape.type = server->shape_get_type(r_shape.shape);
	r_shape.data = server->shape_get_data(r_shape.shape);
	r_shape.transform = server->body_get_shape_transform(rid_, p_index);
	r_shape.traits = p_traits;
	if (is_tile_) {
		r_shape.traits.one_way_margin.reset();
	}
	translate(r_shape);
	if (is_tile_ && !r_shape.translated.colliders.empty()) {
		const Vector2 middle = frame().xform(to_godot(r_shape.translated.colliders.front().bounds().center()));
		r_shape.traits.one_way_margin = find_tile_margin(ObjectDB::get_instance(object_id_), rid_, middle);
		if (r_shape.traits.one_way_margin) {
			translate(r_shape);
		}
	}
}

void BodyRecord::note_seen(int32_t p_shape, int64_t p_tick) {
	if (std::size_t(p_shape) < shapes_.size()) {
		shapes_[std::size_t(p_shape)].seen = p_tick;
	}
}

bool BodyRecord::is_in_space(const RID &p_body, const RID &p_space) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	return server->body_get_direct_state(p_body) != nullptr && server->body_get_space(p_body) == p_space;
}

bool BodyRecord::has_other_shapes(int64_t p_since) const {
	if (PhysicsServer2D::get_singleton()->body_get_shape_count(rid_) != int32_t(shapes_.size())) {
		return true;
	}
	if (is_told_by_node_) {
		return !is_tile_ && describe_shape_owners(ObjectDB::get_instance(object_id_)) != owners_;
	}
	return std::ranges::any_of(shapes_, [&](const ShapeRecord &p_shape) { return is_enabled(p_shape, p_since) == p_shape.traits.disabled; });
}

bool BodyRecord::reread(int64_t p_since) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	Object *node = ObjectDB::get_instance(object_id_);
	const int count = server->body_get_shape_count(rid_);
	bool is_different = read_surface() || std::size_t(count) != shapes_.size();
	const std::size_t known = shapes_.size();
	shapes_.resize(std::size_t(count));
	if (!is_tile_) {
		owners_ = describe_shape_owners(node);
	}
	const std::vector<ShapeTraits> all_traits = read_shape_traits(node, count);
	for (std::size_t i = 0; i < shapes_.size(); i++) {
		ShapeRecord &shape = shapes_[i];
		ShapeTraits traits = all_traits[i];
		if (is_tile_) {
			traits.one_way_margin = shape.traits.one_way_margin;
		}
		if (!is_told_by_node_) {
			traits.disabled = !is_enabled(shape, p_since);
		}
		const RID rid = server->body_get_shape(rid_, int(i));
		if (i < known && rid == shape.shape && traits == shape.traits &&
				server->body_get_shape_transform(rid_, int(i)) == shape.transform && server->shape_get_data(rid) == shape.data) {
			continue;
		}
		read_shape(int32_t(i), traits, shape);
		is_different = true;
	}
	if (is_different) {
		measure_bounds();
	}
	return is_different;
}

// Whether the shapes had to be translated anew.
bool BodyRecord::take_transform(const Transform2D &p_transform) {
	transform_ = p_transform;
	const Transform2D scale = scale_and_skew(p_transform);
	if (is_same_scale(scale, scale_, SCALE_TOLERANCE) && has_rigid_body()) {
		return false;
	}
	scale_ = scale;
	translate_all();
	return true;
}

BodyChange BodyRecord::poll(double p_delta) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	PhysicsDirectBodyState2D *state = server->body_get_direct_state(rid_);
	if (state == nullptr || server->body_get_space(rid_) != space_) {
		return BodyChange::GONE;
	}
	BodyChange change = BodyChange::NONE;
	const uint32_t layer = server->body_get_collision_layer(rid_);
	if (layer != surface_.layer) {
		surface_.layer = layer;
		change = BodyChange::REBUILT;
	}
	const PhysicsServer2D::BodyMode mode = server->body_get_mode(rid_);
	if (mode != mode_) {
		const bool had_rigid_body = has_rigid_body();
		mode_ = mode;
		is_mover_ = !is_rigid() && had_rigid_body; // a body frozen in flight may be moved on
		still_ticks_ = 0;
		last_reaction_ = {};
		was_rigid_ = false;
		translate_all();
		change = BodyChange::REBUILT;
	}
	const Transform2D transform = state->get_transform();
	if (!is_rigid()) {
		change = std::max(change, transform == transform_ ? settle() : poll_driven(transform, p_delta));
	} else {
		if (transform != transform_ && take_transform(transform)) {
			change = BodyChange::REBUILT;
		}
		poll_rigid(state, p_delta);
		change = std::max(change, BodyChange::MOVED);
	}
	// Borders belong to no rigid body of the core.
	return change == BodyChange::MOVED && has_border_ ? BodyChange::REBUILT : change;
}

BodyChange BodyRecord::settle() {
	if (!is_mover_) {
		return BodyChange::NONE;
	}
	rigid_body_ = {};
	rigid_body_.tag = object_id_;
	rigid_body_.pose = to_core_pose(transform_);
	still_ticks_ = character_ && character_->acts() ? 0 : still_ticks_ + 1;
	if (still_ticks_ < TICKS_TO_SETTLE) {
		return BodyChange::MOVED;
	}
	is_mover_ = false;
	translate_all();
	return BodyChange::REBUILT;
}

// The engine moves a driven body within its own step, which comes after ours. Its way in our step is the one that it
// has just gone, one tick late, and ends where the body is visible.
BodyChange BodyRecord::poll_driven(const Transform2D &p_transform, double p_delta) {
	const Pose from = to_core_pose(transform_);
	const Pose to = to_core_pose(p_transform);
	const bool is_jump = !(length(to.position - from.position) <= Real(TELEPORT_SPEED * p_delta));
	const bool was_mover = is_mover_;
	still_ticks_ = 0;
	is_mover_ = was_mover || !is_jump;
	const bool is_retranslated = take_transform(p_transform) || !was_mover;
	if (is_retranslated && is_mover_ && !was_mover) {
		translate_all(); // from the world's frame into the body's
	}
	if (is_jump) {
		rigid_body_ = {};
		rigid_body_.pose = to;
	} else {
		rigid_body_ = kinematic_between(from, to, Real(p_delta));
	}
	rigid_body_.tag = object_id_;
	return is_retranslated ? BodyChange::REBUILT : BodyChange::MOVED;
}

bool BodyRecord::reaches_in(std::span<const Vec2> p_hull, Real p_depth) const {
	const Pose to_world = to_core_pose(frame());
	return std::ranges::any_of(shapes_, [&](const ShapeRecord &p_shape) {
		TranslatedShape shape = p_shape.translated;
		for (Collider &collider : shape.colliders) {
			std::ranges::transform(collider.vertices, collider.vertices.begin(), [&](Vec2 p_vertex) { return to_world.apply(p_vertex); });
		}
		return HullQuery(std::move(shape), 0).reaches_in(p_hull, p_depth);
	});
}

bool BodyRecord::meets_layer(uint32_t p_layer) const {
	return (PhysicsServer2D::get_singleton()->body_get_collision_mask(rid_) & p_layer) != 0;
}

BodyChange BodyRecord::ride(Real p_mass, double p_delta) {
	const CharacterBody2D *node = character_ ? Object::cast_to<CharacterBody2D>(ObjectDB::get_instance(object_id_)) : nullptr;
	const PhysicsDirectBodyState2D *state = PhysicsServer2D::get_singleton()->body_get_direct_state(rid_);
	if (node == nullptr || state == nullptr || mode_ != PhysicsServer2D::BODY_MODE_KINEMATIC) {
		return BodyChange::NONE;
	}
	RigidBody body = rigid_body_;
	body.pose = to_core_pose(transform_); // not where it was a tick ago
	if (!character_->begin_step(*node, to_core(state->get_total_gravity()), p_mass, Real(p_delta), body)) {
		return BodyChange::NONE;
	}
	rigid_body_ = body;
	if (has_rigid_body()) {
		return BodyChange::MOVED;
	}
	is_mover_ = true;
	translate_all();
	return BodyChange::REBUILT;
}

} // namespace softbody
